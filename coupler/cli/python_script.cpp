// SPDX-License-Identifier: GPL-3.0-or-later
#include "coupler/cli/python_script.hpp"

#include <fmt/format.h>

#include <stdexcept>

#include "coupler/cli/child_process.hpp"

namespace demvof {

namespace fs = std::filesystem;

fs::path this_program() {
  return fs::read_symlink("/proc/self/exe");
}

int run_python_script(const std::string& name, const std::vector<std::string>& arguments) {
  // <build>/bin and <build>/share/demvof, or the same below an installation's prefix.
  const fs::path script = this_program().parent_path().parent_path() / "share" / "demvof" / name;
  if (!fs::exists(script)) throw std::runtime_error(fmt::format("{} is not there", script.string()));
  // The distribution's Python has the distribution's matplotlib and VTK; another one in PATH may not.
  const fs::path distribution = "/usr/bin/python3";
  std::vector<std::string> command = {fs::exists(distribution) ? distribution.string() : "python3",
                                      script.string()};
  command.insert(command.end(), arguments.begin(), arguments.end());
  const int code = ChildProcess(command).wait();
  return code == 0 || code == 2 ? code : 3;
}

}  // namespace demvof
