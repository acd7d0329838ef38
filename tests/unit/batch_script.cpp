// SPDX-License-Identifier: GPL-3.0-or-later
// The job's script that demvof run --slurm writes: its lines for sbatch, and what it does as a shell script.
#include "coupler/cli/batch_script.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <sstream>

#include "coupler/base/errors.hpp"
#include "coupler/cli/child_process.hpp"

namespace demvof {
namespace {

namespace fs = std::filesystem;

class BatchScript : public testing::Test {
 protected:
  BatchScript() : folder_(fs::temp_directory_path() / ("demvof-batch-" + std::to_string(getpid()))) {
    fs::create_directories(folder_ / "runs");
  }
  ~BatchScript() override { fs::remove_all(folder_); }

  BatchJob job() const {
    BatchJob job;
    job.directory = folder_;
    job.out = "runs/a";
    job.ranks = 3;
    job.command = {"/bin/echo", "run", "my case.yaml", "--set", "a=it's"};
    return job;
  }
  /// What sbatch reads.
  static std::vector<std::string> options(const std::string& script) {
    std::vector<std::string> found;
    std::istringstream lines(script);
    for (std::string line; std::getline(lines, line) && (line.empty() || line[0] == '#');)
      if (line.rfind("#SBATCH ", 0) == 0) found.push_back(line.substr(8));
    return found;
  }
  std::string done_by(const std::string& script) const {
    ChildOptions here;
    here.directory = folder_;
    return output_of({"/bin/bash", "-c", script}, here).text;
  }

  fs::path folder_;
};

TEST_F(BatchScript, TellsSlurmWhatTheRunNeedsAndThenWhatTheUserWants) {
  BatchJob job = this->job();
  job.slurm_options = {"--time=2:00:00", "-p long"};
  EXPECT_EQ(options(batch_script(job)),
            (std::vector<std::string>{"--job-name=a", "--chdir=" + folder_.string(), "--output=runs/a.%j.log",
                                      "--open-mode=append", "--ntasks=3", "--requeue", "--signal=B:TERM@120",
                                      "--time=2:00:00", "-p long"}));
}

TEST_F(BatchScript, BeginsTheRunOrGoesOnWhereThereIsAState) {
  const std::string script = batch_script(job());
  EXPECT_EQ(done_by(script), "run my case.yaml --set a=it's --force\n");
  fs::create_directories(folder_ / "runs/a/restart");
  EXPECT_EQ(done_by(script), "run my case.yaml --set a=it's --force\n");
  std::ofstream(folder_ / "runs/a/restart/latest.json") << "{}";
  EXPECT_EQ(done_by(script), "run my case.yaml --set a=it's --continue\n");
}

TEST_F(BatchScript, IsTheProcessThatSlurmSignals) {
  BatchJob job = this->job();
  job.command = {"/bin/bash", "-c", "echo $$"};
  for (const bool goes_on : {false, true}) {
    if (goes_on) {
      fs::create_directories(folder_ / "runs/a/restart");
      std::ofstream(folder_ / "runs/a/restart/latest.json") << "{}";
    }
    std::istringstream numbers(done_by("echo $$\n" + batch_script(job)));
    int shell = 0, run = 1;
    numbers >> shell >> run;
    EXPECT_EQ(shell, run) << goes_on;
  }
}

TEST_F(BatchScript, StandsBesideTheRunsFolder) {
  EXPECT_EQ(batch_script_file("runs/a"), "runs/a.sbatch");
  EXPECT_EQ(batch_script_file("runs/a/"), "runs/a.sbatch");
  EXPECT_EQ(batch_script_file("runs/b/../a/."), "runs/a.sbatch");
}

TEST_F(BatchScript, RefusesOptionsThatAreNone) {
  for (const char* wrong : {"", "-", "time=1", "2:00:00", "--time=1\n#SBATCH --wrap=x", "--time=1\r"}) {
    BatchJob job = this->job();
    job.slurm_options = {wrong};
    EXPECT_THROW(batch_script(job), InputError) << wrong;
  }
}

TEST_F(BatchScript, RefusesWhatTakesFromTheJobWhatItNeeds) {
  const std::vector<std::vector<std::string>> wrong = {{"--time=abc"},
                                                       {"--time=1:"},
                                                       {"-t 2"},
                                                       {"--time=2:00"},
                                                       {"--time 0:01:59"},
                                                       {"-p long -t1"},
                                                       {"--array=0-3"},
                                                       {"-a 1"},
                                                       {"--ntasks=2"},
                                                       {"-n2"},
                                                       {"--ntasks=many"},
                                                       {"--chdir=/tmp"},
                                                       {"--wrap=x"},
                                                       {"--signal=TERM@600"},
                                                       {"--signal=B:USR1@600"},
                                                       {"--signal=B:TERM@x"},
                                                       {"--time=10:00", "--signal=B:TERM@600"},
                                                       {"--signal=R:TERM@600"}};
  for (const auto& options : wrong) {
    BatchJob job = this->job();
    job.slurm_options = options;
    EXPECT_THROW(batch_script(job), InputError) << options[0];
  }
  const std::vector<std::vector<std::string>> right = {{"--time=3"},
                                                       {"--time=2:01"},
                                                       {"--time=1-0"},
                                                       {"--time=0"},
                                                       {"--time=UNLIMITED"},
                                                       {"--time=2", "--time=20"},
                                                       {"--ntasks=3"},
                                                       {"-n 8"},
                                                       {"-p long"},
                                                       {"--mem 4G"},
                                                       {"--time=20", "--signal=B:TERM@600"},
                                                       {"--time=2", "--signal=B:SIGTERM@60"},
                                                       {"--ntasks-per-node=2"}};
  for (const auto& options : right) {
    BatchJob job = this->job();
    job.slurm_options = options;
    EXPECT_NO_THROW(batch_script(job)) << options[0];
  }
}

TEST_F(BatchScript, ReplacesOnlyWhatDemvofHasWritten) {
  const fs::path file = folder_ / "runs/a.sbatch";
  write_batch_script(file, batch_script(job()));
  write_batch_script(file, batch_script(job()));
  std::ofstream(file) << "#!/bin/bash\nmine\n";
  EXPECT_THROW(write_batch_script(file, batch_script(job())), InputError);
}

}  // namespace
}  // namespace demvof
