// SPDX-License-Identifier: GPL-3.0-or-later
#include "coupler/output/restart_point.hpp"

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>

#include "coupler/base/checksum.hpp"
#include "coupler/base/errors.hpp"

namespace fs = std::filesystem;

namespace demvof {
namespace {

bool all(const std::string&) {
  return true;
}

std::string content(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

class RestartPoints : public testing::Test {
 protected:
  RestartPoints() {
    fs::remove_all(run_);
    fs::create_directories(run_ / "restart");
  }
  ~RestartPoints() override { fs::remove_all(run_); }

  /// The state after so many windows, with one file of its own and one that grows.
  RestartPoint write(long window, int kept = 2) const {
    const fs::path file = restart_folder(run_, window) / "particles";
    fs::create_directories(file.parent_path());
    std::ofstream(file) << "positions after window " << window;
    std::ofstream(run_ / "history.csv", std::ios::app) << window << "\n";
    RestartPoint point{window, 0.01 * static_cast<double>(window) * 0.1, "0.007", frame_, R"({"window":1})",
                       {}};
    add_state_file(point.files, run_, file);
    add_state_file(point.files, run_, run_ / "history.csv", true);
    write_restart_point(run_, point, kept);
    return point;
  }
  RestartPoint read(std::optional<long> window = {}) const {
    return read_restart_point(run_, window, frame_, 1);
  }
  std::string refusal(std::optional<long> window = {}) const {
    try {
      require_whole(run_, read(window), all);
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  }
  bool refused(const StateFrame& frame, double end_time = 1) const {
    try {
      read_restart_point(run_, {}, frame, end_time);
      return false;
    } catch (const InputError&) {
      return true;
    }
  }

  const fs::path run_ = fs::path(testing::TempDir()) / ("demvof_restart_" + std::to_string(getpid()));
  const StateFrame frame_{1e-3, {0, 0, 0}, {0.4, 0.5, 0.6}, {4, 5, 6}, 2, {1, 1, 2}, "staggered"};
};

TEST_F(RestartPoints, ReadsBackExactly) {
  const RestartPoint point = write(7);
  const RestartPoint found = read();
  EXPECT_EQ(found.window, 7);
  EXPECT_EQ(found.time, point.time);
  EXPECT_EQ(found.fluid_time, "0.007");
  EXPECT_EQ(found.frame.bulk_blocks, frame_.bulk_blocks);
  EXPECT_EQ(refusal(), "");
}

TEST_F(RestartPoints, OfOwnersThatHadNoBlocksSaysSo) {
  write(7);
  auto text = nlohmann::ordered_json::parse(std::ifstream(run_ / "restart" / "latest.json"));
  text.erase("bulk_blocks");
  text.erase("checksum");
  text["checksum"] = Checksum().add(text.dump()).text();
  std::ofstream(run_ / "restart" / "latest.json") << text.dump(1) << "\n";
  EXPECT_EQ(read().frame.bulk_blocks, (std::array<int, 3>{}));
}

TEST_F(RestartPoints, TheNewestStatesStay) {
  for (const long window : {3, 5, 7}) write(window);
  EXPECT_FALSE(fs::exists(restart_folder(run_, 3)));
  EXPECT_TRUE(fs::exists(restart_folder(run_, 5)));
  EXPECT_EQ(read().window, 7);
  EXPECT_EQ(read(5).window, 5);
  EXPECT_EQ(refusal(5), "") << "history.csv has grown since";
}

TEST_F(RestartPoints, AnUnfinishedStateIsNone) {
  write(5);
  fs::create_directories(restart_folder(run_, 6));  // killed in the middle
  EXPECT_EQ(read().window, 5);
  EXPECT_THROW(read(6), InputError);
  write(7);
  EXPECT_FALSE(fs::exists(restart_folder(run_, 6)));
}

TEST_F(RestartPoints, WhoGoesBackGivesUpWhatCameLater) {
  for (const long window : {3, 5, 7}) write(window, 9);
  go_back_to(run_, read(3));
  EXPECT_EQ(read().window, 3);
  EXPECT_FALSE(fs::exists(restart_folder(run_, 5)));
  EXPECT_FALSE(fs::exists(restart_folder(run_, 7)));
}

TEST_F(RestartPoints, WithoutOneIsTheUsersMistake) {
  EXPECT_THROW(read(), InputError);
  std::ofstream(run_ / "restart" / "latest.json") << "{\"window\": 7";
  EXPECT_THROW(read(), InputError);
}

TEST_F(RestartPoints, OneOfAnotherVersionSaysSo) {
  write(5);
  std::ofstream(run_ / "restart" / "latest.json") << R"({"version": "9.9", "checksum": "?"})";
  try {
    read();
    FAIL() << "was read";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("is not what was written"), std::string::npos);
  }
  std::ofstream(run_ / "restart" / "latest.json") << R"({"version": "9.9", "window": 7})";
  try {
    read();
    FAIL() << "was read";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("written by demvof 9.9"), std::string::npos);
    EXPECT_NE(std::string(error.what()).find("--continue --from 5"), std::string::npos);
  }
}

TEST_F(RestartPoints, APipeIsNoState) {
  write(5);
  fs::remove(run_ / "restart" / "latest.json");
  ASSERT_EQ(mkfifo((run_ / "restart" / "latest.json").c_str(), 0600), 0);
  EXPECT_THROW(read(), InputError);
}

TEST_F(RestartPoints, AFolderWithAHugeNumberIsNoState) {
  write(5);
  fs::create_directories(run_ / "restart" / "99999999999999999999");
  write(6);
  EXPECT_EQ(read().window, 6);
}

/// Every bit of every file, and of what is said about them.
TEST_F(RestartPoints, NoFlippedBitIsAccepted) {
  write(5);
  write(7);
  int accepted = 0, flipped = 0;
  for (const fs::path& file :
       {run_ / "restart" / "latest.json", restart_folder(run_, 7) / "particles", run_ / "history.csv"}) {
    const std::string whole = content(file);
    for (std::size_t byte = 0; byte < whole.size(); ++byte)
      for (const int bit : {0, 3, 6}) {
        std::string damaged = whole;
        damaged[byte] = static_cast<char>(damaged[byte] ^ (1 << bit));
        std::ofstream(file, std::ios::binary) << damaged;
        // White space between the words of a JSON text says nothing.
        if (refusal().empty() && std::isspace(static_cast<unsigned char>(whole[byte])) == 0) ++accepted;
        ++flipped;
      }
    std::ofstream(file, std::ios::binary) << whole;
    EXPECT_EQ(refusal(), "");
  }
  EXPECT_GT(flipped, 200);
  EXPECT_EQ(accepted, 0);
}

TEST_F(RestartPoints, ADamagedOneIsNamedAndAWholeOneOffered) {
  write(5);
  write(7);
  fs::resize_file(restart_folder(run_, 7) / "particles", 3);
  EXPECT_NE(refusal().find("restart/7/particles has 3 bytes, but 24 were written"), std::string::npos)
      << refusal();
  EXPECT_NE(refusal().find("--continue --from 5"), std::string::npos) << refusal();
  fs::remove(restart_folder(run_, 5) / "particles");
  EXPECT_NE(refusal().find("no other state that is whole"), std::string::npos) << refusal();
  EXPECT_NE(refusal(5).find("is not there"), std::string::npos) << refusal(5);
}

TEST_F(RestartPoints, FilesOfTwoOutputsAreNoState) {
  write(5);
  write(7);
  fs::copy(restart_folder(run_, 5) / "particles", restart_folder(run_, 7) / "particles",
           fs::copy_options::overwrite_existing);
  EXPECT_NE(refusal().find("is not what was written"), std::string::npos) << refusal();
}

TEST_F(RestartPoints, AHistoryThatWasCutIsNoticed) {
  write(5);
  write(7);
  fs::resize_file(run_ / "history.csv", 3);
  EXPECT_NE(refusal().find("history.csv has 3 bytes"), std::string::npos) << refusal();
  EXPECT_EQ(refusal(5), "");
}

TEST_F(RestartPoints, WhatItBelongsToMustNotChange) {
  const RestartPoint point = write(7);
  EXPECT_FALSE(refused(frame_));
  StateFrame other = frame_;
  other.window_length = 2e-3;
  EXPECT_TRUE(refused(other));
  other = frame_;
  other.bulk_cells[2] = 7;
  EXPECT_TRUE(refused(other));
  other = frame_;
  other.bulk_upper.z = 0.61;  // as many cells elsewhere
  EXPECT_TRUE(refused(other));
  other = frame_;
  other.bulk_lower.x = -1e-6;
  EXPECT_TRUE(refused(other));
  other = frame_;
  other.fluid_ranks = 1;
  EXPECT_TRUE(refused(other));
  other = frame_;
  other.schedule = "concurrent";
  EXPECT_TRUE(refused(other));
  EXPECT_TRUE(refused(frame_, point.time));
}

TEST(ChangedKeys, AreNamedOneByOne) {
  const std::string before = R"({"coupling": {"schedule": "staggered", "window": 1}, "forces": ["lift"]})";
  const std::string now = R"({"coupling": {"schedule": "concurrent", "window": 1}, "output": {"states": 3}})";
  const std::vector<std::string> expected = {R"(coupling.schedule: "staggered", now "concurrent")",
                                             R"(forces.0: "lift", now not given)", "output.states: now 3"};
  EXPECT_EQ(changed_keys(before, now), expected);
  EXPECT_TRUE(changed_keys(before, before).empty());
}

TEST_F(RestartPoints, EarlierFilesAreNumbered) {
  for (const char* text : {"first", "second"}) {
    std::ofstream(run_ / "results.json") << text;
    keep_earlier(run_, "results.json");
    EXPECT_FALSE(fs::exists(run_ / "results.json"));
  }
  keep_earlier(run_, "results.json");  // nothing to keep
  EXPECT_EQ(content(run_ / "earlier" / "results_2.json"), "second");
  EXPECT_FALSE(fs::exists(run_ / "earlier" / "results_3.json"));
}

}  // namespace
}  // namespace demvof
