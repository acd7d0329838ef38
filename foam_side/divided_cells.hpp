// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "coupler/grid/bulk_grid.hpp"
#include "foam_side/openfoam.hpp"

namespace demvof {

/// What to say about bulk cells that hold fluid on both sides of a wall inside them: kernels do not see it,
/// so that particles on one side displace fluid on the other, too, and are told of both. Empty where there
/// are none. Fine cells belong to the bulk cell of their centre; bulk cells that several ranks share are not
/// looked at. Collective over the fluid side.
std::string walls_inside_bulk_cells(const Foam::fvMesh& mesh, const BulkGrid& grid);

}  // namespace demvof
