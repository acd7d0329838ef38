// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <atomic>
#include <string>

namespace demvof {

/// What this process is doing, so that every message about its end can say so. One per process,
/// may be read from any thread.
class RunStage {
 public:
  /// stage: a text that lives for ever (a literal), in the words of the main loop. time: simulated, s.
  void set(const char* stage, double time) {
    stage_ = stage;
    time_ = time;
  }
  void set(const char* stage) { stage_ = stage; }

  const char* stage() const { return stage_; }
  double time() const { return time_; }
  /// "in stage 'DEM steps' at t = 0.125 s"
  std::string describe() const;

 private:
  std::atomic<const char*> stage_{"start"};
  std::atomic<double> time_{0};
};

RunStage& run_stage();

}  // namespace demvof
