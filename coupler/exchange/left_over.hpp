// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "coupler/grid/bulk_cells.hpp"

namespace demvof {

/// Impulse that the implicit part of the exchange gave the fluid of each bulk cell and that the cell's
/// particles still have to receive (momentum_exchange.hpp): collected during a window, owed from its end on,
/// handed over with the next telling. On the bulk cells of one rank.
class LeftOver {
 public:
  /// Owed to the particles of a bulk cell.
  struct Owed {
    Vec3 impulse;             // N s
    double solid_volume = 0;  // sum of w V of those that left it over, m3
  };

  /// Adds what the fluid's cells lost since begin of the window or the last call, N s. particles: of this
  /// window; where there are none nothing is owed.
  void collect(const CellValues<Vec3>& impulse, const CellValues<BulkParticles>& particles);

  /// What was collected is owed now. What has been handed over is forgotten; what has not stays owed.
  void end_window(const CellValues<BulkParticles>& particles);

  /// The particles have moved on. What they do not take (share_for_particles) goes back to the fluid of its
  /// cell, as if they had been given so much less drag; cells that they have left are put in for it.
  void return_to_fluid(CellValues<BulkParticles>& particles);

  /// Hands over what is owed, with the fluid of its cell. What has no cell there (a surface has left it) goes
  /// back to the fluid when the particles have moved on.
  void hand_over(CellValues<BulkFluid>& fluid);

  const CellValues<Owed>& owed() const { return owed_; }
  /// Of what is owed at the end of the window, that which could not be handed over in it, N s.
  const Vec3& kept() const { return kept_; }
  void go_on_from(CellValues<Owed> owed) { owed_ = std::move(owed); }

 private:
  CellValues<Vec3> collected_;  // of this window so far, N s
  CellValues<Owed> owed_;
  Vec3 kept_;
};

}  // namespace demvof
