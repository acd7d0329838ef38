// SPDX-License-Identifier: GPL-3.0-or-later
#include "coupler/link/waiting.hpp"

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
constexpr double without_pause = 50e-6;  // s
constexpr double longest_turn = 1;       // s: who comes back later was stopped
constexpr double shortest_pause = 20e-6, longest_pause = 1e-3, share_of_wait = 0.1;  // s, s, -

double now() {
  timespec time;
  clock_gettime(CLOCK_MONOTONIC, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

}  // namespace

Waiting::Waiting(const OwnWorld& world, double time_out_seconds)
    : world_(world), time_out_(time_out_seconds) {
  std::vector<Process> partners;
  for (const Process& process : world.pair().processes)
    if (process.side != world.side()) partners.push_back(process);
  set_up_.emplace(world.self(), partners);
}

Waiting::Wait::Wait(Waiting& waiting) : waiting_(waiting), begin_(now()), looked_(begin_) {
  waiting_.world_.pair().watch->main_thread_waits(true);
  if (waiting_.set_up_) waiting_.set_up_->silence();
}

Waiting::Wait::~Wait() {
  waiting_.world_.pair().watch->main_thread_waits(false);
}

double Waiting::Wait::seconds() const {
  return now() - begin_;
}

bool Waiting::Wait::sleep() {
  waiting_.world_.pair().watch->check();
  waiting_.throw_received();
  const double time = now(), waited = time - begin_;
  awake_ += std::min(time - looked_, longest_turn);
  looked_ = time;
  if (waited < without_pause) {
    sched_yield();
    return false;
  }
  const double pause = std::clamp(share_of_wait * waited, shortest_pause, longest_pause);
  const timespec turn{0, static_cast<long>(1e9 * pause)};
  nanosleep(&turn, nullptr);  // a signal may end it early
  return awake_ > waiting_.time_out_ &&
         (!waiting_.set_up_ || waiting_.set_up_->silence() > waiting_.time_out_);
}

void Waiting::throw_received() const {
  const auto notice = world_.pair().failure_signal->receive();
  if (!notice) return;
  const Process& sender = world_.pair().processes[notice->from];
  heard_of(notice->failure);
  const int code = notice->failure.exit_code;
  const std::string who = fmt::format("{}: {}", world_.self().name(), sender.name());
  const std::string text = fmt::format("{} failed:\n{}", who, notice->failure.message);
  if (sender.side == world_.side()) throw FellowFailed(text, code);
  if (code == exit_input) throw PartnerFailed(who + " refuses the input, and says why.");
  throw PartnerFailed(text);
}

void Waiting::give_up(const std::string& waiting_for) const {
  const auto& all = world_.pair().processes;
  const auto stopped = std::find_if(all.begin(), all.end(), [this](const Process& process) {
    return process.host == world_.self().host && activity_of(process).state == 'T';
  });
  const bool found = stopped != all.end();
  const std::string text = fmt::format(
      "{} waited {:g} s for {} ({}) and gave up{}.\nWhat to try: {}", world_.self().name(), time_out_,
      waiting_for, run_stage().describe(), found ? fmt::format(": {} is stopped", stopped->name()) : "",
      found ? advice_on_a_stop
            : "look whether the partner is stuck; raise coupling.time_out if its windows take that long.");
  heard_of(failure_here(found ? stopped->side : partner_of(world_.side()), exit_partner_lost, text));
  throw PartnerLost(text);
}

}  // namespace demvof
