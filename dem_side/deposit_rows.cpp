// SPDX-License-Identifier: GPL-3.0-or-later
#include "dem_side/deposit_rows.hpp"

namespace demvof {

// The drag C_s (u - v) of the window, C_s: beta_eff with the secant, is C (u - u_ref), u_ref = u - C_s/C (u -
// v).
std::function<BulkParticles(int)> FluidForces::expected_contributions(int k) const {
  return [this, k, particles = dem_.particles(), rows = dem_.particle_rows(rows_name),
          contribution = contributions(k)](int i) {
    BulkParticles expected = contribution(i);
    const CarriedRow& row = carried_by(rows, i);
    const double volume = particles.volume(i);
    const double added = added_mass(row, 0, volume) + added_mass(row, 1, volume);
    const double secant =
        drag_response(mean_drag_factor(row, k), particles.mass[i], window_,
                      held_share(row, moved_by_forces(particles, i)), added, mean_drag_factor(row, 1 - k));
    expected.drag_impulse = {};
    // u_ref is to be this one everywhere, and nobody counts as held by it.
    expected.drag_tangent = expected.free_response = expected.following_response = 0;
    expected.response_weighted_velocity -= secant * (row.fluid[k].velocity - vec3(particles.velocity[i]));
    return expected;
  };
}

}  // namespace demvof
