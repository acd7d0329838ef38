// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include <filesystem>

#include "coupler/base/errors.hpp"
#include "coupler/cli/commands.hpp"
#include "coupler/cli/python_script.hpp"

namespace demvof {

int report_command(const std::vector<std::string>& folders) {
  for (const std::string& folder : folders)
    if (!std::filesystem::exists(std::filesystem::path(folder) / "results.json"))
      throw InputError(fmt::format("{}: there is no results.json: not the folder of a run", folder));
  return run_python_script("report.py", folders);
}

}  // namespace demvof
