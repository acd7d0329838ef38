// SPDX-License-Identifier: GPL-3.0-or-later
// States that ranks of foam_side have left, divided anew for another number of ranks.
#include "foam_side/gathered_state.hpp"

#include <gtest/gtest.h>

namespace demvof {
namespace {

using nlohmann::json;

/// Two ranks with five bulk cells and four fine cells between them, which are not numbered in turn.
std::vector<json> two_ranks() {
  return {json::parse(R"({
            "window": 3,
            "exchange": {"ratio": 0.5, "owed": {"cells": [0, 2], "values": [1, 2, 3, 4]},
                         "on_its_way": [1, 2, 3], "turnover": 10},
            "flow": {"cells": 3, "cell_numbers": [2, 0, 3], "gravity": [0, 0, -9], "flux": [20, 21, 0, 1, 30, 31]}})"),
          json::parse(R"({
            "window": 3,
            "exchange": {"ratio": 0.5, "owed": {"cells": [3, 4], "values": [5, 6, 7, 8]},
                         "on_its_way": [10, 20, 30], "turnover": 100},
            "flow": {"cells": 1, "cell_numbers": [1], "gravity": [0, 0, -9], "flux": [10, 11]}})")};
}

bool all(CellId) {
  return true;
}

TEST(GatheredState, HasTheBulkCellsThatARankOwnsSorted) {
  const auto owns = [](CellId cell) { return cell != 0 && cell != 4; };
  for (auto states : {two_ranks(), std::vector<json>{two_ranks()[1], two_ranks()[0]}}) {
    const json state = gathered_state(states, owns, true);
    EXPECT_EQ(state.at("exchange").at("owed"), json::parse(R"({"cells": [2, 3], "values": [3, 4, 5, 6]})"));
  }
}

TEST(GatheredState, KeepsWhatIsTheSameOnAllRanks) {
  for (const bool first : {true, false}) {
    const json state = gathered_state(two_ranks(), all, first);
    EXPECT_EQ(state.at("window"), 3);
    EXPECT_EQ(state.at("exchange").at("ratio"), 0.5);
    EXPECT_EQ(state.at("flow").at("gravity"), json({0, 0, -9}));
  }
}

TEST(GatheredState, GivesWhatIsSummedOverRanksToTheFirstAlone) {
  const json first = gathered_state(two_ranks(), all, true).at("exchange");
  EXPECT_EQ(first.at("on_its_way"), json({11.0, 22.0, 33.0}));
  EXPECT_EQ(first.at("turnover"), 110.0);
  const json other = gathered_state(two_ranks(), all, false).at("exchange");
  EXPECT_EQ(other.at("on_its_way"), json({0.0, 0.0, 0.0}));
  EXPECT_EQ(other.at("turnover"), 0.0);
}

TEST(GatheredState, HasItsFineCellsByTheirNumbers) {
  const json flow = gathered_flow(two_ranks(), {1, 3, 0});
  EXPECT_EQ(flow.at("cells"), 3);
  EXPECT_EQ(flow.at("cell_numbers"), json({1, 3, 0}));
  EXPECT_EQ(flow.at("flux"), json({10.0, 11.0, 30.0, 31.0, 0.0, 1.0}));
}

}  // namespace
}  // namespace demvof
