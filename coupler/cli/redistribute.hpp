// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <string>

#include "coupler/cli/run_folder.hpp"
#include "coupler/output/restart_point.hpp"

namespace demvof {

/// Divides the fluid case of the state that a run goes on from for another number of ranks, fluid.ranks of
/// the parameters. The other states of the run are given up; the fluid's output so far goes to
/// earlier/fluid_1, or the next number that is free. Killed at any moment, it leaves the state as it was, or
/// divided anew (settle_division). say: told what is being done. Throws InputError when a command fails.
void redistribute(const CaseParameters& parameters, const RunFolder& folder, const RestartPoint& point,
                  const std::function<void(const std::string&)>& say);

/// Cleans up after a redistribute() that was killed.
void settle_division(const std::filesystem::path& run, const RestartPoint& point);

}  // namespace demvof
