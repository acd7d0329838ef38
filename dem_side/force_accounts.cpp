// SPDX-License-Identifier: GPL-3.0-or-later
// What the forces of a window have been.

#include "coupler/config/enum_names.hpp"
#include "dem_side/forces.hpp"

namespace demvof {

bool FluidForces::moved_by_forces(int i) const {
  return dem_.integrates(i) && !dem_.stream(i).carries;
}

const CarriedRow& FluidForces::carried(int i) const {
  return carried_by(dem_.particle_rows(rows_name), i);
}

Vec3 FluidForces::pressure_force(int i) const {
  const CarriedRow& row = carried(i);
  return row.share(0) * row.fluid[0].pressure_force + row.share(1) * row.fluid[1].pressure_force;
}

Vec3 FluidForces::drag_impulse(int i) const {
  return carried(i).fluid[0].drag_impulse + carried(i).fluid[1].drag_impulse;
}

std::vector<std::pair<std::string, ClosureCount>> FluidForces::closures() const {
  std::vector<std::pair<std::string, ClosureCount>> closures;
  if (parameters_.drag != DragLaw::none) closures.emplace_back(name_of(parameters_.drag), drag_count_);
  if (parameters_.lift != LiftLaw::none) closures.emplace_back(name_of(parameters_.lift), lift_count_);
  if (parameters_.spin_lift != SpinLiftLaw::none)
    closures.emplace_back(name_of(parameters_.spin_lift), spin_lift_count_);
  if (torque_) closures.emplace_back("torque", torque_->count());
  if (history_) closures.emplace_back("history", history_->count());
  if (lubrication_) closures.emplace_back("lubrication", lubrication_->count());
  return closures;
}

std::optional<SpinImpulses> FluidForces::spin_impulses() const {
  return torque_ ? std::optional(torque_->impulses()) : std::nullopt;
}

WindowImpulses FluidForces::impulses() const {
  WindowImpulses impulses = force_sums_;
  for (Vec3 WindowImpulses::*part : WindowImpulses::parts) impulses.*part *= dem_.time_step();
  return impulses;
}

long FluidForces::waiting_for_fluid() const {
  double* const* rows = dem_.particle_rows(rows_name);
  long waiting = 0;
  for (int i = 0, count = dem_.particles().count; i < count; ++i) waiting += carried_by(rows, i).waits();
  return waiting;
}

}  // namespace demvof
