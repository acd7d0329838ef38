// SPDX-License-Identifier: GPL-3.0-or-later
#include "coupler/output/progress.hpp"

#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "coupler/output/write_file.hpp"

namespace demvof {

namespace {

constexpr double memory_seconds = 60;  // wall time over which the speed is averaged

double seconds(ProgressFile::Clock::duration duration) {
  return std::chrono::duration<double>(duration).count();
}

}  // namespace

ProgressFile::ProgressFile(std::filesystem::path path, Clock::duration interval)
    : path_(std::move(path)), interval_(interval) {}

void ProgressFile::update(Progress progress, Clock::time_point now) {
  if (last_call_) {
    const double wall = seconds(now - *last_call_), fade = std::exp(-wall / memory_seconds);
    wall_sum_ = fade * wall_sum_ + wall;
    simulated_sum_ = fade * simulated_sum_ + progress.time - last_time_;
  }
  last_call_ = now;
  last_time_ = progress.time;

  const bool at_end = progress.windows > 0 && progress.window >= progress.windows;
  if (last_write_ && now - *last_write_ < interval_ && !at_end) return;
  last_write_ = now;
  progress.speed = wall_sum_ > 0 ? simulated_sum_ / wall_sum_ : 0;
  progress.remaining_seconds =
      progress.speed > 0 ? std::max(0.0, progress.end_time - progress.time) / progress.speed : 0;
  const nlohmann::ordered_json content = {{"begin_time", progress.begin_time},
                                          {"time", progress.time},
                                          {"end_time", progress.end_time},
                                          {"window", progress.window},
                                          {"windows", progress.windows},
                                          {"speed", progress.speed},
                                          {"remaining_seconds", progress.remaining_seconds},
                                          {"worst_courant", progress.worst_courant},
                                          {"particles", progress.particles},
                                          {"fine_cells", progress.fine_cells}};
  try {
    write_file_atomically(path_, content.dump() + "\n");
  } catch (const std::runtime_error&) {
    // A run is worth more than its progress bar.
  }
}

std::optional<Progress> read_progress(const std::filesystem::path& path) {
  std::ifstream file(path);
  const nlohmann::json content = nlohmann::json::parse(file, nullptr, false);
  if (!content.is_object()) return std::nullopt;
  try {
    Progress progress;
    progress.begin_time = content.at("begin_time");
    progress.time = content.at("time");
    progress.end_time = content.at("end_time");
    progress.window = content.at("window");
    progress.windows = content.at("windows");
    progress.speed = content.at("speed");
    progress.remaining_seconds = content.at("remaining_seconds");
    progress.worst_courant = content.at("worst_courant");
    progress.particles = content.at("particles");
    progress.fine_cells = content.at("fine_cells");
    return progress;
  } catch (const nlohmann::json::exception&) {
    return std::nullopt;
  }
}

}  // namespace demvof
