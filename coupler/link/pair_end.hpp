// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <stdexcept>
#include <string>
#include <vector>

#include "coupler/link/link.hpp"
#include "coupler/link/window_plan.hpp"

namespace demvof {

/// What both ends of a pair have in common: the link, the plan, and where in the run they are. The messages
/// of a run and their order: docs/protocol.md, and there alone FluidEnd and ParticleEnd. Calls are collective
/// over the program.
class PairEnd {
 public:
  PairEnd(const OwnWorld& world, const std::array<int, 3>& bulk_cells, double time_out_seconds)
      : link_(world, bulk_cells, time_out_seconds) {}

  /// This program's bulk cells.
  const BulkPartition& mine() const { return link_.mine(); }
  const LinkStatistics& statistics() const { return link_.statistics(); }

  /// As Link::handshake.
  std::string handshake(const std::vector<HandshakeItem>& items, const std::string& facts) {
    return link_.handshake(items, facts);
  }
  const WindowPlan& plan() const { return plan_; }

  /// Goes to the next window; false when the last one is done, or a side asked for an end.
  bool next_window() {
    if (!goes_on_ || done()) return false;
    ++number_;
    first_step_ += steps_;
    steps_ = 0;
    return true;
  }
  /// Number of the present window, from 1 (of the first from time 0 on), the times at its begin and end, and
  /// its length, s. Where windows have their own lengths the latter two are known from FluidEnd::set_steps
  /// and ParticleEnd::fluid on. Before the first one, end_time is when the run begins.
  long number() const { return number_; }
  double begin_time() const {
    return plan_.own_lengths() ? time_of_step(first_step_) : static_cast<double>(number_ - 1) * plan_.window;
  }
  double end_time() const {
    return plan_.own_lengths() ? time_of_step(first_step_ + steps_)
                               : static_cast<double>(number_) * plan_.window;
  }
  double window_length() const {
    return plan_.own_lengths() ? static_cast<double>(steps_) * plan_.steps.length : plan_.window;
  }
  /// Nothing was done before it.
  bool is_first() const { return !plan_.continues && number_ == plan_.windows_before + 1; }
  /// Its DEM steps, where windows have their own lengths.
  long steps() const { return steps_; }
  /// False once a side has asked for an end before that of the plan.
  bool goes_on() const { return goes_on_; }

  /// The last window of the plan is done: a stop asked for in it changes nothing.
  bool done() const {
    return plan_.own_lengths() ? first_step_ + steps_ >= plan_.steps.whole_run : number_ >= plan_.windows;
  }

  /// At the end of a window: whether both sides now write what the run can be continued from, and that both
  /// have. files: of this side (state_files.hpp); returned are the partner's.
  bool writes() const;
  std::string both_have_written(const std::string& files = "{}") { return link_.swap_text(files); }

  /// The orderly end, when both sides are done.
  void close() { link_.close(); }

 protected:
  template <class T>
  void require_one_per_fluid(const std::vector<T>& messages) const {
    if (static_cast<int>(messages.size()) != plan_.fluids)
      throw std::logic_error("PairEnd: not one message per fluid of the plan");
  }
  void start_with(const WindowPlan& plan) {
    plan_ = plan;
    number_ = plan.windows_before;
    first_step_ = plan.steps.before;
  }
  void agree() { goes_on_ = link_.agree_to_continue(); }

  Link link_;
  WindowPlan plan_;

  long first_step_ = 0, steps_ = 0;  // DEM steps before the present window, and of it

 private:
  /// s. To 15 digits, so that a time a user has written in decimals is that time.
  double time_of_step(long step) const;

  long number_ = 0;
  bool goes_on_ = true;
};

}  // namespace demvof
