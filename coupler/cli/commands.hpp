// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace demvof {

/// What the subcommands on a case file share.
struct CaseOptions {
  std::string case_file;
  std::vector<std::string> overrides;  // --set
  std::string out;                     // --out; empty: run, beside the case file
  bool force = false;
  bool no_commands = false;  // refuse a case that executes anything
};

struct RunOptions {
  std::string fluid_ranks, particle_ranks;  // empty: as the case file says
  std::vector<std::string> mpirun_words;    // --mpirun-option
  bool slurm = false;                       // write a job's script instead
  std::vector<std::string> slurm_options;   // --slurm-option: lines of it
  bool continues = false;                   // an earlier run in the folder, from its last state
  std::optional<long> from;                 // ... or from the state after so many windows
  bool print_command = false, quiet = false;
};

struct StudyOptions {
  std::string study_file;
  std::string out;                // --out; empty: run_<study>, beside the study file
  std::vector<std::string> only;  // --only: names of rows; empty: all
  bool no_runs = false;
};

struct NewOptions {
  std::string name;              // the folder that is made
  std::string fluid, particles;  // interFoam case, LIGGGHTS script
};

// The subcommands. Each returns the exit code; InputError is code 2, any other exception code 3.
int new_command(const NewOptions& options);
int prepare_command(const CaseOptions& options);
int run_command(CaseOptions options, const RunOptions& run);
int check_command(const CaseOptions& options);
int report_command(const std::vector<std::string>& folders);
int study_command(const StudyOptions& options);

}  // namespace demvof
