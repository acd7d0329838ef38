// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <mpi.h>

#include "coupler/grid/bulk_cells.hpp"
#include "coupler/transfer/bulk_walls.hpp"
#include "coupler/transfer/relocation.hpp"

namespace demvof {

/// What limit_solid did; the same on every rank.
struct SolidRelief {
  CellId cells = 0;       // bulk cells that held too much
  double volume = 0;      // moved out of them, m3
  double not_placed = 0;  // still above the limit somewhere, because the grid has no room for it, m3
};

struct LimitedSolid {
  SolidRelief relief;
  Relocation relocation;  // of particles, with all that they bring
};

/// Finds what has to count elsewhere of the particles in bulk cells that hold more than
/// maximum_solid_fraction of the volume that is open to the fluid in them.
///
/// The excess of a cell goes in equal shares to those of its face neighbours that are below the limit, or to
/// all of them when none is; this is repeated until no cell is above the limit, or can reach one with room.
/// Cells without fluid (open share 0) receive nothing. The sum over all cells is kept to round-off, and the
/// result is the same to the last bit for any number of ranks. When all cells together have less room than
/// there are particles nothing is moved.
///
/// open_share: the fluid's share in the volume of those cells that the fluid mesh does not fill, -; the
/// others are all open. walls: faces that nothing goes through. owned, walls, open_share: cells owned by this
/// rank. Collective over world.
LimitedSolid limit_solid(MPI_Comm world, const BulkGrid& grid, const BulkPartition& partition,
                         double maximum_solid_fraction, const CellValues<double>& open_share,
                         const CellValues<BulkParticles>& owned, const CellValues<BulkWalls>& walls = {});

}  // namespace demvof
