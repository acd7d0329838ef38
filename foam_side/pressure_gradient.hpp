// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "foam_side/flow.hpp"

namespace demvof {

/// G of the last pressure correction, between particles: the gradient (of p_rgh and density, less surface
/// tension) that pushed each cell from its own side of its faces, Pa/m. A registered field, so that a mesh
/// change maps it.
Foam::vectorField& own_gradient(Flow& flow);
/// nullptr before the first correction, and without particles.
const Foam::vectorField* find_own_gradient(const Flow& flow);

}  // namespace demvof
