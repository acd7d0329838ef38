// SPDX-License-Identifier: GPL-3.0-or-later
#include "dem_side/history_force.hpp"

#include <algorithm>

namespace demvof {
namespace {

constexpr const char* rows_name = "demvof_history";
constexpr double largest_reynolds = 1;

}  // namespace

HistoryForce::HistoryForce(Dem& dem) : dem_(dem) {
  dem_.add_particle_rows(rows_name, 3 * HistoryKernel::terms);  // I_k, m/s
}

void HistoryForce::begin_step() {
  integrals_ = dem_.particle_rows(rows_name);
  if (kernel_ && step_ == dem_.time_step()) return;
  step_ = dem_.time_step();
  kernel_.emplace(step_);
}

HistoryForce::Memory HistoryForce::recall(int i, double diameter, double density, double viscosity,
                                          double slip) {
  const double* integral = integrals_[i];
  Vec3 sum;
  for (int k = 0; k < HistoryKernel::terms; ++k)
    sum += kernel_->weight(k) * kernel_->decay(k) * vec3(integral + 3 * k);
  ++count_.evaluations;
  count_.outside += density * slip * diameter > largest_reynolds * viscosity;
  const double factor = history_factor(diameter, density, viscosity);
  return {factor * sum, factor * kernel_->own()};
}

void HistoryForce::remember(int i, const Vec3& relative) {
  double* integral = integrals_[i];
  for (int k = 0; k < HistoryKernel::terms; ++k)
    for (int axis = 0; axis < 3; ++axis)
      integral[3 * k + axis] = kernel_->decay(k) * integral[3 * k + axis] + kernel_->gain(k) * relative[axis];
}

void HistoryForce::forget(int i) {
  std::fill_n(integrals_[i], 3 * HistoryKernel::terms, 0.0);
}

}  // namespace demvof
