// SPDX-License-Identifier: GPL-3.0-or-later
#include "coupler/output/history.hpp"

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <unistd.h>

#include <csignal>
#include <cstdlib>
#include <fstream>
#include <limits>
#include <sstream>

namespace fs = std::filesystem;

namespace demvof {
namespace {

const fs::path path = fs::path(testing::TempDir()) / ("demvof_history_" + std::to_string(getpid()) + ".csv");

std::vector<std::string> lines() {
  std::ifstream file(path);
  std::vector<std::string> result;
  for (std::string line; std::getline(file, line);) result.push_back(line);
  return result;
}

TEST(History, NamesThenUnitsThenRows) {
  History history(path, {{"liquid_front", "m"}, {"particles", "-"}});
  history.append(0, {0.05, 3883});
  history.append(2e-4, {0.0625, 3882});
  EXPECT_EQ(lines(), (std::vector<std::string>{"time,liquid_front,particles", "# s,m,-", "0,0.05,3883",
                                               "0.0002,0.0625,3882"}));
}

TEST(History, EveryRowIsInTheFileBeforeAppendReturns) {
  History history(path, {{"mean_level", "m"}});
  for (std::size_t row = 1; row <= 3; ++row) {
    history.append(0.1 * static_cast<double>(row), {1.5});
    EXPECT_EQ(lines().size(), 2 + row);
  }
}

TEST(History, ValuesReadBackExactly) {
  const std::vector<double> values = {0.1,  1.0 / 3.0,          6.02214076e23, 4.9406564584124654e-324,
                                      -0.0, 123456789.123456789};
  {
    History history(path, std::vector<HistoryColumn>(values.size(), {"q", "-"}));
    history.append(1e-3, values);
  }
  std::istringstream row(lines().at(2));
  std::string cell;
  std::getline(row, cell, ',');
  for (const double value : values) {
    ASSERT_TRUE(std::getline(row, cell, ','));
    EXPECT_EQ(std::strtod(cell.c_str(), nullptr), value) << cell;
  }
}

TEST(History, GoesOnAfterTheRowsUpToATime) {
  {
    History history(path, {{"q", "m"}});
    for (int row = 0; row < 5; ++row) history.append(0.1 * row, {1.0 * row});
  }
  {
    History history(path, {{"q", "m"}}, 0.1 * 3);
    history.append(0.35, {7});
  }
  EXPECT_EQ(lines(), (std::vector<std::string>{"time,q", "# s,m", "0,0", "0.1,1", "0.2,2",
                                               "0.30000000000000004,3", "0.35,7"}));
  EXPECT_THROW(History(path, {{"another", "m"}}, 0.3), std::runtime_error);
  EXPECT_EQ(lines().size(), 7u) << "what is there stays";
}

TEST(History, RefusesARowOfAnotherLength) {
  History history(path, {{"mean_level", "m"}});
  EXPECT_THROW(history.append(0, {}), std::invalid_argument);
  EXPECT_THROW(history.append(0, {1, 2}), std::invalid_argument);
  EXPECT_EQ(lines().size(), 2u);
}

TEST(History, RefusesAFolderThatIsNotThere) {
  EXPECT_THROW(History(fs::path(testing::TempDir()) / "not_there" / "history.csv", {}), std::runtime_error);
}

// A full disk, played by the limit on the size of a file.
TEST(History, TakesARowBackThatDoesNotFit) {
  rlimit before{};
  getrlimit(RLIMIT_FSIZE, &before);
  std::signal(SIGXFSZ, SIG_IGN);
  History history(path, {{"mean_level", "m"}});
  history.append(0.25, {1.5});
  rlimit small = before;
  small.rlim_cur = fs::file_size(path) + 4;  // part of a row
  setrlimit(RLIMIT_FSIZE, &small);
  EXPECT_THROW(history.append(0.5, {2.5}), std::runtime_error);
  setrlimit(RLIMIT_FSIZE, &before);
  std::signal(SIGXFSZ, SIG_DFL);
  EXPECT_EQ(lines().size(), 3u);
  history.append(0.75, {3.5});
  EXPECT_EQ(lines().back(), "0.75,3.5");
}

}  // namespace
}  // namespace demvof
