// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "coupler/transfer/bulk_walls.hpp"
#include "foam_side/bulk_cut.hpp"

namespace demvof {

/// What the mesh leaves of the bulk grid to the fluid. Walls: faces of the bulk grid through which the mesh
/// lets nothing pass, though it fills both cells beside them: walls and baffles that lie on them. A wall
/// inside a bulk cell, or one that closes a part of a face only, is not seen. All calls are collective over
/// the fluid side; cells are those owned by this rank.
class OpeningsToBulk {
 public:
  /// Looks at the mesh for the first time. Refers to the cut.
  explicit OpeningsToBulk(const BulkCut& cut);

  /// What the particles were told last.
  const Openings& told() const { return state_.told; }

  /// Windows for which a cell has to have fluid to hold particles. What they leave behind in a cell is in the
  /// fluid's books for a window more (owed_pressure.hpp), with the concurrent schedule for two, and motion
  /// may grow faster.
  static constexpr int windows_ahead = 4;

  /// Of a mesh that moves: what they are told now. They are to have fluid around them to the end of the
  /// window: cells that the mesh will have left in so many windows, going on as in the last one, or fills by
  /// less than 1 %, hold none. ahead: length of the coming ones over that of the last, -. Throws RunError
  /// when the mesh has left the bulk grid.
  const Openings& look(double ahead = windows_ahead);

  /// For a run that goes on, which begins with it.
  struct State {
    Openings told;
    CellValues<double> shares;  // as they were at the last look
  };
  const State& state() const { return state_; }
  void go_on_from(State state) { state_ = std::move(state); }

 private:
  Openings find() const;

  const BulkCut& cut_;
  State state_;
};

}  // namespace demvof
