// SPDX-License-Identifier: GPL-3.0-or-later
#include "coupler/cli/last_results.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <optional>

#include "coupler/config/read_case.hpp"
#include "coupler/output/progress.hpp"
#include "coupler/output/results.hpp"

namespace demvof {
namespace {

namespace fs = std::filesystem;

bool is_note(const fs::path& file) {
  return file.filename().string().rfind(".failed.", 0) == 0;
}

/// What the first process that failed has left in its note.
std::optional<RunFailure> first_note(const fs::path& folder) {
  std::error_code none;
  std::optional<RunFailure> first;
  fs::file_time_type written;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, none)) {
    if (!is_note(entry.path())) continue;
    const fs::file_time_type time = entry.last_write_time(none);
    std::ifstream stream(entry.path());
    std::string whose, text;
    std::getline(stream, whose);
    std::getline(stream, text);
    const auto json = nlohmann::json::parse(text, nullptr, false);
    if (!json.is_object() || (first && written <= time)) continue;
    first = RunFailure{json.value("side", ""), json.value("stage", ""), json.value("time", 0.0),
                       json.value("message", "")};
    written = time;
  }
  return first;
}

std::string how_it_ended(const End& end) {
  if (end.user_asked)
    return "the programs were asked to stop at the end of the window, and killed before they were there";
  const std::string what = fmt::format(
      "the programs ended without a word, with exit code {}: they were killed, or mpirun was", end.code);
  if (!end.mpirun_said.empty()) return what + ". mpirun said:\n" + end.mpirun_said;
  return what +
         ".\nWhat to try: see what they wrote last to fluid.log and particles.log, and whether the machine "
         "ran "
         "out of memory.";
}

}  // namespace

void write_last_results(const fs::path& folder, const CaseParameters& parameters,
                        const std::vector<std::string>& command, const End& end) {
  const fs::path file = folder / "results.json";
  if (fs::exists(file)) return;
  RunResults results;
  results.status = RunStatus::failed;
  results.configuration_hash = configuration_hash(parameters);
  results.configuration = resolved_configuration(parameters);
  results.command = fmt::format("{}", fmt::join(command, " "));
  results.ranks = {parameters.fluid.ranks, parameters.particles ? parameters.particles->ranks : 0};
  results.failure = first_note(folder);
  const auto progress = read_progress(folder / "progress.json");
  if (!results.failure)
    results.failure =
        RunFailure{"launcher", progress ? "run" : "start", progress ? progress->time : 0, how_it_ended(end)};
  if (progress) results.steps.windows = progress->window;
  write_results(file, results);
}

void remove_notes(const fs::path& folder) {
  std::error_code none;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, none))
    if (is_note(entry.path())) fs::remove(entry.path(), none);
}

}  // namespace demvof
