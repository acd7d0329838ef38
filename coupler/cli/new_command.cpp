// SPDX-License-Identifier: GPL-3.0-or-later
#include "coupler/cli/commands.hpp"
#include "coupler/cli/python_script.hpp"

namespace demvof {

int new_command(const NewOptions& options) {
  return run_python_script("new.py", {"--demvof", this_program().string(), options.name, "--fluid",
                                      options.fluid, "--particles", options.particles});
}

}  // namespace demvof
