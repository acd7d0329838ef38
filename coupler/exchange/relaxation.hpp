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
// without bound. Told the relaxed fluid q_told += omega (q - q_told) instead, q = u, grad p, Du/Dt,
//
//   omega = min(1, 1.2/(1 + G)),   G = 1.5 R_theta + y (1 + 4 (s - y)),   y = s (1 - theta),   R_theta = R
//   theta theta = (1 - exp(-x))/x,  x = beta dt/(m + m_a)
//
// no disturbance grows, neither in volume nor in shear: found for the linear map of one window, densities
// 0.01 to 20 of the fluid's, eps_s up to 0.7, x 1e-3 to 1e4 (tests/unit/relaxation.cpp). A steady state is
// not changed. Where G <= 0.2 (dilute or heavy particles) nothing is: omega = 1. docs/theory.md,
// docs/decisions/relaxation.md.

#include <algorithm>

#include "coupler/grid/bulk_cells.hpp"

namespace demvof {

/// omega, -, in (0, 1]. density: of the fluid in the bulk cell, kg/m3; fluid_volume: in it, m3.
inline double relaxation_factor(const BulkParticles& particles, double density, double fluid_volume) {
  const double solid = particles.solid_volume / fluid_volume;                    // s
  const double inertial = density * particles.pressure_mobility / fluid_volume;  // R_theta
  const double following = particles.following_volume / fluid_volume;            // y
  const double gain = 1.5 * inertial + following * (1 + 4 * std::max(solid - following, 0.0));
  return std::min(1.0, 1.2 / (1 + gain));
}

}  // namespace demvof
