// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include "coupler/cli/commands.hpp"
#include "coupler/cli/commands_in_case.hpp"
#include "coupler/cli/prepare.hpp"
#include "coupler/config/read_case.hpp"

namespace demvof {

int prepare_command(const CaseOptions& options) {
  const CaseParameters parameters = read_case(options.case_file, options.overrides);
  if (options.no_commands) require_no_commands(parameters);
  const RunFolder folder(parameters, options.out);
  if (folder.ready() && !options.force) {
    fmt::print("{} is ready.\n", folder.fluid().string());
    return 0;
  }
  prepare_case(parameters, folder, options.force, [](const std::string& what) { fmt::print("{}\n", what); });
  fmt::print("{} is ready; the log is {}.\n", folder.fluid().string(), folder.prepare_log().string());
  return 0;
}

}  // namespace demvof
