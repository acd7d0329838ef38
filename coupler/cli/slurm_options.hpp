// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace demvof {

constexpr int time_to_stop = 120;  // s before a job's limit: for the window to end and a state to be written

/// Throws InputError on a --slurm-option that is none of sbatch's, or that takes from the job what it needs:
/// its ranks, its folder, the signal in time, being alone in the run's folder.
void require_slurm_options(const std::vector<std::string>& options, int ranks);

/// As sbatch reads --time, s; HUGE_VAL: no limit. Nothing where it is no time.
std::optional<double> slurm_time(const std::string& text);

}  // namespace demvof
