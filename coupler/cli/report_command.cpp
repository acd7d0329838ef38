// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include <filesystem>
#include <stdexcept>

#include "coupler/cli/child_process.hpp"
#include "coupler/cli/commands.hpp"
#include "coupler/config/read_case.hpp"

namespace demvof {

namespace fs = std::filesystem;

int report_command(const std::vector<std::string>& folders) {
  for (const std::string& folder : folders)
    if (!fs::exists(fs::path(folder) / "results.json"))
      throw InputError(fmt::format("{}: there is no results.json: not the folder of a run", folder));
  // <build>/bin and <build>/share/demvof, or the same below an installation's prefix.
  const fs::path programs = fs::read_symlink("/proc/self/exe").parent_path();
  const fs::path script = programs.parent_path() / "share" / "demvof" / "report.py";
  if (!fs::exists(script)) throw std::runtime_error(fmt::format("{} is not there", script.string()));
  // The distribution's Python has the distribution's matplotlib and VTK; another one in PATH may not.
  const fs::path distribution = "/usr/bin/python3";
  std::vector<std::string> command = {fs::exists(distribution) ? distribution.string() : "python3",
                                      script.string()};
  command.insert(command.end(), folders.begin(), folders.end());
  const int code = ChildProcess(command).wait();
  return code == 0 || code == 2 ? code : 3;
}

}  // namespace demvof
