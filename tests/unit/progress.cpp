// SPDX-License-Identifier: GPL-3.0-or-later
#include "coupler/output/progress.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>

namespace fs = std::filesystem;
using namespace std::chrono_literals;

namespace demvof {
namespace {

const fs::path path =
    fs::path(testing::TempDir()) / ("demvof_progress_" + std::to_string(getpid()) + ".json");

Progress at(double time, long window) {
  Progress progress;
  progress.time = time;
  progress.end_time = 1;
  progress.window = window;
  progress.windows = 100;
  progress.worst_courant = 0.5;
  progress.particles = 3883;
  progress.fine_cells = 48000;
  return progress;
}

class ProgressFileTest : public testing::Test {
 protected:
  void SetUp() override { fs::remove(path); }
  const ProgressFile::Clock::time_point start_ = ProgressFile::Clock::now();
  ProgressFile file_{path, 500ms};
};

TEST_F(ProgressFileTest, ReadsBackWhatWasWritten) {
  file_.update(at(0.25, 25), start_);
  const auto read = read_progress(path);
  ASSERT_TRUE(read);
  EXPECT_EQ(read->time, 0.25);
  EXPECT_EQ(read->end_time, 1);
  EXPECT_EQ(read->window, 25);
  EXPECT_EQ(read->windows, 100);
  EXPECT_EQ(read->worst_courant, 0.5);
  EXPECT_EQ(read->particles, 3883);
  EXPECT_EQ(read->fine_cells, 48000);
}

TEST_F(ProgressFileTest, SpeedAndRemainingTimeOfASteadyRun) {
  for (int n = 0; n <= 40; ++n) file_.update(at(0.01 * n, n), start_ + n * 2s);
  const auto read = read_progress(path);
  ASSERT_TRUE(read);
  EXPECT_NEAR(read->speed, 0.005, 1e-12);             // 0.01 s in 2 s
  EXPECT_NEAR(read->remaining_seconds, 120.0, 1e-9);  // 0.6 s to go
}

TEST_F(ProgressFileTest, SpeedFollowsARunThatSlowsDown) {
  for (int n = 0; n <= 20; ++n) file_.update(at(0.01 * n, n), start_ + n * 1s);
  for (int n = 1; n <= 60; ++n) file_.update(at(0.2 + 0.01 * n, 20 + n), start_ + 20s + n * 10s);
  EXPECT_NEAR(read_progress(path)->speed, 0.001, 1e-5);  // ten minutes later the quick start is forgotten
}

TEST_F(ProgressFileTest, WritesAtMostOncePerInterval) {
  file_.update(at(0.1, 10), start_);
  file_.update(at(0.2, 20), start_ + 499ms);
  EXPECT_EQ(read_progress(path)->window, 10);
  file_.update(at(0.3, 30), start_ + 500ms);
  EXPECT_EQ(read_progress(path)->window, 30);
}

TEST_F(ProgressFileTest, TheEndIsAlwaysWritten) {
  file_.update(at(0.99, 99), start_);
  file_.update(at(1, 100), start_ + 1ms);
  EXPECT_EQ(read_progress(path)->window, 100);
  EXPECT_EQ(read_progress(path)->remaining_seconds, 0);
}

TEST_F(ProgressFileTest, NothingToReadIsNoError) {
  EXPECT_FALSE(read_progress(path));
  std::ofstream(path) << "{\"time\": 0.1";
  EXPECT_FALSE(read_progress(path));
  std::ofstream(path) << "{\"time\": 0.1}";
  EXPECT_FALSE(read_progress(path));
}

TEST(ProgressFile, APlaceThatCannotBeWrittenDoesNotStopTheRun) {
  ProgressFile file(fs::path(testing::TempDir()) / "not_there" / "progress.json");
  EXPECT_NO_THROW(file.update(at(0.1, 10)));
}

}  // namespace
}  // namespace demvof
