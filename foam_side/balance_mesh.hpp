// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "foam_side/openfoam.hpp"

namespace demvof {

struct Flow;

/// Most cells on a rank over the mean.
double imbalance(const Foam::fvMesh& mesh);

/// Patches join cells (cyclic): where these are sent OpenFOAM mixes up the patches' transformations.
bool cells_stay(const Foam::fvMesh& mesh);

/// Moves cells between the ranks so that each has as many: families of halved cells as a whole, by a cut
/// along the axes in the proportions of system/decomposeParDict. Every registered field goes along with its
/// old values, but for what hangs on the mesh (renew_geometry) and the flux (settle_flux). Nothing happens on
/// one rank, where cells_stay, nor while the imbalance is at most that which fluid.refinement accepts, or
/// about that which the last move left. Returns true if cells were moved.
bool balance_mesh(Flow& flow);

}  // namespace demvof
