// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "coupler/exchange/gravity_table.hpp"
#include "coupler/grid/bulk_grid.hpp"
#include "foam_side/openfoam.hpp"

namespace demvof {

struct Flow;

/// Throws InputError unless the bulk grid covers the fluid mesh, and the mesh is cyclic in exactly those
/// directions in which the particles' box is periodic, with the same ends there. A direction that the fluid
/// does not solve (empty patches) may be either. Collective over the fluid side.
/// grid: wraps around where the particles' box does, as dem_side states it. has_moved: the mesh may have left
/// the ends of a periodic direction.
void require_mesh_fits(const BulkGrid& grid, const Foam::fvMesh& mesh, bool has_moved);

/// What to say about gravity along a direction in which the mesh is periodic; empty where there is none.
/// Collective.
std::string slope_without_effect(const Foam::fvMesh& mesh, const GravityTable& gravity);

/// Throws InputError when walls move on one side only: surfaces that the particles' script moves (fix
/// move/mesh), or the fluid's mesh. A wall of the fluid with a velocity of its own (U: rotatingWallVelocity,
/// fixedValue) moves, too, also one that starts later; which surface it is, nobody knows. Collective over the
/// fluid side. moved: names of the script's fixes that move a surface.
void require_same_motion(const Flow& flow, const std::vector<std::string>& moved);

}  // namespace demvof
