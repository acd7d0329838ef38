// SPDX-License-Identifier: GPL-3.0-or-later
// What a particle adds to the bulk grid at the end of a window, in liquid and gas by its shares in them.

#include <utility>

#include "coupler/base/sphere.hpp"
#include "dem_side/forces.hpp"
#include "dem_side/implicit_drag.hpp"

namespace demvof {

void FluidForces::keep_to_reached_fluids(const std::function<bool(int, int)>& reached) {
  double* const* rows = dem_.particle_rows(rows_name);
  const int count = dem_.particles().count;
  for (int i = 0; i < count; ++i) {
    CarriedRow& row = carried_by(rows, i);
    for (int k = 0; k < 2; ++k) {
      if (reached(k, i) || !reached(1 - k, i)) continue;
      if (row.share(k) > 0) row.surface = {k == 0 ? 1.0 : 0.0, {}};
      row.fluid[1 - k].drag_impulse += std::exchange(row.fluid[k].drag_impulse, {});
    }
  }
}

std::function<BulkParticles(int)> FluidForces::contributions(int k) const {
  return [this, k, particles = dem_.particles(), rows = dem_.particle_rows(rows_name),
          gradients = gradient_rows()](int i) {
    const CarriedRow& row = carried_by(rows, i);
    const CarriedFluid& fluid = row.fluid[k];
    const double volume = particles.volume(i), mass = particles.mass[i];
    const double beta = mean_drag_factor(row, k), tangent = mean_drag_tangent(row, k);
    const double other = mean_drag_tangent(row, 1 - k);
    const double held = held_share(row, i);
    const double added = added_mass(row, 0, volume) + added_mass(row, 1, volume);
    const double response = drag_response(tangent, mass, window_, held, added, other);
    BulkParticles here;
    here.solid_volume = row.share(k) * volume;
    here.solid_flux = here.solid_volume * (window_ > 0 ? row.path / window_ : vec3(particles.velocity[i]));
    if (moved_by_forces(i)) {
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

// The drag C_s (u - v) of the window, C_s: beta_eff with the secant, is C (u - u_ref), u_ref = u - C_s/C (u -
// v).
std::function<BulkParticles(int)> FluidForces::expected_contributions(int k) const {
  return [this, k, particles = dem_.particles(), rows = dem_.particle_rows(rows_name),
          contribution = contributions(k)](int i) {
    BulkParticles expected = contribution(i);
    const CarriedRow& row = carried_by(rows, i);
    const double volume = particles.volume(i);
    const double added = added_mass(row, 0, volume) + added_mass(row, 1, volume);
    const double secant = drag_response(mean_drag_factor(row, k), particles.mass[i], window_,
                                        held_share(row, i), added, mean_drag_factor(row, 1 - k));
    expected.drag_impulse = {};
    // u_ref is to be this one everywhere, and nobody counts as held by it.
    expected.drag_tangent = expected.free_response = expected.following_response = 0;
    expected.response_weighted_velocity -= secant * (row.fluid[k].velocity - vec3(particles.velocity[i]));
    return expected;
  };
}

std::function<Support(int)> FluidForces::support(int k) const {
  return [this, k, particles = dem_.particles(), rows = dem_.particle_rows(rows_name),
          gradients = gradient_rows(), gravity = dem_.gravity()](int i) {
    const CarriedRow& row = carried_by(rows, i);
    const CarriedFluid& fluid = row.fluid[k];
    const double share = row.share(k);
    const bool moves = moved_by_forces(i);
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
