// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

namespace demvof {

/// results.json of a run folder; null when there is none or it is not whole.
nlohmann::ordered_json read_results(const std::filesystem::path& folder);

/// The end of a run for people: wall times, particles, conservation, fronts, warnings, one line each.
std::string run_summary(const nlohmann::ordered_json& results);
/// Why a run failed: side, stage, time and message; empty when results.json does not say.
std::string failure_text(const nlohmann::ordered_json& results);
/// What the run wrote, one line per file or folder that is there.
std::string output_list(const std::filesystem::path& folder);

}  // namespace demvof
