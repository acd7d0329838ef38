// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "coupler/exchange/particle_report.hpp"
#include "coupler/link/pair_end.hpp"

namespace demvof {

/// The particles' end of the pair: the counterpart of FluidEnd, call by call.
class ParticleEnd : public PairEnd {
 public:
  using PairEnd::PairEnd;

  /// After the handshake.
  const WindowPlan& receive_plan();

  /// What the fluid's mesh leaves of the bulk grid at the start.
  Openings openings();
  /// With two fluids, after that: all cells that hold liquid.
  CellValues<BulkSurface> surface() { return link_.receive<BulkSurface>(); }
  /// Ends the start: the particles before the first window.
  void start(const std::vector<CellValues<BulkParticles>>& particles, const ParticleReport& report);

  /// The fluid at the start of the window, whatever the schedule.
  FluidMessage fluid();
  /// What the particles did in it.
  void send(const ParticleMessage& particles);
  /// Reports the window; agrees with the fluid whether to go on.
  void close_window(const ParticleReport& report);
};

}  // namespace demvof
