// SPDX-License-Identifier: GPL-3.0-or-later
#include "dem_side/history_force.hpp"

#include <algorithm>

namespace demvof {
namespace {

constexpr const char* rows_name = "demvof_history";
constexpr double largest_reynolds = 1;

// A particle's row: 1 + a of the last step, 0 before there was one; I_k, m/s.
constexpr int width = 1 + 3 * HistoryKernel::terms;

}  // namespace

HistoryForce::HistoryForce(Dem& dem) : dem_(dem) {
  dem_.add_particle_rows(rows_name, width);
}

void HistoryForce::begin_step() {
  rows_ = dem_.particle_rows(rows_name);
  if (kernel_ && step_ == dem_.time_step()) return;
  step_ = dem_.time_step();
  kernel_.emplace(step_);
}

HistoryForce::Memory HistoryForce::recall(int i, double diameter, double density, double viscosity,
                                          double slip) {
  const double* integral = rows_[i] + 1;
  Vec3 sum;
  for (int k = 0; k < HistoryKernel::terms; ++k)
    sum += kernel_->weight(k) * kernel_->decay(k) * vec3(integral + 3 * k);
  ++count_.evaluations;
  count_.outside += density * slip * diameter > largest_reynolds * viscosity;
  const double factor = history_factor(diameter, density, viscosity);
  return {factor * sum, factor * kernel_->own()};
}

void HistoryForce::remember(int i, double share, const Vec3& slip, const Vec3& relative) {
  double *integral = rows_[i] + 1, &known = rows_[i][0];
  const double before = known > 0 ? known - 1 : share;
  const Vec3 change = share * relative + (share - before) / step_ * slip;
  for (int k = 0; k < HistoryKernel::terms; ++k)
    for (int axis = 0; axis < 3; ++axis)
      integral[3 * k + axis] = kernel_->decay(k) * integral[3 * k + axis] + kernel_->gain(k) * change[axis];
  known = 1 + share;
}

void HistoryForce::forget(int i) {
  std::fill_n(rows_[i], width, 0.0);
  rows_[i][0] = 1;
}

}  // namespace demvof
