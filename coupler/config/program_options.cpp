// SPDX-License-Identifier: GPL-3.0-or-later
#include "coupler/config/program_options.hpp"

#include <CLI/CLI.hpp>
#include <cstdlib>
#include <exception>
#include <iostream>

#include "coupler/base/place_in_job.hpp"
#include "coupler/config/read_case.hpp"

namespace demvof {

namespace {

constexpr const char* footer =
    "Started in pairs in one job, with the same case file and options on both sides:\n"
    "  mpirun -np 3 demvof_pair -np 2 foam_side case.yaml + -np 1 dem_side case.yaml\n"
    "`demvof run case.yaml` prepares the fluid case and starts exactly this.\n\n"
    "Exit codes: 0 done, 2 the input is wrong, 3 the run failed or was interrupted, 4 the partner was lost.\n"
    "SIGTERM, SIGINT or SIGUSR1 end the run cleanly after the present window.";

}  // namespace

ProgramOptions read_program_options(const std::string& program, const std::string& about, int argc,
                                    char** argv) {
  ProgramOptions options;
  for (int i = 0; i < argc; ++i) options.command += std::string(i ? " " : "") + argv[i];

  CLI::App app(about, program);
  app.footer(footer);
  app.add_option("case", options.case_file, "case file (YAML; docs/case_file.md)")->required();
  app.add_option("--out", options.out, "folder of the run; default: run, beside the case file");
  app.add_option("--set", options.overrides, "key=value: replaces one entry of the case file; repeatable")
      ->allow_extra_args(false);
  app.add_flag("--continue", options.continues,
               "go on from the last state that the run in the folder has left");
  app.add_option("--from", options.from, "with --continue: go on from the state after so many windows");
  app.add_flag("--check", options.check, "open both sides, compare them, and stop before the first step");
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& end) {
    const bool wrong = end.get_exit_code() != 0;
    if (rank_in_job().value_or(0) == 0) app.exit(end);
    std::exit(wrong ? 2 : 0);
  }
  if (options.out.empty()) options.out = std::filesystem::path(options.case_file).parent_path() / "run";
  options.out = std::filesystem::absolute(options.out).lexically_normal();
  return options;
}

double start_limit_seconds(const ProgramOptions& options) {
  try {
    return read_case(options.case_file, options.overrides).coupling.time_out;
  } catch (const std::exception&) {
    return CouplingParameters().time_out;
  }
}

}  // namespace demvof
