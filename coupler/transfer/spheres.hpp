// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "coupler/base/vec3.hpp"

namespace demvof {

/// Places and radii of this rank's particles, m; not copied.
struct Spheres {
  int count = 0;
  const Vec3* position = nullptr;
  const double* radius = nullptr;

  Spheres() = default;
  Spheres(int count_, const Vec3* positions, const double* radii)
      : count(count_), position(positions), radius(radii) {}
  Spheres(const std::vector<Vec3>& positions, const std::vector<double>& radii)
      : Spheres(static_cast<int>(positions.size()), positions.data(), radii.data()) {}

  const Vec3* begin() const { return position; }  // of the places
  const Vec3* end() const { return position + count; }
};

}  // namespace demvof
