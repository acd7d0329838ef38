// SPDX-License-Identifier: GPL-3.0-or-later
#include "coupler/output/restart_point.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>

#include "coupler/base/errors.hpp"

namespace fs = std::filesystem;

namespace demvof {
namespace {

class RestartPoints : public testing::Test {
 protected:
  RestartPoints() {
    fs::remove_all(run_);
    fs::create_directories(run_ / "restart");
    now_.coupling.window = 1e-3;
    now_.coupling.end_time = 1;
    now_.bulk_grid.emplace().cells = {4, 5, 6};
    now_.fluid.ranks = 2;
  }
  ~RestartPoints() override { fs::remove_all(run_); }

  const fs::path run_ = fs::path(testing::TempDir()) / ("demvof_restart_" + std::to_string(getpid()));
  const RestartPoint point_{7, 0.1 * 0.07, "0.007", 1e-3, {4, 5, 6}, 2};
  CaseParameters now_;
};

TEST_F(RestartPoints, ReadsBackExactly) {
  write_restart_point(run_, point_);
  const RestartPoint read = read_restart_point(run_, now_);
  EXPECT_EQ(read.window, 7);
  EXPECT_EQ(read.time, point_.time);
  EXPECT_EQ(read.fluid_time, "0.007");
}

TEST_F(RestartPoints, OnlyTheLatestFolderStays) {
  for (long window : {3, 5, 7}) fs::create_directories(restart_folder(run_, window));
  write_restart_point(run_, point_);
  EXPECT_FALSE(fs::exists(restart_folder(run_, 3)));
  EXPECT_FALSE(fs::exists(restart_folder(run_, 5)));
  EXPECT_TRUE(fs::exists(restart_folder(run_, 7)));
}

TEST_F(RestartPoints, WithoutOneIsTheUsersMistake) {
  EXPECT_THROW(read_restart_point(run_, now_), InputError);
  std::ofstream(run_ / "restart" / "latest.json") << "{\"window\": 7";
  EXPECT_THROW(read_restart_point(run_, now_), InputError);
}

TEST_F(RestartPoints, WhatItBelongsToMustNotChange) {
  write_restart_point(run_, point_);
  CaseParameters other = now_;
  other.coupling.window = 2e-3;
  EXPECT_THROW(read_restart_point(run_, other), InputError);
  other = now_;
  other.bulk_grid->cells[2] = 7;
  EXPECT_THROW(read_restart_point(run_, other), InputError);
  other = now_;
  other.fluid.ranks = 1;
  EXPECT_THROW(read_restart_point(run_, other), InputError);
  other = now_;
  other.coupling.end_time = point_.time;
  EXPECT_THROW(read_restart_point(run_, other), InputError);
}

TEST_F(RestartPoints, EarlierFilesAreNumbered) {
  for (const char* text : {"first", "second"}) {
    std::ofstream(run_ / "results.json") << text;
    keep_earlier(run_, "results.json");
    EXPECT_FALSE(fs::exists(run_ / "results.json"));
  }
  keep_earlier(run_, "results.json");  // nothing to keep
  std::string second;
  std::ifstream(run_ / "earlier" / "results_2.json") >> second;
  EXPECT_EQ(second, "second");
  EXPECT_FALSE(fs::exists(run_ / "earlier" / "results_3.json"));
}

}  // namespace
}  // namespace demvof
