// SPDX-License-Identifier: GPL-3.0-or-later
#include "coupler/link/patience.hpp"

#include <fmt/format.h>
#include <sched.h>
#include <time.h>

#include <algorithm>

#include "coupler/base/errors.hpp"
#include "coupler/link/run_stage.hpp"

namespace demvof {
namespace {

// An answer that is on its way is met at once; after that a pause is a tenth of what was waited so far:
// being late costs at most that, and a long wait costs next to no CPU time.
constexpr double without_pause = 50e-6;                                              // s
constexpr double shortest_pause = 20e-6, longest_pause = 1e-3, share_of_wait = 0.1;  // s, s, -

double now() {
  timespec time;
  clock_gettime(CLOCK_MONOTONIC, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

}  // namespace

Patience::Patience(const OwnWorld& world, double time_out_seconds)
    : world_(world), time_out_(time_out_seconds) {
  std::vector<Process> partners;
  for (const Process& process : world.pair().processes)
    if (process.side != world.side()) partners.push_back(process);
  set_up_.emplace(world.self(), partners);
}

Patience::Wait::Wait(Patience& patience) : patience_(patience), begin_(now()) {
  patience_.world_.pair().watch->main_thread_waits(true);
  if (patience_.set_up_) patience_.set_up_->silence();
}

Patience::Wait::~Wait() {
  patience_.world_.pair().watch->main_thread_waits(false);
}

double Patience::Wait::seconds() const {
  return now() - begin_;
}

bool Patience::Wait::sleep() {
  patience_.world_.pair().watch->check();
  patience_.listen();
  const double waited = seconds();
  if (waited < without_pause) {
    sched_yield();
    return false;
  }
  const double pause = std::clamp(share_of_wait * waited, shortest_pause, longest_pause);
  const timespec time{0, static_cast<long>(1e9 * pause)};
  nanosleep(&time, nullptr);  // a signal may end it early
  return waited > patience_.time_out_ &&
         (!patience_.set_up_ || patience_.set_up_->silence() > patience_.time_out_);
}

void Patience::listen() const {
  const auto cry = world_.pair().alarm->listen();
  if (!cry) return;
  const Process& crier = world_.pair().processes[cry->from];
  heard_of(cry->failure);
  const std::string text =
      fmt::format("{}: {} failed:\n{}", world_.self().name(), crier.name(), cry->failure.message);
  if (crier.side == world_.side()) throw FellowFailed(text, cry->failure.exit_code);
  throw PartnerFailed(text);
}

void Patience::give_up(const std::string& waiting_for) const {
  const std::string text = fmt::format(
      "{} waited {:g} s for {} ({}) and gave up.\n"
      "What to try: look whether the partner is stuck; raise coupling.time_out if its windows "
      "take that long.",
      world_.self().name(), time_out_, waiting_for, run_stage().describe());
  const Side silent = world_.side() == Side::fluid ? Side::particles : Side::fluid;
  heard_of(failure_here(silent, exit_partner_lost, text));
  throw PartnerLost(text);
}

}  // namespace demvof
