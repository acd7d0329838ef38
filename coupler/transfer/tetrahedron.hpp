// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>

#include "coupler/base/vec3.hpp"

namespace demvof {

struct Tetrahedron {
  std::array<Vec3, 4> corner;
};

/// m3; positive when corners 1, 2, 3 run counter-clockwise seen from outside (corner 0 behind them).
inline double signed_volume(const Tetrahedron& t) {
  const Vec3 a = t.corner[1] - t.corner[0], b = t.corner[2] - t.corner[0], c = t.corner[3] - t.corner[0];
  return dot(a, cross(b, c)) / 6.0;
}

inline Vec3 centroid(const Tetrahedron& t) {
  return 0.25 * (t.corner[0] + t.corner[1] + t.corner[2] + t.corner[3]);
}

/// At most three tetrahedra: what one side of a plane can leave of a tetrahedron.
struct TetrahedronPart {
  std::array<Tetrahedron, 3> part;
  int count = 0;
  void add(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) { part[count++] = {{a, b, c, d}}; }
};

/// Splits a tetrahedron by the plane coordinate[axis] = plane. Corners made by the split lie on the plane to
/// the last bit. The parts fill the tetrahedron; their orientation is not kept, so take |volume|.
void split(const Tetrahedron& whole, int axis, double plane, TetrahedronPart& below, TetrahedronPart& above);

}  // namespace demvof
