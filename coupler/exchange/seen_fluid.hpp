// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "coupler/exchange/exchange_parameters.hpp"
#include "coupler/grid/bulk_cells.hpp"

namespace demvof {

/// What the particles are told of the fluid, on the bulk cells of one rank: the fluid as it is, or relaxed
/// towards it from what they were told before (relaxation.hpp says by how much and why), or ahead of it, of
/// the window's middle (continuation.hpp).
class SeenFluid {
 public:
  struct Parameters {
    Schedule schedule = Schedule::staggered;
    ExchangeScheme exchange = ExchangeScheme::conservative_implicit;
    double window = 0;         // s
    bool fluid_moves = false;  // the fluid makes way for particles: porosity
    int order = 1;             // in the window: 2 continues the fluid to the window's middle
    double added_mass = 0;     // C_m, -
  };
  explicit SeenFluid(const Parameters& parameters) : parameters_(parameters) {}

  /// The coming window's length, s. The particles that will hear the fluid are of the window before.
  void set_window(double window) {
    ratio_ = parameters_.window > 0 ? window / parameters_.window : 1;
    parameters_.window = window;
  }

  /// From the next telling on gravity is another one, by so much, m/s2: fluid and particles have it at once,
  /// and what was told before is that before with the new weight.
  void change_gravity(const Vec3& by) { gravity_change_ += by; }

  /// Velocity and pressure gradient, relaxed in place; they count as told. fluid_volume: of these cells,
  /// between the particles, m3; particles: those that will hear it. A cell whose particles were told nothing
  /// before is told the fluid as it is.
  void relax(CellValues<BulkFluid>& fluid, const std::vector<double>& fluid_volume,
             const CellValues<BulkParticles>& particles);

  /// The acceleration, after that, with the factors of the same cells.
  void relax(CellValues<BulkFluidGradients>& gradients);

  /// Particles feel the mean of several cells, and are free to go with it: no reason for the fluid of each
  /// cell to go there. Of the share in the response that nothing holds, the reference is what their own cell
  /// was told. particles: that have felt what was told last.
  void refer_to_own_cell(CellValues<BulkParticles>& particles) const;

  /// omega of the cells that were told last.
  const std::vector<double>& factors() const { return factor_; }

  /// What the last telling came to.
  struct Relaxed {
    double smallest = 1;  // relaxation factor, -
    long cells = 0;       // with a factor below 1
  };
  const Relaxed& relaxed() const { return relaxed_; }

  /// What the particles of a bulk cell were last told, but for what was continued; and the fluid as it was
  /// then.
  struct Cell {
    Vec3 velocity, pressure_gradient, acceleration;           // m/s, Pa/m, m/s2
    Vec3 ahead;                                               // told less `velocity`, m/s: half of D
    Vec3 fluid_velocity, fluid_gradient, fluid_acceleration;  // m/s, Pa/m, m/s2
    double tellings = 0;                                      // one after the other, this one included
    Vec3 expected_at_end() const { return velocity + 2 * ahead; }
  };
  const CellValues<Cell>& cells() const { return seen_; }
  /// `ahead` of each of them.
  CellValues<Vec3> ahead() const;
  void go_on_from(CellValues<Cell> seen) { seen_ = std::move(seen); }

 private:
  double factor(double density, double fluid_volume, const BulkParticles& simulated) const;

  Parameters parameters_;
  Vec3 gravity_change_;  // since the last telling, m/s2
  double ratio_ = 1;     // of the coming window to the particles', -
  CellValues<Cell> seen_;
  std::vector<double> factor_;        // of these, -
  std::vector<double> acceleration_;  // of these, w_a, -
  Relaxed relaxed_;
};

}  // namespace demvof
