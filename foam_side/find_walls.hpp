// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <mpi.h>

#include "coupler/grid/bulk_cells.hpp"
#include "coupler/transfer/bulk_walls.hpp"
#include "foam_side/openfoam.hpp"

namespace demvof {

/// Faces of the bulk grid through which the mesh lets nothing pass, though it fills both cells beside them:
/// walls and baffles that lie on them. A wall inside a bulk cell, or one that closes a part of a face only,
/// is not seen. Collective over the fluid side. Returned: cells owned by this rank that have such a face.
CellValues<BulkWalls> find_walls(const Foam::fvMesh& mesh, const BulkGrid& grid,
                                 const BulkPartition& partition, MPI_Comm world);

}  // namespace demvof
