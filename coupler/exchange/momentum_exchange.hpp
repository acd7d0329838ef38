// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Momentum exchange between particles and fluid in one bulk cell and one window.
//
//   force on the fluid of the cell  F(u) = -J/dt * [scheme] + C (u_ref - u)
//
//   scheme                  explicit part     C            u_ref
//   explicit                -J/dt             0            -
//   semi_implicit           0                 K V          u_s = sum(w (beta v - F_o))/sum(w beta)
//   conservative_implicit   -J/dt             K_eff V      mean fluid velocity the particles felt
//
// J     impulse the particles of the cell received in the window as drag, lift and added mass, N s
// F_o   the part of J/dt that is not drag, N: through u_s the fluid gets exactly -sum w F_o besides
// K V   sum of w beta, kg/s;  K_eff V its response form (bulk_cells.hpp), kg/s
// dt    window, s
//
// With conservative_implicit what the implicit part gave the fluid is owed to the particles:
// M = C (u - u_ref) dt, handed over in the next window.
// In the fine cells of the bulk cell u_ref has a shape of mean 0 (foam_side/particles_to_fine.cpp): lambda of
// the fluid's own at the start of the window, 1 - lambda of the particles'. Particles that follow the fluid
// do so where they are, and do not pull it towards the mean of the bulk cell; those that do not pull it
// towards theirs.
//
// Sources: Pozzetti & Peters 2017 (semi-implicit, after Xiao & Sun 2011); the conservative scheme
// is this project's own, docs/theory.md.

#include <algorithm>

#include "coupler/exchange/exchange_parameters.hpp"
#include "coupler/grid/bulk_cells.hpp"

namespace demvof {

/// Of the response of a bulk cell's particles, the shares (-) of those that nothing holds, and of those that
/// go with the fluid within the window (lambda).
inline double free_share(const BulkParticles& particles) {
  return particles.drag_response > 0 ? std::min(1.0, particles.free_response / particles.drag_response) : 0;
}
inline double following_share(const BulkParticles& particles) {
  return particles.drag_response > 0 ? std::min(1.0, particles.following_response / particles.drag_response)
                                     : 0;
}

/// Force of the particles on the fluid of one bulk cell: explicit_force + coefficient (reference - u).
struct FluidSource {
  Vec3 explicit_force;      // N
  double coefficient = 0;   // kg/s
  Vec3 reference_velocity;  // m/s, mean over the cell
  double following = 0;     // lambda, -
};

/// particles: of a window simulated by the DEM; window: s, > 0.
inline FluidSource fluid_source(ExchangeScheme scheme, const BulkParticles& particles, double window) {
  FluidSource source;
  switch (scheme) {
    case ExchangeScheme::explicit_drag:
      source.explicit_force = -particles.drag_impulse / window;
      break;
    case ExchangeScheme::semi_implicit:
      source.coefficient = particles.drag_factor;
      if (particles.drag_factor > 0)
        source.reference_velocity = particles.drag_weighted_velocity / particles.drag_factor;
      else  // no drag: -F_o alone
        source.explicit_force = particles.drag_weighted_velocity;
      break;
    case ExchangeScheme::conservative_implicit:
      source.explicit_force = -particles.drag_impulse / window;
      source.coefficient = particles.drag_response;
      source.following = following_share(particles);
      if (particles.drag_response > 0)
        source.reference_velocity = particles.response_weighted_velocity / particles.drag_response;
      break;
  }
  return source;
}

/// True when the fluid gets the very impulse that the particles received as drag.
inline bool pays_drag_impulse(ExchangeScheme scheme) {
  return scheme != ExchangeScheme::semi_implicit;
}

/// Of a left-over impulse, the part that the particles in its cell take: all of it, unless there are less of
/// them than left it over. Concurrent particles have moved on before they hear of it; the rest goes back to
/// the fluid it came from. Not by their drag: where it grows faster than the slip, it falls with the slip
/// though nobody has left. solid_volume then and now: sum of w V, m3.
inline double share_for_particles(double solid_volume_then, double solid_volume_now) {
  return solid_volume_now < solid_volume_then ? solid_volume_now / solid_volume_then : 1.0;
}

/// True when the impulse of the implicit part goes back to the particles in the next window.
inline bool hands_back_left_over(ExchangeScheme scheme) {
  return scheme == ExchangeScheme::conservative_implicit;
}

}  // namespace demvof
