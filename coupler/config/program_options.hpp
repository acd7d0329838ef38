// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace demvof {

/// The command line that foam_side and dem_side share.
struct ProgramOptions {
  std::string case_file;
  std::filesystem::path out;           // folder of the run; default: run beside the case file
  std::vector<std::string> overrides;  // --set key=value
  bool continues = false;              // from the latest state that a run has left in out
  std::optional<long> from;            // ... or from the state after so many windows
  bool check = false;                  // everything up to the handshake, no step
  std::string command;                 // as typed
};

/// program: name; about: what it is, for --help. Call it before MPI starts: --help prints (once per
/// job) and ends the program with exit code 0, a wrong command line with exit code 2.
ProgramOptions read_program_options(const std::string& program, const std::string& about, int argc,
                                    char** argv);

/// How long the processes of a run may take to start, s: coupling.time_out; its default when the case file
/// cannot be read, which comes out later.
double start_limit_seconds(const ProgramOptions& options);

}  // namespace demvof
