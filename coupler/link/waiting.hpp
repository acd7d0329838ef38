// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>

#include "coupler/link/own_world.hpp"
#include "coupler/link/signs_of_life.hpp"

namespace demvof {

/// Waiting for others without burning a core, not for ever, and not for the dead.
class Waiting {
 public:
  /// Until set_up_done() the time-out counts from the last sign of life of the partner's processes, not from
  /// the start of a wait: reading a mesh, or settling a bed, takes as long as it takes. Time in which this
  /// process was itself stopped does not count.
  Waiting(const OwnWorld& world, double time_out_seconds);
  void set_up_done() { set_up_.reset(); }

  /// Polls done() with growing pauses until it is true. Throws PartnerLost or FellowFailed when a rank
  /// of the partner or of this side fails, and PartnerLost when a process ends or the time-out
  /// passes; waiting_for: what and from whom, for the message. Returns the seconds waited.
  template <class Done, class Words>
  double wait(Done done, Words waiting_for) {
    if (done()) return 0;
    Wait wait(*this);
    while (!done()) wait.pause(waiting_for);
    return wait.seconds();
  }

 private:
  class Wait {
   public:
    explicit Wait(Waiting& waiting);
    ~Wait();
    double seconds() const;
    template <class Words>
    void pause(Words waiting_for) {
      if (sleep()) waiting_.give_up(waiting_for());
    }

   private:
    bool sleep();  // true when the time-out has passed
    Waiting& waiting_;
    double begin_, looked_, awake_ = 0;
  };
  [[noreturn]] void give_up(const std::string& waiting_for) const;
  void throw_received() const;

  const OwnWorld& world_;
  double time_out_;
  std::optional<SignsOfLife> set_up_;
};

}  // namespace demvof
