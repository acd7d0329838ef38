// SPDX-License-Identifier: GPL-3.0-or-later
#include "coupler/output/restart_point.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>

#include "coupler/base/errors.hpp"
#include "coupler/output/write_file.hpp"

namespace demvof {
namespace {

namespace fs = std::filesystem;

constexpr auto latest = "latest.json";

fs::path folder_of_all(const fs::path& run) {
  return run / "restart";
}

void require_same(const fs::path& run, bool same, const std::string& key, const std::string& then) {
  if (!same)
    throw InputError(fmt::format("--continue: {} was {} in the run in {}; set it to that, or start a new run",
                                 key, then, run.string()));
}

void require_fit(const fs::path& run, const RestartPoint& point, const CaseParameters& now) {
  require_same(run, std::abs(point.window_length - now.coupling.window) <= 1e-12 * point.window_length,
               "coupling.window", fmt::format("{} s", point.window_length));
  require_same(run, now.bulk_grid && now.bulk_grid->cells == point.bulk_cells, "bulk_grid.cells",
               fmt::format("[{}]", fmt::join(point.bulk_cells, ", ")));
  require_same(run, now.fluid.ranks == point.fluid_ranks, "fluid.ranks", std::to_string(point.fluid_ranks));
  if (now.coupling.end_time < point.time + 0.5 * point.window_length)
    throw InputError(fmt::format("--continue: the run in {} is at {} s already; set coupling.end_time later",
                                 run.string(), point.time));
}

}  // namespace

fs::path restart_folder(const fs::path& run, long window) {
  return folder_of_all(run) / std::to_string(window);
}

void write_restart_point(const fs::path& run, const RestartPoint& point) {
  const nlohmann::ordered_json text = {
      {"window", point.window},         {"time", point.time},
      {"fluid_time", point.fluid_time}, {"window_length", point.window_length},
      {"bulk_cells", point.bulk_cells}, {"fluid_ranks", point.fluid_ranks}};
  write_file_atomically(folder_of_all(run) / latest, text.dump(1) + "\n");
  for (const fs::directory_entry& entry : fs::directory_iterator(folder_of_all(run)))
    if (entry.is_directory() && entry.path() != restart_folder(run, point.window)) fs::remove_all(entry);
}

void keep_earlier(const fs::path& run, const std::string& file) {
  if (!fs::exists(run / file)) return;
  const fs::path name(file);
  fs::path kept;
  for (int number = 1; kept.empty() || fs::exists(kept); ++number)
    kept = run / "earlier" / fmt::format("{}_{}{}", name.stem().string(), number, name.extension().string());
  fs::create_directories(kept.parent_path());
  publish_file(run / file, kept);
}

RestartPoint read_restart_point(const fs::path& run, const CaseParameters& parameters) {
  const fs::path path = folder_of_all(run) / latest;
  std::ifstream stream(path);
  if (!stream)
    throw InputError(
        fmt::format("--continue: there is no {}; a run of a pair leaves one at each field output "
                    "(output.interval) and at "
                    "its end",
                    path.string()));
  RestartPoint point;
  try {
    const auto text = nlohmann::json::parse(stream);
    text.at("window").get_to(point.window);
    text.at("time").get_to(point.time);
    text.at("fluid_time").get_to(point.fluid_time);
    text.at("window_length").get_to(point.window_length);
    text.at("bulk_cells").get_to(point.bulk_cells);
    text.at("fluid_ranks").get_to(point.fluid_ranks);
  } catch (const nlohmann::json::exception& error) {
    throw InputError(fmt::format("{}: {}", path.string(), error.what()));
  }
  require_fit(run, point, parameters);
  return point;
}

}  // namespace demvof
