// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace demvof {

inline constexpr double pi = 3.14159265358979323846;

/// m3; radius: m.
constexpr double sphere_volume(double radius) {
  return 4.0 / 3.0 * pi * radius * radius * radius;
}

}  // namespace demvof
