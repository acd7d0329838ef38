// SPDX-License-Identifier: GPL-3.0-or-later
#include "coupler/link/exchange_plan.hpp"

#include <gtest/gtest.h>

namespace demvof {
namespace {

// All pairings of small rank counts and grids, also grids with fewer cells than ranks.
template <class Check>
void for_all_pairings(Check check) {
  for (CellId cells = 1; cells <= 12; ++cells)
    for (int here = 1; here <= 6; ++here)
      for (int there = 1; there <= 6; ++there) {
        SCOPED_TRACE(testing::Message() << cells << " cells, " << here << " x " << there << " ranks");
        check(BulkPartition(cells, here), BulkPartition(cells, there));
      }
}

TEST(ExchangePlan, BothSidesSeeTheSamePairs) {
  for_all_pairings([](const BulkPartition& here, const BulkPartition& there) {
    for (int a = 0; a < here.ranks(); ++a)
      for (int b = 0; b < there.ranks(); ++b) {
        const Counterpart *forth = nullptr, *back = nullptr;
        const auto of_a = counterparts(here, a, there), of_b = counterparts(there, b, here);
        for (const Counterpart& other : of_a)
          if (other.rank == b) forth = &other;
        for (const Counterpart& other : of_b)
          if (other.rank == a) back = &other;
        ASSERT_EQ(forth != nullptr, back != nullptr) << "ranks " << a << " and " << b;
        if (!forth) continue;
        EXPECT_EQ(forth->end - forth->begin, back->end - back->begin);
        if (forth->begin == forth->end) continue;
        EXPECT_EQ(forth->begin, back->begin);
      }
  });
}

TEST(ExchangePlan, EveryRankHearsFromThePartner) {
  for_all_pairings([](const BulkPartition& here, const BulkPartition& there) {
    for (int rank = 0; rank < here.ranks(); ++rank) EXPECT_FALSE(counterparts(here, rank, there).empty());
  });
}

TEST(ExchangePlan, EachCellGoesOneWay) {
  for_all_pairings([](const BulkPartition& here, const BulkPartition& there) {
    for (int rank = 0; rank < here.ranks(); ++rank) {
      CellId next = here.begin(rank);
      for (const Counterpart& other : counterparts(here, rank, there)) {
        if (other.begin == other.end) continue;
        EXPECT_EQ(other.begin, next);
        EXPECT_EQ(there.owner(other.begin), other.rank);
        EXPECT_EQ(there.owner(other.end - 1), other.rank);
        next = other.end;
      }
      EXPECT_EQ(next, here.end(rank));
    }
  });
}

}  // namespace
}  // namespace demvof
