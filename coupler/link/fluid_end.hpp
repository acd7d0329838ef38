// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>

#include "coupler/exchange/particle_report.hpp"
#include "coupler/link/pair_end.hpp"

namespace demvof {

/// The fluid's end of the pair: its part of every message of a run, in their order.
class FluidEnd : public PairEnd {
 public:
  using PairEnd::PairEnd;

  /// After the handshake: the particles hear what they have to send and to expect.
  void send_plan(const WindowPlan& plan);

  /// surface: all cells that hold liquid, with two fluids. Returned: the particles before the first window.
  struct Start {
    std::vector<CellValues<BulkParticles>> particles;  // by fluid
    ParticleReport report;
  };
  Start start(const Openings& openings, const CellValues<BulkSurface>& surface = {});

  /// Where windows have their own lengths, after next_window: this one has at most so many DEM steps, and no
  /// more than equal parts of what is left to the next output.
  void set_steps(long wanted);

  /// One window: tells the particles the fluid, lets the fluid advance and takes what the particles did, in
  /// the order of the plan's schedule.
  void window(const FluidMessage& fluid, const std::function<void()>& advance,
              const std::function<void(ParticleMessage)>& take);

  /// The particles' report of the window; agrees with them whether to go on.
  ParticleReport close_window();
};

}  // namespace demvof
