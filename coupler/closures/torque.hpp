// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Torque of the fluid on a sphere that spins against it.
//
//   T = beta_r W      W = curl u / 2 - w
//   beta_r = pi mu d^3 C      C = max(1, (128.4 + 12.9 sqrt(Re_w)) / (64 pi))      Re_w = rho |W| d^2 / mu
//
//   d diameter, m; rho, mu density and viscosity of the fluid, kg/m3, Pa s; w spin, rad/s
//   C torque over that of Stokes flow, -
//
// Creeping flow: Kirchhoff 1876 in a fluid at rest, Faxen 1922 in one that turns. Above it Dennis, Singh and
// Ingham, J. Fluid Mech. 101 (1980) 257: T = (rho/2) (d/2)^5 |W|^2 (12.9 Re_w^-1/2 + 128.4 Re_w^-1), which
// meets Stokes's torque at Re_w = 32; they computed up to Re_w = 400 and agree with the experiments there.
// One sphere that spins steadily far from others: neither eps nor the slip of its centre enters.

#include <algorithm>
#include <cmath>

#include "coupler/base/sphere.hpp"

namespace demvof {

/// Re_w, -; rotation: |W|, rad/s.
inline double spin_reynolds(double diameter, double density, double viscosity, double rotation) {
  return density * rotation * diameter * diameter / viscosity;
}

/// Up to where the formula is commonly used; -.
constexpr double torque_largest_reynolds = 1000;

/// beta_r, N m s; mu > 0.
inline double torque_factor(double diameter, double density, double viscosity, double rotation) {
  const double root = std::sqrt(spin_reynolds(diameter, density, viscosity, rotation));
  return pi * viscosity * diameter * diameter * diameter * std::max(1.0, (128.4 + 12.9 * root) / (64 * pi));
}

}  // namespace demvof
