// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "coupler/grid/bulk_grid.hpp"

namespace demvof {

/// One rank of the partner and the bulk cells shared with it: those that both ranks own.
struct Counterpart {
  int rank;           // in the partner's program
  CellId begin, end;  // cells begin <= c < end; may be empty
};

/// With whom a rank exchanges bulk cells: each rank of the partner that owns some of the same cells,
/// in the order of ranks (and so of cells). A rank that owns no cell is given one counterpart all the
/// same, so that every rank hears from the partner in every exchange. Both sides come to the same
/// pairs without a message, from the two rank counts and the cell count alone.
std::vector<Counterpart> counterparts(const BulkPartition& mine, int my_rank, const BulkPartition& theirs);

}  // namespace demvof
