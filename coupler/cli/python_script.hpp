// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace demvof {

/// The running demvof.
std::filesystem::path this_program();

/// Runs one of the scripts that come with demvof; its exit code if that is 0, 2 or 3, otherwise 3.
/// Throws std::runtime_error when the script is not there.
int run_python_script(const std::string& name, const std::vector<std::string>& arguments);

}  // namespace demvof
