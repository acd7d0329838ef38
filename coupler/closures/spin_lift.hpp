// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Lift on a sphere that spins against its fluid (Magnus).
//
//   F = (pi/8) rho d^3 f W x (u - v)      W = curl u / 2 - w
//
//   d diameter, m; rho, mu density and viscosity of the fluid, kg/m3, Pa s; w spin, rad/s; u - v slip, m/s
//   Re = rho |u - v| d / mu;  g = d |W| / (2 |u - v|), spin over slip at the surface, -
//
//   rubinow_keller     f = 1, for Re -> 0: Rubinow and Keller, J. Fluid Mech. 11 (1961) 447
//   oesterle_bui_dinh  f = C/(2 g), C = 0.45 + (2 g - 0.45) exp(-0.075 g^0.4 Re^0.7): Oesterle and Bui Dinh,
//                      Exp. Fluids 25 (1998) 16, from trajectories with 10 < Re < 140, 1 < g < 6
//
// The second goes over into the first for Re -> 0. One sphere: eps does not enter. A ball with backspin is
// lifted.

#include <cmath>

#include "coupler/base/sphere.hpp"
#include "coupler/base/vec3.hpp"

namespace demvof {

/// Where a law holds; -.
struct SpinLiftRange {
  double smallest_reynolds, largest_reynolds, smallest_spin, largest_spin;  // of Re and g

  bool contains(double reynolds, double spin) const {
    return reynolds >= smallest_reynolds && reynolds <= largest_reynolds && spin >= smallest_spin &&
           spin <= largest_spin;
  }
};
constexpr SpinLiftRange rubinow_keller_range{0, 1, 0, 1e9};
constexpr SpinLiftRange oesterle_bui_dinh_range{10, 140, 1, 6};

/// g, -; slip: its size, > 0, m/s; rotation: |W|, rad/s.
inline double spin_over_slip(double diameter, double slip, double rotation) {
  return diameter * rotation / (2 * slip);
}

/// f of Oesterle and Bui Dinh; 1 without slip, and where nothing spins.
inline double oesterle_bui_dinh(double reynolds, double spin) {
  if (reynolds == 0 || spin == 0) return 1;
  const double decay = std::exp(-0.075 * std::pow(spin, 0.4) * std::pow(reynolds, 0.7));
  return (0.45 + (2 * spin - 0.45) * decay) / (2 * spin);
}

/// N; factor: f.
inline Vec3 spin_lift_force(double diameter, double density, double factor, const Vec3& rotation,
                            const Vec3& slip) {
  return pi / 8 * density * diameter * diameter * diameter * factor * cross(rotation, slip);
}

}  // namespace demvof
