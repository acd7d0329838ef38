// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "coupler/grid/bulk_partition.hpp"

namespace demvof {

/// With whom a rank exchanges bulk cells: each rank of the partner that owns some of the same cells, sorted.
/// A rank that owns no cell is given one counterpart all the same, so that every rank hears from the partner
/// in every exchange. Both sides come to the same pairs without a message, from the two rank counts and the
/// grid's cells alone.
std::vector<int> counterparts(const BulkPartition& mine, int my_rank, const BulkPartition& theirs);

}  // namespace demvof
