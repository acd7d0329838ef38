// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cmath>

namespace demvof {

inline constexpr double pi = 3.14159265358979323846;

/// m3; radius: m.
constexpr double sphere_volume(double radius) {
  return 4.0 / 3.0 * pi * radius * radius * radius;
}

/// Share of a sphere's volume that lies below a plane, -. height: of the plane above the centre, in radii.
///
///   (2 + 3 x - x^3)/4,   x = height in [-1, 1]     (Archimedes, On floating bodies)
inline double share_below_plane(double height) {
  const double x = std::clamp(height, -1.0, 1.0);
  return (2 + x * (3 - x * x)) / 4;
}

/// The plane's height above the centre in radii, -1 to 1: the inverse, from sin 3 phi = 2 share - 1, x = 2
/// sin phi.
inline double plane_height(double share) {
  return 2 * std::sin(std::asin(std::clamp(2 * share - 1, -1.0, 1.0)) / 3);
}

/// Of a full sphere about an axis through its centre, kg m2; mass: kg, radius: m.
constexpr double moment_of_inertia(double mass, double radius) {
  return 0.4 * mass * radius * radius;
}

}  // namespace demvof
