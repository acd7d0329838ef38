// SPDX-License-Identifier: GPL-3.0-or-later
#include "coupler/output/restart_point.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>

#include "coupler/base/checksum.hpp"
#include "coupler/base/errors.hpp"
#include "coupler/output/write_file.hpp"

namespace demvof {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

fs::path folder_of_all(const fs::path& run) {
  return run / "restart";
}
fs::path latest_file(const fs::path& run) {
  return folder_of_all(run) / "latest.json";
}
fs::path state_file(const fs::path& run, long window) {
  return restart_folder(run, window) / "state.json";
}

std::array<double, 3> corner(const Vec3& v) {
  return {v.x, v.y, v.z};
}
Vec3 vec3(const Json& json) {
  return {json.at(0), json.at(1), json.at(2)};
}

std::string text_of(const RestartPoint& point) {
  Json text = {{"version", point.written_by},
               {"window", point.window},
               {"time", point.time},
               {"fluid_time", point.fluid_time},
               {"window_length", point.frame.window_length},
               {"bulk_lower", corner(point.frame.bulk_lower)},
               {"bulk_upper", corner(point.frame.bulk_upper)},
               {"bulk_cells", point.frame.bulk_cells},
               {"fluid_ranks", point.frame.fluid_ranks},
               {"bulk_blocks", point.frame.bulk_blocks},
               {"schedule", point.frame.schedule},
               {"configuration", Json::parse(point.configuration)},
               {"files", Json::parse(to_text(point.files))}};
  text["checksum"] = Checksum().add(text.dump()).text();
  return text.dump(1) + "\n";
}

/// Throws InputError when the file is not there or not what text_of() made.
RestartPoint read(const fs::path& path) {
  std::ifstream stream;
  if (fs::is_regular_file(path)) stream.open(path);
  if (!stream.is_open()) throw InputError(fmt::format("there is no {}", path.string()));
  RestartPoint point;
  try {
    Json text = Json::parse(stream);
    point.written_by = text.value("version", "an unknown version");
    point.checksum = text.at("checksum");
    text.erase("checksum");
    if (Checksum().add(text.dump()).text() != point.checksum)
      throw InputError(fmt::format("{} is not what was written", path.string()));
    text.at("window").get_to(point.window);
    text.at("time").get_to(point.time);
    text.at("fluid_time").get_to(point.fluid_time);
    text.at("window_length").get_to(point.frame.window_length);
    point.frame.bulk_lower = vec3(text.at("bulk_lower"));
    point.frame.bulk_upper = vec3(text.at("bulk_upper"));
    text.at("bulk_cells").get_to(point.frame.bulk_cells);
    text.at("fluid_ranks").get_to(point.frame.fluid_ranks);
    point.frame.bulk_blocks = text.value("bulk_blocks", std::array<int, 3>{});
    point.frame.schedule = text.value("schedule", "");
    point.configuration = text.at("configuration").dump();
    point.files = state_files(text.at("files").dump());
    return point;
  } catch (const nlohmann::json::exception& error) {
    const std::string by = point.written_by == version() ? ""
                                                         : fmt::format(" (written by demvof {}; this is {})",
                                                                       point.written_by, version());
    throw InputError(fmt::format("{}: {}{}", path.string(), error.what(), by));
  }
}

/// Windows after which there is a folder of a state, whole or not, the newest first.
std::vector<long> windows_of_states(const fs::path& run) {
  std::vector<long> windows;
  std::error_code none;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder_of_all(run), none)) {
    const std::string name = entry.path().filename().string();
    long window = 0;
    const auto [end, error] = std::from_chars(name.data(), name.data() + name.size(), window);
    if (entry.is_directory() && error == std::errc() && end == name.data() + name.size() && window >= 0)
      windows.push_back(window);
  }
  std::sort(windows.rbegin(), windows.rend());
  return windows;
}

/// What to do instead of going on from a state that is damaged.
std::string offer(const fs::path& run, std::optional<long> damaged) {
  for (const long window : windows_of_states(run)) {
    if (window == damaged) continue;
    try {
      const RestartPoint other = read(state_file(run, window));
      if (find_damage(other.files, run, [](const std::string&) { return true; }).empty())
        return fmt::format(
            "The newest state that is whole is the one after window {}, t = {} s: go on from it with "
            "--continue --from {}",
            window, other.time, window);
    } catch (const InputError&) {
    }
  }
  return "There is no other state that is whole; start a new run";
}

/// Of those that a run makes.
void require_folders(const fs::path& run) {
  for (const char* name : {"restart", "earlier", "fluid", "particles", "bulk", "surfaces"})
    if (fs::exists(run / name) && !fs::is_directory(run / name))
      throw InputError(
          fmt::format("--continue: {} is no folder, but the run has to write there: move it away",
                      (run / name).string()));
}

void require_same(const fs::path& run, bool same, const std::string& key, const std::string& then) {
  if (!same)
    throw InputError(fmt::format("--continue: {} was {} in the run in {}; set it to that, or start a new run",
                                 key, then, run.string()));
}

/// A corner typed twice, against the size of the grid, m.
bool same_place(const Vec3& a, const Vec3& b, double size) {
  return norm(a - b) <= 1e-9 * size;
}

void require_fit(const fs::path& run, const RestartPoint& point, const StateFrame& now, double end_time) {
  const StateFrame& then = point.frame;
  require_same(run, std::abs(then.window_length - now.window_length) <= 1e-12 * then.window_length,
               "coupling.window",
               then.window_length > 0 ? fmt::format("{} s", then.window_length)
                                      : "a map: windows of their own lengths");
  require_same(run, then.schedule.empty() || now.schedule == then.schedule, "coupling.schedule",
               then.schedule);
  require_same(run, now.bulk_cells == then.bulk_cells, "bulk_grid.cells",
               fmt::format("[{}]", fmt::join(then.bulk_cells, ", ")));
  const double size = norm(then.bulk_upper - then.bulk_lower);
  require_same(run, same_place(then.bulk_lower, now.bulk_lower, size), "bulk_grid.lower",
               fmt::format("[{}]", fmt::join(corner(then.bulk_lower), ", ")));
  require_same(run, same_place(then.bulk_upper, now.bulk_upper, size), "bulk_grid.upper",
               fmt::format("[{}]", fmt::join(corner(then.bulk_upper), ", ")));
  require_same(run, now.fluid_ranks == 0 || now.fluid_ranks == then.fluid_ranks, "fluid.ranks",
               std::to_string(then.fluid_ranks));
  if (end_time < point.time + 0.5 * then.window_length || end_time <= point.time * (1 + 1e-9))
    throw InputError(fmt::format("--continue: the run in {} is at {} s already; set coupling.end_time later",
                                 run.string(), point.time));
}

void remove_states(const fs::path& run, const std::vector<long>& windows) {
  for (const long window : windows) {
    // First what makes it a state, so that no half of one is ever taken for whole.
    fs::remove(state_file(run, window));
    fs::remove_all(restart_folder(run, window));
  }
}

}  // namespace

fs::path restart_folder(const fs::path& run, long window) {
  return folder_of_all(run) / std::to_string(window);
}

void write_restart_point(const fs::path& run, const RestartPoint& point, int kept) {
  const std::string text = text_of(point);
  write_file_atomically(state_file(run, point.window), text, Durable::yes);
  write_file_atomically(latest_file(run), text, Durable::yes);
  std::vector<long> others;
  int newest = 0;
  for (const long window : windows_of_states(run))
    if (window > point.window || !fs::exists(state_file(run, window)) || ++newest > kept)
      others.push_back(window);
  remove_states(run, others);
}

void go_back_to(const fs::path& run, const RestartPoint& point) {
  write_file_atomically(latest_file(run), text_of(point), Durable::yes);
  std::vector<long> later = windows_of_states(run);
  later.erase(std::remove_if(later.begin(), later.end(), [&](long window) { return window <= point.window; }),
              later.end());
  remove_states(run, later);
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

RestartPoint read_restart_point(const fs::path& run, std::optional<long> window, const StateFrame& now,
                                double end_time) {
  require_folders(run);
  RestartPoint point;
  try {
    point = read(window ? state_file(run, *window) : latest_file(run));
  } catch (const InputError& error) {
    if (windows_of_states(run).empty())
      throw InputError(
          fmt::format("--continue: {}; a run of a pair leaves one at each field output (output.interval) and "
                      "at its end",
                      error.what()));
    throw InputError(fmt::format("--continue: {}. {}", error.what(), offer(run, window)));
  }
  require_fit(run, point, now, end_time);
  return point;
}

void require_whole(const fs::path& run, const RestartPoint& point,
                   const std::function<bool(const std::string& name)>& wanted) {
  const std::string damage = find_damage(point.files, run, wanted);
  if (!damage.empty())
    throw InputError(fmt::format("--continue: the state after window {} is damaged: {}. {}", point.window,
                                 (run / damage).string(), offer(run, point.window)));
}

std::vector<std::string> changed_keys(const std::string& before, const std::string& now) {
  const Json then = Json::parse(before).flatten(), present = Json::parse(now).flatten();
  const auto name = [](std::string pointer) {
    std::replace(pointer.begin(), pointer.end(), '/', '.');
    return pointer.substr(1);
  };
  std::vector<std::string> lines;
  for (const auto& [pointer, value] : then.items())
    if (!present.contains(pointer))
      lines.push_back(fmt::format("{}: {}, now not given", name(pointer), value.dump()));
    else if (present[pointer] != value)
      lines.push_back(fmt::format("{}: {}, now {}", name(pointer), value.dump(), present[pointer].dump()));
  for (const auto& [pointer, value] : present.items())
    if (!then.contains(pointer)) lines.push_back(fmt::format("{}: now {}", name(pointer), value.dump()));
  return lines;
}

}  // namespace demvof
