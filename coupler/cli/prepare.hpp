// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <map>
#include <string>

#include "coupler/cli/run_folder.hpp"
#include "coupler/config/parameters.hpp"

namespace demvof {

/// What OpenFOAM programs need in their environment, for users who have not sourced one.
std::map<std::string, std::string> foam_environment();

/// Runs one command in a folder, its output at the end of the log; throws InputError with the end of the log
/// when it fails.
void run_logged(const std::string& command, const std::filesystem::path& where,
                const std::filesystem::path& log);

/// Makes <folder>/fluid: a copy of the OpenFOAM case with mesh, fields and, for several ranks, their
/// parts. say: told what is being done. Throws InputError when the case is not complete, a command
/// fails (with the end of its log) or data would be lost (RunFolder::clear).
void prepare_case(const CaseParameters& parameters, const RunFolder& folder, bool force,
                  const std::function<void(const std::string&)>& say);

}  // namespace demvof
