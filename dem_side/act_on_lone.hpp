// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Most particles are by themselves, in one fluid, and feel its drag and what is constant (CarriedRow::alone):
// for them the same as in forces.cpp, in fewer words.

#include <cmath>
#include <cstddef>

#include "coupler/base/four.hpp"
#include "dem_side/forces.hpp"

namespace demvof {

// Gravity is added by LIGGGHTS as the same product of the same numbers, so that what is left of a
// particle that touches nothing is zero or a last bit of its weight.
inline bool touches(double contact_squared, double weight_squared) {
  return contact_squared > 1e-20 * weight_squared;
}

/// beta of a fluid all around it; the law is asked where the slip has changed.
template <class Drag>
[[gnu::always_inline]] inline double FluidForces::drag_factor(const Drag& law, CarriedFluid& fluid,
                                                              double diameter, double slip) {
  const double change = slip * fluid.drag.per_slip - 1;
  if (std::abs(change) < fluid.drag.factor.reach) return fluid.drag.factor.at(change);
  return new_drag_factor(law, fluid, diameter, slip);
}

template <class Drag>
[[gnu::always_inline]] inline void FluidForces::act_on_each_lone(const Drag& drag_law, DemStep& step) {
  const ParticleArrays& particles = step.particles;
  const Vec3 constant_force = parameters_.constant;
  const Four constant{constant_force.x, constant_force.y, constant_force.z, 0};
  const Four gravity{step.gravity.x, step.gravity.y, step.gravity.z, 0};
  const Four of_script{step.of_script.x, step.of_script.y, step.of_script.z, 0};
  const double length = step.length, weight_squared = dot(step.of_script, step.of_script);
  const Four lengths{length, length, length, 1};
  double moved = 0, heavy_mass = 0;
  Four drags{}, pressures{}, left_overs{}, contacts{};
  for (int i = 0; i < particles.count; ++i) {
    fetch_ahead(step.rows, i, particles.count);
    CarriedRow& row = carried_by(step.rows, i);
    const int mask = particles.mask[i];
    if (row.alone == 0 || !dem_.integrates_sphere(mask)) {
      act_on_any<false>(drag_law, step, i);
      continue;
    }
    CarriedFluid& fluid = row.fluid[row.alone > 1];
    const double mass = particles.mass[i], heavy = dem_.has_weight(mask) ? mass : 0;
    double *force = particles.force[i], *speed = particles.velocity[i];
    const Four velocity{speed[0], speed[1], speed[2], 1};
    Four slip, pressure, left_over, sum;
    load(slip, &fluid.velocity.x);
    load(pressure, &fluid.pressure_force.x);
    load(left_over, &fluid.left_over_force.x);
    slip -= velocity;
    const double beta = drag_factor(drag_law, fluid, 2 * particles.radius[i], std::sqrt(xyz_squared(slip)));
    const Four weight_of_script = heavy * of_script;
    const Four contact = Four{force[0], force[1], force[2], 0} - weight_of_script;
    const Four own = constant + (heavy * gravity - weight_of_script), steady = pressure + left_over;
    const double phi = mean_decay(beta * (length / mass));
    Four drag = (phi * beta) * slip + (phi - 1) * (contact + weight_of_script + own + steady);
    const Four given = drag + steady + own;
    drags += drag;
    pressures += pressure;
    left_overs += left_over;
    if (const double squared = xyz_squared(contact); squared > 0) {
      contacts += contact;
      if (touches(squared, heavy * heavy * weight_squared)) {
        ++row.contacts.touching;
        row.contacts.impulse += length * xyz(contact);
      }
    }
    ++moved;
    heavy_mass += heavy;
    load(sum, &row.path.x);
    store(&row.path.x, sum + lengths * velocity);
    drag[3] = beta;
    load(sum, &fluid.drag_impulse.x);
    store(&fluid.drag_impulse.x, sum + lengths * drag);
    for (int axis = 0; axis < 3; ++axis) force[axis] += given[axis];
    if (step.added)
      for (int axis = 0; axis < 3; ++axis) step.added[i][axis] = given[axis];
  }
  step.sums.drag += xyz(drags);
  step.sums.pressure += xyz(pressures);
  step.sums.left_over += xyz(left_overs);
  step.sums.contact += xyz(contacts);
  step.sums.gravity += heavy_mass * step.gravity;
  step.sums.constant += moved * constant_force;
}

template <class Drag>
void FluidForces::act_on_lone(const Drag& drag_law, DemStep& step) {
  act_on_each_lone(drag_law, step);
}
template <class Drag>
DEMVOF_WIDE void FluidForces::act_on_lone_wide(const Drag& drag_law, DemStep& step) {
  act_on_each_lone(drag_law, step);
}

}  // namespace demvof
