// SPDX-License-Identifier: GPL-3.0-or-later
#include "coupler/link/exchange_plan.hpp"

#include <algorithm>

namespace demvof {
namespace {

bool owns_nothing(const BulkPartition& partition, int rank) {
  return partition.begin(rank) == partition.end(rank);
}

// The partner rank that keeps a rank without cells company: the owner of the place where its cells
// would be.
int company(const BulkPartition& mine, int my_rank, const BulkPartition& theirs) {
  return theirs.owner(std::min(mine.begin(my_rank), theirs.cell_count() - 1));
}

}  // namespace

std::vector<Counterpart> counterparts(const BulkPartition& mine, int my_rank, const BulkPartition& theirs) {
  std::vector<Counterpart> result;
  for (int rank = 0; rank < theirs.ranks(); ++rank) {
    const CellId begin = std::max(mine.begin(my_rank), theirs.begin(rank));
    const CellId end = std::min(mine.end(my_rank), theirs.end(rank));
    const bool keeps_company = (owns_nothing(mine, my_rank) && company(mine, my_rank, theirs) == rank) ||
                               (owns_nothing(theirs, rank) && company(theirs, rank, mine) == my_rank);
    if (begin < end)
      result.push_back({rank, begin, end});
    else if (keeps_company)
      result.push_back({rank, begin, begin});
  }
  return result;
}

}  // namespace demvof
