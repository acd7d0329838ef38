// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "coupler/grid/bulk_grid.hpp"
#include "foam_side/openfoam.hpp"

namespace demvof {

/// Throws InputError unless the bulk grid covers the fluid mesh, and the mesh is cyclic in exactly those
/// directions in which the particles' box is periodic, with the same ends there. A direction that the fluid
/// does not solve (empty patches) may be either. Collective over the fluid side.
/// grid: wraps around where the particles' box does, as dem_side states it.
void require_mesh_fits(const BulkGrid& grid, const Foam::fvMesh& mesh);

}  // namespace demvof
