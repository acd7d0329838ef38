// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// What a particle adds to the bulk grid at the end of a window, in liquid and gas by its shares in them. Part
// of forces.hpp: for all particles, in one loop with the sums.

#include <utility>

#include "coupler/exchange/support.hpp"
#include "dem_side/forces.hpp"
#include "dem_side/implicit_drag.hpp"

namespace demvof {

inline auto FluidForces::keep_to(int k) const {
  return [k, rows = dem_.particle_rows(rows_name)](int i) {
    CarriedRow& row = carried_by(rows, i);
    if (row.alone == 1 + k) return;
    if (row.share(1 - k) > 0) row.surface = {k == 0 ? 0.0 : 1.0, {}};
    row.fluid[k].drag_impulse += std::exchange(row.fluid[1 - k].drag_impulse, {});
  };
}

inline auto FluidForces::contributions(int k) const {
  return [this, k, particles = dem_.particles(), rows = dem_.particle_rows(rows_name),
          gradients = gradient_rows()](int i) {
    const CarriedRow& row = carried_by(rows, i);
    const CarriedFluid& fluid = row.fluid[k];
    const double volume = particles.volume(i), mass = particles.mass[i];
    const double beta = mean_drag_factor(row, k), tangent = mean_drag_tangent(row, k);
    const double other = mean_drag_tangent(row, 1 - k);
    const bool moves = moved_by_forces(particles, i);
    const double held = held_share(row, moves);
    const double added = added_mass(row, 0, volume) + added_mass(row, 1, volume);
    const double response = drag_response(tangent, mass, window_, held, added, other);
    BulkParticles here;
    here.solid_volume = row.share(k) * volume;
    here.solid_flux = here.solid_volume * (window_ > 0 ? row.path / window_ : vec3(particles.velocity[i]));
    if (moves) {
      const double inertia = mass + added;
      const double theta = inertial_share(tangent + other, inertia, window_);
      // Added mass: grad p and rho Du/Dt push alike.
      const double push = (1 + parameters_.added_mass) * volume / inertia;
      here.pressure_mobility = theta * here.solid_volume * push;
      here.following_volume = (1 - theta) * here.solid_volume;
      here.free_response = drag_response(tangent, mass, window_, 0, added, other);
      here.following_response = (1 - theta) * here.free_response;
    }
    here.drag_impulse = fluid.drag_impulse;
    here.drag_factor = beta;
    here.drag_tangent = tangent;
    here.drag_response = response;
    here.drag_weighted_velocity = beta * vec3(particles.velocity[i]);
    if (gradients && window_ > 0)
      here.drag_weighted_velocity -=
          carried_by<CarriedGradientsRow>(gradients, i).fluid[k].other_impulse / window_;
    here.response_weighted_velocity = response * fluid.velocity;
    return here;
  };
}

inline auto FluidForces::support(int k) const {
  return [this, k, particles = dem_.particles(), rows = dem_.particle_rows(rows_name),
          gradients = gradient_rows(), gravity = dem_.gravity()](int i) {
    const CarriedRow& row = carried_by(rows, i);
    const CarriedFluid& fluid = row.fluid[k];
    const double share = row.share(k);
    const bool moves = moved_by_forces(particles, i);
    Vec3 others = fluid.pressure_force;
    if (gradients) others += carried_by<CarriedGradientsRow>(gradients, i).fluid[k].stress_force;
    if (moves) others += parameters_.constant;
    if (dem_.has_weight(particles.mask[i])) others += particles.mass[i] * gravity;
    const double added = added_mass(row, 0, particles.volume(i)) + added_mass(row, 1, particles.volume(i));
    return Support{share * row.contacts.impulse, fluid.drag_impulse,
                   window_ * (share * others + fluid.left_over_force),
                   drag_response(mean_drag_tangent(row, k), particles.mass[i], window_, moves ? 0 : 1, added,
                                 mean_drag_tangent(row, 1 - k))};
  };
}

}  // namespace demvof
