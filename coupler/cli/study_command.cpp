// SPDX-License-Identifier: GPL-3.0-or-later
#include "coupler/cli/commands.hpp"
#include "coupler/cli/python_script.hpp"

namespace demvof {

int study_command(const StudyOptions& options) {
  std::vector<std::string> arguments = {"--demvof", this_program().string(), options.study_file};
  if (!options.out.empty()) arguments.insert(arguments.end(), {"--out", options.out});
  for (const std::string& row : options.only) arguments.insert(arguments.end(), {"--only", row});
  if (options.no_runs) arguments.emplace_back("--no-runs");
  return run_python_script("study.py", arguments);
}

}  // namespace demvof
