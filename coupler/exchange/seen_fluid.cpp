// SPDX-License-Identifier: GPL-3.0-or-later
// q_seen += omega (q - q_seen), q = u, grad p, Du/Dt; omega of relaxation.hpp.

#include "coupler/exchange/seen_fluid.hpp"

#include <algorithm>

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
  relaxed_ = {};
  for (std::size_t i = 0; i < fluid.cells.size(); ++i) {
    BulkFluid& cell = fluid.values[i];
    const BulkParticles* here = find(particles, fluid.cells[i]);
    const Cell* before = find(seen_, fluid.cells[i]);
    if (here && before) {
      factor_[i] = factor(cell.density, fluid_volume[i], *here);
      approach(cell.velocity, before->velocity, factor_[i]);
      approach(cell.pressure_gradient, before->pressure_gradient, factor_[i]);
      relaxed_.smallest = std::min(relaxed_.smallest, factor_[i]);
      relaxed_.cells += factor_[i] < 1;
    }
    seen.values.push_back({cell.velocity, cell.pressure_gradient, before ? before->acceleration : Vec3{}});
  }
  seen_ = std::move(seen);
}

void SeenFluid::relax(CellValues<BulkFluidGradients>& gradients) {
  std::size_t at = 0;  // gradients are there for the cells of the fluid, or for some of them
  for (std::size_t i = 0; i < gradients.cells.size(); ++i) {
    while (seen_.cells[at] != gradients.cells[i]) ++at;
    approach(gradients.values[i].acceleration, seen_.values[at].acceleration, factor_[at]);
    seen_.values[at].acceleration = gradients.values[i].acceleration;
  }
}

void SeenFluid::refer_to_own_cell(CellValues<BulkParticles>& particles) const {
  for (std::size_t i = 0; i < particles.cells.size(); ++i) {
    const Cell* seen = find(seen_, particles.cells[i]);
    if (!seen) continue;
    BulkParticles& cell = particles.values[i];
    Vec3& reference = cell.response_weighted_velocity;
    reference += free_share(cell) * (cell.drag_response * seen->velocity - reference);
  }
}

}  // namespace demvof
