// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Relaxation of what the particles are told of the fluid, where they and the fluid push each other about.
//
// Fluid and particles share the volume: where particles cannot move without the fluid making way,
// eps u + eps_s v = 0, and what the particles did in a window comes back as velocity and pressure gradient in
// the next. They answer the pressure gradient with the acceleration -grad p/rho_p, the fluid the displacement
// with the pressure gradient that moves it, and each window multiplies a disturbance by about
//
//   -R,  R = s rho/rho_p,  s = eps_s/eps    where inertia rules, whatever the window
//   -s (2 + s)                              where drag rules (K dt >> eps_s rho_p)
//
// so that beds of light particles, and dense beds in windows longer than their particles' response, grow
// without bound. Told the relaxed fluid q_seen += omega (q - q_seen) instead, q = u, grad p, Du/Dt,
//
//   staggered    omega = min(1, 1.2/(1 + G))
//   concurrent   omega = min(1, 1/(0.3 + 0.8 min(A, 2) + 3 G)),   A = K_eff dt/(eps rho)
//
//   G = 1.5 R_theta + y (1 + 0.3 y + 4 (s - y)),   y = s (1 - theta),   R_theta = R theta
//   theta = (1 - exp(-x))/x,  x = n beta dt/(m + m_a), n beta = d(beta s)/ds
//
// no disturbance grows, neither in volume nor in shear: found for the linear map of one window, densities
// 0.01 to 20 of the fluid's (concurrent: to 1e4), eps_s up to 0.7 (0.65), x 1e-3 to 1e4, free particles and
// held ones (tests/unit/relaxation.cpp). With a window of lag particles that outweigh the fluid and follow it
// swing in shear too, hence A. Where something holds a part h of the response, omega is taken times
//
//   (1 - b + b k)/(1 + 3 h (1 - h) max(0, s - 1.2)),   b = min(1, h/0.15)
//   k = min(1, 1.4 r) (staggered), r^1.5 (concurrent),   r = (2 + h q)/(2 + q)
//   q = sum w n beta dt/(mass of the fluid)
//
// because a stiff bed that is held, and is seen to be held by h alone, would multiply a disturbance by
// (h - 1)/h (tests/unit/exchange_stability.cpp). A steady state is not changed, and nothing is where G and A
// are small and all is held, or nothing. docs/theory.md, docs/decisions/relaxation.md.

#include <algorithm>
#include <cmath>

#include "coupler/exchange/exchange_parameters.hpp"
#include "coupler/grid/bulk_cells.hpp"

namespace demvof {

/// G, -: how strongly fluid and particles push each other about. density: of the fluid in the bulk cell,
/// kg/m3; fluid_volume: in it, m3.
inline double making_way_gain(const BulkParticles& particles, double density, double fluid_volume) {
  const double solid = particles.solid_volume / fluid_volume;                    // s
  const double inertial = density * particles.pressure_mobility / fluid_volume;  // R_theta
  const double following = particles.following_volume / fluid_volume;            // y
  return 1.5 * inertial + following * (1 + 0.3 * following + 4 * std::max(solid - following, 0.0));
}

/// Between held and free: h, q, and s, -.
struct PartlyHeld {
  double share = 0, stiffness = 0, solid = 0;
};

/// As for making_way_gain; window: s.
inline PartlyHeld partly_held(const BulkParticles& particles, double density, double fluid_volume,
                              double window) {
  const double whole = particles.drag_tangent - particles.free_response;
  const double held = particles.drag_response - particles.free_response;
  return {whole > 0 ? std::clamp(held / whole, 0.0, 1.0) : 0,
          particles.drag_tangent * window / (density * fluid_volume), particles.solid_volume / fluid_volume};
}

/// omega, -, in (0, 1]. gain: G, 0 without porosity; response: A.
inline double relaxation_factor(Schedule schedule, double gain, double response,
                                const PartlyHeld& held = {}) {
  const bool staggered = schedule == Schedule::staggered;
  const double least = staggered ? (1 + gain) / 1.2 : 0.3 + 0.8 * std::min(response, 2.0) + 3 * gain;
  const double h = held.share, q = held.stiffness, b = std::min(1.0, h / 0.15);
  const double r = (2 + h * q) / (2 + q), k = staggered ? std::min(1.0, 1.4 * r) : std::pow(r, 1.5);
  const double crowded = 1 + 3 * h * (1 - h) * std::max(0.0, held.solid - 1.2);
  return std::min(1.0, 1 / least) * (1 - b + b * k) / crowded;
}

}  // namespace demvof
