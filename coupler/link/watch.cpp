// SPDX-License-Identifier: GPL-3.0-or-later
#include "coupler/link/watch.hpp"

#include <fmt/format.h>
#include <poll.h>
#include <pthread.h>
#include <signal.h>
#include <sys/eventfd.h>
#include <sys/syscall.h>
#include <time.h>
#include <unistd.h>

#include <algorithm>
#include <cstdint>

#include "coupler/base/errors.hpp"
#include "coupler/link/crash.hpp"
#include "coupler/link/failure.hpp"
#include "coupler/link/run_stage.hpp"

namespace demvof {
namespace {

constexpr long turn_ms = 200;         // between two looks at processes whose end the kernel does not tell
constexpr long stop_turn_ms = 1000;   // ... at all, for those that are stopped
constexpr double longest_turn = 1;    // s: who comes back later was stopped
constexpr long last_word_ms = 200;    // for what an ended process has sent to come: all may be done
constexpr long main_thread_ms = 300;  // for a waiting main thread to report a loss itself
constexpr long linger_ms = 300;   // for the others to find the first death, not ours, and to have their say
constexpr long crash_ms = 500;    // for the others to find the death and its reason, before mpirun acts on it
constexpr long report_ms = 6000;  // for the main thread to report and end the process

const int bell = eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK);  // a signal handler may ring it

// Until one of the files can be read, or for so long; for ever where the time is negative. The first is the
// bell.
void wait_for(std::vector<pollfd>& files, long milliseconds) {
  std::uint64_t rung = 0;
  if (poll(files.data(), files.size(), static_cast<int>(milliseconds)) > 0 && files[0].revents != 0 &&
      read(bell, &rung, sizeof rung) < 0)
    return;  // somebody else has heard it
}

// A file that can be read when the process has ended; -1 where the kernel (before 5.3) has none, or no more.
int end_of(const Process& process) {
  return static_cast<int>(syscall(SYS_pidfd_open, static_cast<pid_t>(process.pid), 0));
}

double now() {
  timespec time;
  clock_gettime(CLOCK_MONOTONIC, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

// Signals are for the main thread: solvers' handlers expect to run there.
class SignalsBlocked {
 public:
  SignalsBlocked() {
    sigset_t all;
    sigfillset(&all);
    pthread_sigmask(SIG_SETMASK, &all, &before_);
  }
  ~SignalsBlocked() { pthread_sigmask(SIG_SETMASK, &before_, nullptr); }

 private:
  sigset_t before_;
};

}  // namespace

Watch::Watch(const Process& self, const std::vector<Process>& others, double longest_stop)
    : self_(self), longest_stop_(longest_stop), looked_(now()) {
  for (const Process& other : others) {
    if (other.host != self.host) continue;
    const int end = end_of(other);
    if (is_running(other))  // asked now: the pid may have been another's before
      watched_.push_back({other, end});
    else if (end >= 0)
      close(end);
  }
  const SignalsBlocked inherited_by_the_thread;
  thread_ = std::thread([this] { keep_watch(); });
}

Watch::~Watch() {
  quit_ = true;
  look_now();
  thread_.join();
  for (const Watched& other : watched_)
    if (other.end >= 0) close(other.end);
}

void Watch::look_now() {
  const std::uint64_t once = 1;
  if (write(bell, &once, sizeof once) < 0) return;  // rung often enough
}

void Watch::check() const {
  if (!lost_) return;
  if (loss_code_) throw FellowFailed(loss_, *loss_code_);
  throw PartnerLost(loss_);
}

const Process* Watch::find_ended() const {
  for (const Watched& other : watched_) {
    pollfd end = {other.end, POLLIN, 0};
    if (other.end >= 0 ? poll(&end, 1, 0) > 0 : !is_running(other.process)) return &other.process;
  }
  return nullptr;
}

const Process* Watch::find_stopped() {
  const double time = now(), turn = std::min(time - looked_, longest_turn);
  looked_ = time;
  for (Watched& other : watched_) {
    other.stopped = activity_of(other.process).state == 'T' ? other.stopped + turn : 0;
    if (other.stopped > longest_stop_) return &other.process;
  }
  return nullptr;
}

void Watch::wait_for_news() const {
  std::vector<pollfd> files = {{bell, POLLIN, 0}};
  long longest = longest_stop_ == 0 ? -1 : stop_turn_ms;
  for (const Watched& other : watched_) {
    if (standing_down_) break;
    if (other.end >= 0)
      files.push_back({other.end, POLLIN, 0});
    else
      longest = turn_ms;
  }
  wait_for(files, longest);
}

void Watch::keep_watch() {
  while (!quit_) {
    wait_for_news();
    if (const int number = crash_signal()) handle_crash(number);
    if (quit_ || standing_down_) continue;
    if (const Process* ended = find_ended()) {
      pause(last_word_ms);
      if (quit_ || standing_down_) continue;
      handle_loss(*ended);
      return;
    }
    if (longest_stop_ == 0) continue;
    if (const Process* stopped = find_stopped()) {
      handle_stop(*stopped);
      return;
    }
  }
}

void Watch::pause(long milliseconds) {
  std::vector<pollfd> only_the_bell = {{bell, POLLIN, 0}};
  for (long waited = 0; waited < milliseconds && !quit_ && !standing_down_; waited += 20)
    wait_for(only_the_bell, 20);
}

void Watch::handle_loss(const Process& ended) {
  int exit_code = exit_partner_lost;
  if (const std::optional<Failure> note = note_of(ended)) {
    heard_of(*note);
    loss_ = fmt::format("{}: {} failed:\n{}", self_.name(), ended.name(), note->message);
    if (ended.side == self_.side) exit_code = *(loss_code_ = note->exit_code);
    if (note->exit_code == exit_input) exit_code = exit_input;
  } else {
    loss_ = fmt::format(
        "{} lost {}: it was killed or ended without a word. This side was {}.\n"
        "What to try: see what it wrote last, and whether the machine ran out of memory.",
        self_.name(), ended.name(), run_stage().describe());
    heard_of(failure_here(ended.side, exit_partner_lost, loss_));
  }
  lost_ = true;
  if (main_waits_) pause(main_thread_ms);
  if (quit_ || standing_down_) return;
  if (claim_failure()) {
    Failure failure = *cause_heard();
    failure.exit_code = exit_code;
    leave_note(failure);
    report_failure(failure, loss_);
    pause(linger_ms);
    end_now(exit_code);
  }
  pause(report_ms);
  if (!quit_ && !standing_down_) end_now(exit_code);
}

void Watch::handle_stop(const Process& stopped) {
  if (!claim_failure()) return;
  const std::string text =
      fmt::format("{} waited {:g} s {} and gave up: {} is stopped.\nWhat to try: {}", self_.name(),
                  longest_stop_, run_stage().describe(), stopped.name(), advice_on_a_stop);
  const Failure failure = failure_here(self_.side, exit_partner_lost, text);
  leave_note(failure);
  report_failure(failure, text);
  pause(linger_ms);
  end_now(exit_partner_lost);
}

void Watch::handle_crash(int number) {
  const std::string text = fmt::format("{} stopped {}:\n{}", program_name(self_.side), run_stage().describe(),
                                       describe_crash(number, self_.side));
  if (claim_failure()) {
    const Failure failure = failure_here(self_.side, exit_failed, text);
    leave_note(failure);
    report_failure(failure, self_.rank == 0 ? text : fmt::format("[rank {}] {}", self_.rank, text));
    pause(crash_ms);
  }
  end_now(exit_failed);
}

}  // namespace demvof
