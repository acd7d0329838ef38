// SPDX-License-Identifier: GPL-3.0-or-later
#include "coupler/link/signs_of_life.hpp"

#include <algorithm>
#include <chrono>

namespace demvof {
namespace {

// Of a core, since the last sign. A process that waits in our own loops, or in MPI's, is above; the watching
// thread of one whose main thread is stuck is far below.
constexpr double working_share = 0.005;
constexpr double longest_turn = 10;  // s, between two looks of a process that waits

double now() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

}  // namespace

SignsOfLife::SignsOfLife(const Process& self, const std::vector<Process>& others) {
  for (const Process& other : others)
    if (other.host == self.host) seen_.push_back({other, 0, now()});
}

double SignsOfLife::silence() {
  const double time = now();
  if (time - last_look_ < 1) return silence_;
  // After a pause of this process itself nothing is known of the others: their time begins anew.
  const bool was_away = time - last_look_ > longest_turn;
  last_look_ = time;
  silence_ = 0;
  for (Seen& one : seen_) {
    const Activity activity = activity_of(one.process);
    const double share = (activity.cpu_seconds - one.cpu_seconds) / std::max(1e-9, time - one.time);
    if (was_away || activity.state == 'D' || (activity.state != 'T' && share > working_share)) {
      one.cpu_seconds = activity.cpu_seconds;
      one.time = time;
    }
    silence_ = std::max(silence_, time - one.time);
  }
  return silence_;
}

}  // namespace demvof
