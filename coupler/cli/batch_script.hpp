// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace demvof {

/// A run as a job of Slurm, which goes on with the run as often as it is submitted.
struct BatchJob {
  std::filesystem::path directory;         // where it works; paths of the rest are seen from there
  std::filesystem::path out;               // the run's folder
  int ranks = 0;                           // of both programs
  std::vector<std::string> command;        // demvof run, without --continue and --force
  std::vector<std::string> slurm_options;  // the user's own lines of #SBATCH
};

/// The folder of the run with .sbatch behind it: beside it, because demvof run wants an empty one.
std::filesystem::path batch_script_file(const std::filesystem::path& out);
/// Throws InputError on slurm_options that are none, or against what the job needs (slurm_options.hpp).
std::string batch_script(const BatchJob& job);
/// Writes it. Throws InputError where there is another file of its name, which no demvof has written.
void write_batch_script(const std::filesystem::path& file, const std::string& script);

}  // namespace demvof
