// SPDX-License-Identifier: GPL-3.0-or-later
// q_seen += omega (q - q_seen), q = u, grad p, Du/Dt; omega of relaxation.hpp. Told is q_seen, and with order
// 2 what the fluid is expected to add to it by the window's middle (continuation.hpp).

#include "coupler/exchange/seen_fluid.hpp"

#include <algorithm>
#include <utility>

#include "coupler/exchange/continuation.hpp"
#include "coupler/exchange/momentum_exchange.hpp"
#include "coupler/exchange/relaxation.hpp"
#include "coupler/exchange/window_rule.hpp"

namespace demvof {

namespace {

void approach(Vec3& now, const Vec3& before, double omega) {
  if (omega < 1) now = before + omega * (now - before);
}

}  // namespace

double SeenFluid::factor(double density, double fluid_volume, const BulkParticles& simulated) const {
  const BulkParticles particles = ratio_ == 1 ? simulated : over_window(simulated, ratio_);
  const double gain = parameters_.fluid_moves ? making_way_gain(particles, density, fluid_volume) : 0;
  if (!hands_back_left_over(parameters_.exchange)) return relaxation_factor(parameters_.schedule, gain, 0);
  const double response = particles.drag_response * parameters_.window / (density * fluid_volume);
  PartlyHeld held = partly_held(particles, density, fluid_volume, parameters_.window);
  if (!parameters_.fluid_moves) held.solid = 0;
  return relaxation_factor(parameters_.schedule, gain, response, held);
}

void SeenFluid::relax(CellValues<BulkFluid>& fluid, const std::vector<double>& fluid_volume,
                      const CellValues<BulkParticles>& particles) {
  CellValues<Cell> seen;
  seen.cells = fluid.cells;
  factor_.assign(fluid.cells.size(), 1.0);
  acceleration_.clear();
  relaxed_ = {};
  const Vec3 heavier = std::exchange(gravity_change_, {});
  for (std::size_t i = 0; i < fluid.cells.size(); ++i) {
    BulkFluid& cell = fluid.values[i];
    const BulkFluid now = cell;
    const BulkParticles* here = find(particles, fluid.cells[i]);
    const Cell* before = find(seen_, fluid.cells[i]);
    if (here && before) {
      factor_[i] = factor(cell.density, fluid_volume[i], *here);
      approach(cell.velocity, before->velocity, factor_[i]);
      approach(cell.pressure_gradient, before->pressure_gradient + cell.density * heavier, factor_[i]);
      relaxed_.smallest = std::min(relaxed_.smallest, factor_[i]);
      relaxed_.cells += factor_[i] < 1;
    }
    Cell told = before ? *before : Cell{};
    told.velocity = cell.velocity;
    told.pressure_gradient = cell.pressure_gradient;
    told.ahead = {};
    told.fluid_velocity = now.velocity;
    told.fluid_gradient = now.pressure_gradient;
    ++told.tellings;
    acceleration_.push_back(0);
    if (here && before && parameters_.order == 2) {
      const double weight = continuation_weight(factor_[i]);
      told.ahead = 0.5 * ratio_ * weight * (now.velocity - before->fluid_velocity);
      cell.velocity += told.ahead;
      if (told.tellings > 2) {  // the first telling is of no window
        acceleration_[i] =
            weight * continued_acceleration(parameters_.added_mass * here->solid_volume / fluid_volume[i]);
        if (!parameters_.fluid_moves)
          cell.pressure_gradient += 0.5 * (1 + ratio_) * weight *
                                    (now.pressure_gradient - before->fluid_gradient - cell.density * heavier);
      }
    }
    seen.values.push_back(told);
  }
  seen_ = std::move(seen);
}

void SeenFluid::relax(CellValues<BulkFluidGradients>& gradients) {
  std::size_t at = 0;  // gradients are there for the cells of the fluid, or for some of them
  for (std::size_t i = 0; i < gradients.cells.size(); ++i) {
    while (seen_.cells[at] != gradients.cells[i]) ++at;
    Vec3& told = gradients.values[i].acceleration;
    Cell& seen = seen_.values[at];
    const Vec3 before = std::exchange(seen.fluid_acceleration, told);
    approach(told, seen.acceleration, factor_[at]);
    seen.acceleration = told;
    told += 0.5 * (1 + ratio_) * acceleration_[at] * (seen.fluid_acceleration - before);
  }
}

void SeenFluid::refer_to_own_cell(CellValues<BulkParticles>& particles) const {
  for (std::size_t i = 0; i < particles.cells.size(); ++i) {
    const Cell* seen = find(seen_, particles.cells[i]);
    if (!seen) continue;
    BulkParticles& cell = particles.values[i];
    Vec3& reference = cell.response_weighted_velocity;
    reference += free_share(cell) * (cell.drag_response * (seen->velocity + seen->ahead) - reference);
  }
}

CellValues<Vec3> SeenFluid::ahead() const {
  CellValues<Vec3> all{seen_.cells, {}};
  for (const Cell& cell : seen_.values) all.values.push_back(cell.ahead);
  return all;
}

}  // namespace demvof
