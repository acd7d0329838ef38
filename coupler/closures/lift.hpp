// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Lift on a sphere in a shear flow.
//
//   F = 1.615 d^2 sqrt(rho mu / |w|) f(Re, a) (u - v) x w
//
//   f = (1 - 0.3314 sqrt(a)) exp(-Re/10) + 0.3314 sqrt(a)   Re <= 40
//   f = 0.0524 sqrt(a Re)                                   Re > 40
//
//   d diameter, m; rho, mu density and viscosity of the fluid, kg/m3, Pa s; u - v slip, m/s
//   w = curl u vorticity, 1/s;  Re = rho |u - v| d / mu;  a = d |w| / (2 |u - v|)
//
// Saffman, J. Fluid Mech. 22 (1965) 385 and 31 (1968) 624, for Re -> 0 (f = 1); f by Mei, Int. J. Multiphase
// Flow 18 (1992) 145. One sphere: eps does not enter. A sphere that lags behind a shear flow is pushed to
// where the fluid is faster. The two branches of f do not meet: at Re = 40 the upper one
// is lower by 6 % for a = 0.4 and by 19 % for a = 0.05.

#include <cmath>

#include "coupler/base/vec3.hpp"

namespace demvof {

/// Where Mei fitted f; -.
struct LiftRange {
  double smallest_reynolds, largest_reynolds, smallest_shear, largest_shear;

  bool contains(double reynolds, double shear) const {
    return reynolds >= smallest_reynolds && reynolds <= largest_reynolds && shear >= smallest_shear &&
           shear <= largest_shear;
  }
};
constexpr LiftRange saffman_mei_range{0.1, 100, 0.005, 0.4};

/// a above, -; slip: its size, > 0.
inline double shear_over_slip(double diameter, double slip, double vorticity) {
  return diameter * vorticity / (2 * slip);
}

/// f above. Finite for every Re > 0, a >= 0.
inline double mei_factor(double reynolds, double shear) {
  if (reynolds > 40) return 0.0524 * std::sqrt(shear * reynolds);
  const double decay = std::exp(-reynolds / 10), root = 0.3314 * std::sqrt(shear);
  return (1 - root) * decay + root;
}

/// N; mu > 0. Zero without slip or without vorticity.
inline Vec3 saffman_mei(double diameter, double density, double viscosity, const Vec3& slip,
                        const Vec3& vorticity) {
  const double speed = norm(slip), rotation = norm(vorticity);
  if (speed == 0 || rotation == 0) return {};
  const double factor =
      mei_factor(density * speed * diameter / viscosity, shear_over_slip(diameter, speed, rotation));
  return 1.615 * diameter * diameter * std::sqrt(density * viscosity / rotation) * factor *
         cross(slip, vorticity);
}

}  // namespace demvof
