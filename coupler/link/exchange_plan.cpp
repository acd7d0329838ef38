// SPDX-License-Identifier: GPL-3.0-or-later
#include "coupler/link/exchange_plan.hpp"

namespace demvof {

// A rank without cells keeps one of the partner's owners company: they take turns.
std::vector<int> counterparts(const BulkPartition& mine, int my_rank, const BulkPartition& theirs) {
  if (my_rank >= mine.owners()) return {my_rank % theirs.owners()};
  std::vector<int> ranks = theirs.owners_within(mine.block(my_rank));
  for (int rank = my_rank; rank < theirs.ranks(); rank += mine.owners())
    if (rank >= theirs.owners()) ranks.push_back(rank);
  return ranks;
}

}  // namespace demvof
