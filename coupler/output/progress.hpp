// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <chrono>
#include <filesystem>
#include <optional>

namespace demvof {

/// Where a run is: progress.json, written by foam_side and read by `demvof run`.
struct Progress {
  double begin_time = 0, time = 0, end_time = 0;  // simulated, s
  long window = 0, windows = 0;                   // done, in total
  double speed = 0;              // simulated seconds per wall second, over the last minute or so
  double remaining_seconds = 0;  // wall
  double worst_courant = 0;      // over the run so far, -
  long particles = 0;
  long fine_cells = 0;
};

/// Writes progress.json atomically, at most once per interval.
class ProgressFile {
 public:
  using Clock = std::chrono::steady_clock;

  explicit ProgressFile(std::filesystem::path path,
                        Clock::duration interval = std::chrono::milliseconds(500));

  /// Fills speed and remaining_seconds from the times of earlier calls, and writes if the interval
  /// has passed or the run is at its end. Failing to write is not an error of the run: ignored.
  void update(Progress progress, Clock::time_point now = Clock::now());

 private:
  std::filesystem::path path_;
  Clock::duration interval_;
  std::optional<Clock::time_point> last_write_;
  std::optional<Clock::time_point> last_call_;
  double last_time_ = 0;                     // simulated, s
  double simulated_sum_ = 0, wall_sum_ = 0;  // fading sums, s
};

/// The file's content; empty when there is none (yet) or it is not a progress file.
std::optional<Progress> read_progress(const std::filesystem::path& path);

}  // namespace demvof
