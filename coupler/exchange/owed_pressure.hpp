// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Momentum of the pressure, between a fluid that knows it when the window is done and particles that are told
// of it when it begins.
//
//   O += left + g (V_e - V_s) dt_w - told
//
//     left  what the fluid's equation left to the particles of a bulk cell in the window,
//           -sum of dt (1 - eps) V grad p, N s;  g: over the sum of dt (1 - eps) V, the mean gradient
//     told  what they were given, -V_s grad p_seen dt_w, V_s: their volume when it was told
//     V_e   mean of V_s over the fluid's steps, by the void fraction that moves on in the window
//
//   grad p_seen = grad p - eta O/(V_s dt_w),   eta = omega/2, in a window shorter than the one before times
//                                              dt_w over its length: so much has come of the longer one
//
// The particles are given the pressure of where they were when it was told. -g (V_e - V_s) dt_w was left
// where they were not, and the fluid of the cell gets it back: owed to those who come there, it would pull a
// single sphere back by 1 % of its weight.
//
// So what one side loses the other gets, a window or some later. grad p is relaxed (relaxation.hpp) with
// omega where fluid and particles push each other about; returned faster than that the difference would undo
// it. With a pressure that answers the particles as -mu grad p_seen both together are stable while 4 - 3 a +
// a eta > 0, a = omega (1 + mu), and the relaxation keeps a below 1.2.

#include <map>

#include "coupler/exchange/left_over.hpp"
#include "coupler/grid/bulk_cells.hpp"

namespace demvof {

/// Impulse of the fluid's pressure that the particles of each bulk cell are still owed. On the cells of one
/// rank.
class OwedPressure {
 public:
  /// Adds a part of what is owed to the gradient that the particles are told, and notes what they are given.
  /// relaxation: omega, per cell of fluid; particles: those that will hear it; window: dt_w, s; pace: of the
  /// return, its length over that of the window before if that was longer, else 1.
  void tell(CellValues<BulkFluid>& fluid, const std::vector<double>& relaxation,
            const CellValues<BulkParticles>& particles, double window, double pace = 1);

  /// What the fluid's equation left to the particles of a cell in a part of the window.
  struct Left {
    Vec3 impulse;             // N s
    double exposed = 0;       // sum of dt (1 - eps) V, m3 s
    double solid_volume = 0;  // V_e of that part, m3
  };
  /// step: of the fluid, s.
  void collect(const CellValues<Left>& left, double step);

  /// What was collected is owed, less what they were told. particles: of this window.
  void end_window(const CellValues<BulkParticles>& particles);

  /// The particles have moved on: what they do not take (share_for_particles) goes back to the fluid of its
  /// cell, as if they had been given so much less drag; cells that they have left are put in for it.
  void return_to_fluid(CellValues<BulkParticles>& particles);

  /// Sums, N s: owed at the end of a window, what is on its way back to the fluid included; told in it; and
  /// gone back to the fluid in it: a concurrent fluid gets in its next window what particles have left.
  Vec3 owed_in_all() const;
  const Vec3& seen() const { return seen_; }
  const Vec3& returned() const { return returned_; }
  /// Sum over the cells of the size of what was returned, N s: it may cancel.
  double turnover() const { return turnover_; }

  /// What the last telling kept back because it would have changed a gradient by too much.
  struct HeldBack {
    long cells = 0;
    double impulse = 0;  // N s, summed by its size in each bulk cell
    double told = 0;     // what the fluid gave in that telling, likewise
    bool matters() const { return impulse > 1e-6 * told; }
  };
  const HeldBack& held_back() const { return held_back_; }

  struct State {
    CellValues<LeftOver::Owed> owed;
    CellValues<Vec3> elsewhere;   // goes back to the fluid, N s
    CellValues<double> steepest;  // gradient where something is owed, Pa/m
    Vec3 on_its_way;              // went back to the fluid with the last rows, N s
    double turnover = 0;          // of that, N s
  };
  State state() const;
  void go_on_from(const State& state);

 private:
  std::map<CellId, LeftOver::Owed> owed_;
  struct Seen {
    double solid_volume = 0;  // m3
    Vec3 gradient;            // without what was owed, Pa/m
  };
  std::map<CellId, Seen> heard_;       // by whom, in this window
  std::map<CellId, Vec3> open_;        // of this window: left less told so far, N s
  std::map<CellId, Vec3> elsewhere_;   // left where they were not, N s
  std::map<CellId, double> steepest_;  // gradient that the fluid has had where something is owed, Pa/m
  Vec3 seen_, returned_, on_its_way_;
  double turnover_ = 0, turnover_on_its_way_ = 0;
  HeldBack held_back_;
};

}  // namespace demvof
