// SPDX-License-Identifier: GPL-3.0-or-later
// Parts of the demvof command that need no solver: quoting, exit codes, progress, summary, run folders.
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <csignal>
#include <cstdio>
#include <filesystem>
#include <fstream>

#include "coupler/base/errors.hpp"
#include "coupler/cli/child_process.hpp"
#include "coupler/cli/decompose.hpp"
#include "coupler/cli/launch.hpp"
#include "coupler/cli/mpirun.hpp"
#include "coupler/cli/progress_display.hpp"
#include "coupler/cli/run_folder.hpp"
#include "coupler/cli/summary.hpp"
#include "coupler/output/run_lock.hpp"

namespace demvof {
namespace {

namespace fs = std::filesystem;

std::string output_of_shell(const std::string& line) {
  FILE* pipe = popen(line.c_str(), "r");
  std::string text;
  std::array<char, 256> buffer;
  while (std::fgets(buffer.data(), buffer.size(), pipe)) text += buffer.data();
  pclose(pipe);
  return text;
}

bool has_sleeping_children(const std::vector<std::string>& command) {
  const ChildProcess child(command);
  usleep(300000);
  return child.has_children({"foam_side", "sleep"});
}

TEST(ShellLine, IsReadByAShellAsItWasMeant) {
  const std::vector<std::string> words = {"printf", "<%s>", "plain", "with blank", "it's",
                                          "$HOME",  "",     "a;b",   "[1, 2]"};
  EXPECT_EQ(output_of_shell(shell_line(words)), "<plain><with blank><it's><$HOME><><a;b><[1, 2]>");
}

TEST(RunExitCode, PassesOnWhatTheProgramsSay) {
  for (const int code : {0, 2, 3, 4}) EXPECT_EQ(run_exit_code(code, true, false), code);
}

TEST(RunExitCode, CountsASideKilledByASignalAsALostPartner) {
  EXPECT_EQ(run_exit_code(137, true, false), 4);
  EXPECT_EQ(run_exit_code(139, true, false), 4);
  EXPECT_EQ(run_exit_code(139, false, false), 3) << "there is no partner";
  EXPECT_EQ(run_exit_code(143, true, true), 3) << "the user ended it";
  EXPECT_EQ(run_exit_code(1, true, false), 3) << "mpirun itself failed";
}

TEST(RunExitCode, AgreesWithTheResults) {
  EXPECT_EQ(confirmed({0, false}, "completed"), 0);
  EXPECT_EQ(confirmed({0, false}, ""), 3) << "there are none";
  EXPECT_EQ(confirmed({0, false}, "failed"), 3);
  EXPECT_EQ(confirmed({3, false}, "completed"), 3);
  EXPECT_EQ(confirmed({3, true}, "completed"), 0) << "stopped when all was done";
  EXPECT_EQ(confirmed({3, true}, "interrupted"), 3);
  EXPECT_EQ(confirmed({4, true}, "completed"), 4);
}

TEST(ChildProcess, TellsItsExitCodeAndItsSignal) {
  EXPECT_EQ(ChildProcess({"sh", "-c", "exit 7"}).wait(), 7);
  EXPECT_EQ(ChildProcess({"sh", "-c", "kill -9 $$"}).wait(), 128 + 9);
}

TEST(ChildProcess, KnowsWhetherItHasProgramsOfItsOwn) {
  EXPECT_TRUE(has_sleeping_children({"sh", "-c", "sleep 5; :"}));
  EXPECT_FALSE(has_sleeping_children({"sleep", "5"}));
  EXPECT_FALSE(has_sleeping_children({"timeout", "5", "tail", "-f", "/dev/null"})) << "of another name";
  EXPECT_FALSE(has_sleeping_children({"sh", "-c", "sleep 0 & exec sleep 5"}))
      << "an unburied one does not run";
}

/// Open MPI 4 can wait for itself for ever after its programs have gone, also beside a remote shell.
TEST(Launch, EndsAnMpirunThatDoesNotEndByItself) {
  const fs::path folder = fs::path(testing::TempDir()) / ("demvof_mpirun_" + std::to_string(getpid()));
  fs::create_directories(folder);
  std::ofstream(folder / "mpirun") << "#!/bin/sh\nsleep 20 &\nsleep 2 | cat\nexec sleep 1000\n";
  fs::permissions(folder / "mpirun", fs::perms::owner_all);
  const std::string path = getenv("PATH");
  setenv("PATH", (folder.string() + ":" + path).c_str(), 1);
  LaunchCommand command;
  command.words = {"mpirun"};
  command.programs = {"cat"};
  command.pair = true;
  std::string said;
  Watch watch;
  watch.on_line = [&](const std::string& line) { said += line; };
  watch.on_tick = [] {};
  EXPECT_EQ(launch(command, watch).code, 4);
  EXPECT_EQ(said, "mpirun does not end though its programs have: killing it");
  setenv("PATH", path.c_str(), 1);
  fs::remove_all(folder);
}

TEST(Mpirun, LosesAHostInHalfTheTimeThatTheSidesWaitForEachOther) {
  for (const double time_out : {16.0, 600.0, 1e300}) {
    const std::vector<std::string> words = mpirun_options({"Open MPI 4.1.4", 4}, time_out, 6);
    const auto value = [&words](const std::string& name) {
      const auto at = std::find(words.begin(), words.end(), "oob_tcp_keepalive_" + name);
      return at < words.end() - 1 ? std::stod(at[1]) : 0;
    };
    const double lost = value("time") + value("probes") * value("intvl");
    EXPECT_LE(lost, time_out / 2);
    EXPECT_GE(lost, std::min(5e4, time_out / 2) * 0.99);
  }
}

/// Neither as the programs' own words nor as those of mpirun, which are shown when there are no others.
TEST(Launch, SpellsOutControlCharacters) {
  const std::string rule(70, '-');
  for (const std::string& output : {std::string("\033[2J\n"), rule + "\n\033[2J\n" + rule + "\n"}) {
    LaunchCommand command;
    command.words = {"sh", "-c", "printf '%s' \"$0\"; exit 3", output};
    std::string said;
    Watch watch;
    watch.on_line = [&](const std::string& line) { said += line; };
    watch.on_tick = [] {};
    EXPECT_EQ(launch(command, watch).code, 3);
    EXPECT_EQ(said, "\\x1b[2J");
  }
}

TEST(ChildProcess, NamesAProgramThatDoesNotStart) {
  try {
    ChildProcess({"no_such_program_at_all"});
    FAIL() << "it started";
  } catch (const std::runtime_error& error) {
    EXPECT_STREQ(error.what(), "cannot start no_such_program_at_all: No such file or directory");
  }
}

/// For the programs of two runs by hand, which no command of demvof looks after.
TEST(RunLock, IsHeldByOneProcessForEachPart) {
  const fs::path folder = fs::path(testing::TempDir()) / ("demvof_lock_" + std::to_string(getpid()));
  fs::create_directories(folder);
  std::array<int, 2> ready;
  ASSERT_EQ(pipe(ready.data()), 0);
  const pid_t other = fork();
  if (other == 0) {
    const RunLock lock(folder, RunLock::Part::fluid);
    if (write(ready[1], "!", 1) == 1) pause();
    _exit(1);
  }
  char sign = 0;
  ASSERT_EQ(read(ready[0], &sign, 1), 1);
  EXPECT_THROW(RunLock(folder, RunLock::Part::fluid), InputError);
  EXPECT_THROW(RunLock(folder, RunLock::Part::command), InputError);
  EXPECT_NO_THROW(RunLock(folder, RunLock::Part::particles));
  kill(other, SIGKILL);
  waitpid(other, nullptr, 0);
  EXPECT_NO_THROW(RunLock(folder, RunLock::Part::fluid)) << "who was killed holds nothing";
  for (const int end : ready) close(end);
  fs::remove_all(folder);
}

TEST(Clock, CountsSecondsMinutesHours) {
  EXPECT_EQ(clock_text(5.4), "0:05");
  EXPECT_EQ(clock_text(65), "1:05");
  EXPECT_EQ(clock_text(2 * 3600 + 3 * 60 + 4), "2:03:04");
}

TEST(Cut, GoesAlongTheLongestSide) {
  EXPECT_EQ(cut_along_longest({0.4, 0.2, 0.6}, 5), (Cut{1, 1, 5}));
  EXPECT_EQ(cut_along_longest({1, 1, 1}, 2), (Cut{2, 1, 1}));
}

TEST(Cut, KeepsTheDirectionsAndProportionsOfTheGivenOne) {
  const std::array<double, 3> sides = {1, 2, 3};
  EXPECT_EQ(cut_like({1, 2, 1}, sides, 7), (Cut{1, 7, 1}));
  EXPECT_EQ(cut_like({2, 2, 1}, sides, 16), (Cut{4, 4, 1}));
  EXPECT_EQ(cut_like({2, 2, 1}, sides, 8), (Cut{2, 4, 1})) << "y is longer than x";
  EXPECT_EQ(cut_like({4, 1, 2}, sides, 32), (Cut{8, 1, 4}));
  EXPECT_EQ(cut_like({2, 2, 2}, sides, 3), (Cut{1, 1, 3}));
  EXPECT_EQ(cut_like({1, 1, 1}, sides, 6), (Cut{1, 1, 6})) << "no direction is given";
}

Progress halfway() {
  Progress progress;
  progress.time = 0.25;
  progress.end_time = 0.5;
  progress.speed = 0.001;
  progress.remaining_seconds = 250;
  progress.worst_courant = 0.48;
  progress.particles = 3883;
  return progress;
}

TEST(ProgressLine, ShowsTimeSpeedRemainingCourantAndParticles) {
  EXPECT_EQ(progress_line(halfway(), 92),
            "[==========          ]  50 %  t 0.25 of 0.5 s  0.001 s/s  4:10 left  Co 0.48  3883 particles");
}

TEST(ProgressLine, FitsTheTerminal) {
  for (int width = 0; width < 200; ++width)
    EXPECT_LE(progress_line(halfway(), width).size(), static_cast<std::size_t>(width));
}

TEST(ProgressDisplay, ShowsNothingOfWhatWasThereBefore) {
  const auto file = std::filesystem::temp_directory_path() / fmt::format("demvof-progress-{}.json", getpid());
  const auto write = [&file] { ProgressFile(file).update(halfway()); };
  write();
  ProgressDisplay display(file, Display::lines);
  testing::internal::CaptureStdout();
  display.update();
  EXPECT_EQ(testing::internal::GetCapturedStdout(), "");
  std::filesystem::last_write_time(file, std::filesystem::last_write_time(file) - std::chrono::hours(1));
  testing::internal::CaptureStdout();
  display.update();
  EXPECT_NE(testing::internal::GetCapturedStdout().find(" 50 %"), std::string::npos);
  std::filesystem::remove(file);
}

TEST(RunSummary, ShowsWhatAUserAsksForFirst) {
  const auto results = nlohmann::ordered_json::parse(R"({
    "status": "completed",
    "steps": {"windows": 2500, "fluid": 5000, "particles": 50000},
    "wall_seconds": {"total": 200, "fluid": 150, "particles": 30, "exchange": 3, "waiting": null},
    "particles": {"initial": 3883, "inserted": 0, "left": 1, "lost": 2, "final": 3880},
    "conservation": {"exchange": 1e-15, "momentum": 2e-3, "solid_volume": 3e-14, "liquid_volume": 4e-6},
    "momentum": {"error": [1e-12, null, 7e-9]},
    "quantities": {"liquid_front": 0.2, "solid_front": 0.1875},
    "warnings": ["void fraction limited 3 times"]})");
  const std::string text = run_summary(results);
  for (const char* part :
       {"completed", "3:20", "2500 windows, 5000 fluid, 50000 DEM", "fluid 150.0 s (75 %)", "waited 0.0 s",
        "3883 at the start, 0 inserted, 1 left, 2 lost", "exchange 1.0e-15", "liquid volume 4.0e-06",
        "momentum of particles 2.0e-03, of everything 7.0e-09", "liquid front           0.2 m",
        "solid front            0.1875 m", "void fraction limited 3 times"})
    EXPECT_NE(text.find(part), std::string::npos) << part << " is not in\n" << text;
}

TEST(RunSummary, SaysNoMoreThanThatARunNeverBegan) {
  EXPECT_EQ(run_summary({{"status", "failed"}, {"steps", {{"windows", 0}}}}),
            "status                 failed\n");
}

/// A case with its files in a folder that goes when the test is over.
class RunFolderTest : public testing::Test {
 protected:
  RunFolderTest() {
    base_ = fs::path(testing::TempDir()) /
            (std::string("demvof_") + testing::UnitTest::GetInstance()->current_test_info()->name());
    fs::remove_all(base_);
    for (const char* file : {"fluid/system/controlDict", "particles/in.script", "case.yaml"}) write(file);
    parameters_.file = (base_ / "case.yaml").string();
    parameters_.fluid.case_folder = "fluid";
    parameters_.particles.emplace().script = "particles/in.script";
  }
  ~RunFolderTest() override { fs::remove_all(base_); }
  void write(const fs::path& file) const {
    fs::create_directories((base_ / file).parent_path());
    std::ofstream(base_ / file) << "x\n";
  }
  RunFolder folder(const std::string& out) const { return RunFolder(parameters_, base_ / out); }
  std::string refusal(const std::string& out, bool force) const {
    try {
      folder(out).clear(force);
    } catch (const InputError& error) {
      return error.what();
    }
    return "nothing";
  }
  static bool says(const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
  }

  fs::path base_;
  CaseParameters parameters_;
};

TEST_F(RunFolderTest, StandsBesideTheCaseFileByDefault) {
  EXPECT_EQ(RunFolder(parameters_, "").path(), base_ / "run");
}

TEST_F(RunFolderTest, TakesANewOrAnEmptyFolder) {
  EXPECT_EQ(refusal("a/b", false), "nothing");
  EXPECT_TRUE(fs::is_directory(base_ / "a/b"));
  EXPECT_EQ(refusal("a/b", false), "nothing");
}

TEST_F(RunFolderTest, KeepsResultsUntilForced) {
  write("run/results.json");
  write("run/fluid/0/U");
  write("run/notes.txt");
  EXPECT_TRUE(says(refusal("run", false), "the results of an earlier run; give --force"));
  EXPECT_TRUE(fs::exists(base_ / "run/fluid/0/U"));
  EXPECT_EQ(refusal("run", true), "nothing");
  EXPECT_FALSE(fs::exists(base_ / "run/fluid") || fs::exists(base_ / "run/results.json"));
  EXPECT_TRUE(fs::exists(base_ / "run/notes.txt")) << "not ours";
}

TEST_F(RunFolderTest, NeverTouchesWhatIsNoRun) {
  write("other/particles/thesis.tex");
  EXPECT_TRUE(says(refusal("other", true), "holds something that is no earlier run"));
  EXPECT_TRUE(fs::exists(base_ / "other/particles/thesis.tex"));
}

TEST_F(RunFolderTest, NeverTouchesTheCaseItself) {
  write("results.json");  // would pass for a run's folder
  for (const char* out : {".", "fluid", "fluid/run", "particles"})
    EXPECT_TRUE(says(refusal(out, true), "the case's own")) << out << ": " << refusal(out, true);
  EXPECT_TRUE(fs::exists(base_ / "particles/in.script"));
}

TEST_F(RunFolderTest, IsReadyForTheSamePreparationOnly) {
  const RunFolder prepared = folder("run");
  prepared.clear(false);
  EXPECT_FALSE(prepared.ready());
  prepared.mark_ready();
  EXPECT_TRUE(prepared.ready());
  parameters_.fluid.ranks = 2;
  EXPECT_FALSE(folder("run").ready()) << "another decomposition";
  EXPECT_TRUE(says(refusal("run", false), "--force"));
  parameters_.fluid.ranks = 1;
  EXPECT_TRUE(folder("run").ready());
  fs::last_write_time(base_ / "fluid/system/controlDict",
                      fs::file_time_type::clock::now() + std::chrono::hours(1));
  EXPECT_FALSE(folder("run").ready()) << "the case has changed since";
}

TEST_F(RunFolderTest, IsNotReadyOnceItHasRun) {
  const RunFolder prepared = folder("run");
  prepared.clear(false);
  prepared.mark_ready();
  write("run/progress.json");
  EXPECT_FALSE(prepared.ready());
}

}  // namespace
}  // namespace demvof
