// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Polyhedral meshes for tests, with volumes and centroids from the divergence theorem.

#include <array>
#include <cmath>
#include <functional>
#include <memory>
#include <vector>

#include "coupler/transfer/mesh_cut.hpp"

namespace demvof::test {

using Map = std::function<Vec3(const Vec3&)>;

struct Solid {
  double volume = 0;
  Vec3 moment;  // volume * centroid
};

/// Volume and first moment; faces that are not plane consist of triangles around the mean of their corners.
inline Solid measure(const Polyhedron& cell) {
  const Vec3 origin = cell.faces[0][0];  // keeps round-off relative to the cell, not to the coordinates
  Solid solid;
  for (const auto& face : cell.faces) {
    Vec3 middle;
    for (const Vec3& corner : face) middle += corner / double(face.size());
    for (std::size_t i = 0; i < face.size(); ++i) {
      const Vec3 a = middle - origin, b = face[i] - origin, c = face[(i + 1) % face.size()] - origin;
      const double volume = dot(a, cross(b, c)) / 6;
      solid.volume += volume;
      solid.moment += volume * (0.25 * (a + b + c));
    }
  }
  solid.moment += solid.volume * origin;
  return solid;
}

/// The convex body with the given corners and outward faces, each corner moved by map.
inline Polyhedron mapped(const Polyhedron& cell, const Map& map) {
  Polyhedron image = cell;
  for (auto& face : image.faces)
    for (Vec3& corner : face) corner = map(corner);
  return image;
}

inline Polyhedron box(const Vec3& lower, const Vec3& upper) {
  const auto at = [&](int i, int j, int k) {
    return Vec3{i ? upper.x : lower.x, j ? upper.y : lower.y, k ? upper.z : lower.z};
  };
  return {{{at(0, 0, 0), at(0, 0, 1), at(0, 1, 1), at(0, 1, 0)},
           {at(1, 0, 0), at(1, 1, 0), at(1, 1, 1), at(1, 0, 1)},
           {at(0, 0, 0), at(1, 0, 0), at(1, 0, 1), at(0, 0, 1)},
           {at(0, 1, 0), at(0, 1, 1), at(1, 1, 1), at(1, 1, 0)},
           {at(0, 0, 0), at(0, 1, 0), at(1, 1, 0), at(1, 0, 0)},
           {at(0, 0, 1), at(1, 0, 1), at(1, 1, 1), at(0, 1, 1)}}};
}

/// What the remap needs to know of the given cells.
inline FineMesh fine_mesh(std::vector<Polyhedron> cells) {
  FineMesh mesh;
  for (const Polyhedron& cell : cells) {
    const Solid solid = measure(cell);
    mesh.volume.push_back(solid.volume);
    mesh.centre.push_back(solid.moment / solid.volume);
    Vec3 lower = cell.faces[0][0], upper = lower;
    for (const auto& face : cell.faces)
      for (const Vec3& corner : face)
        for (int axis = 0; axis < 3; ++axis) {
          lower[axis] = std::min(lower[axis], corner[axis]);
          upper[axis] = std::max(upper[axis], corner[axis]);
        }
    mesh.lower.push_back(lower);
    mesh.upper.push_back(upper);
  }
  const auto shared = std::make_shared<std::vector<Polyhedron>>(std::move(cells));
  mesh.shape = [shared](int cell) { return (*shared)[cell]; };
  return mesh;
}

/// Hexahedra n[0] x n[1] x n[2] that fill the box, corners moved by map; x fastest.
inline std::vector<Polyhedron> hexahedra(
    const Vec3& lower, const Vec3& upper, const std::array<int, 3>& n,
    const Map& map = [](const Vec3& x) { return x; }) {
  const auto corner = [&](int i, int j, int k) {
    return Vec3{lower.x + (upper.x - lower.x) * i / n[0], lower.y + (upper.y - lower.y) * j / n[1],
                lower.z + (upper.z - lower.z) * k / n[2]};
  };
  std::vector<Polyhedron> cells;
  for (int k = 0; k < n[2]; ++k)
    for (int j = 0; j < n[1]; ++j)
      for (int i = 0; i < n[0]; ++i)
        cells.push_back(mapped(box(corner(i, j, k), corner(i + 1, j + 1, k + 1)), map));
  return cells;
}

/// Rotation about an axis through a centre, as a map.
inline Map rotation(const Vec3& centre, Vec3 axis, double angle) {
  axis = axis / norm(axis);
  return [=](const Vec3& x) {
    const Vec3 r = x - centre;
    return centre + std::cos(angle) * r + std::sin(angle) * cross(axis, r) +
           (1 - std::cos(angle)) * dot(axis, r) * axis;
  };
}

/// Moves interior corners of the unit box smoothly by up to `size`; its surface stays in place.
inline Map wobble(double size) {
  return [=](const Vec3& x) {
    const double pi = std::acos(-1.0);
    const double s = size * std::sin(pi * x.x) * std::sin(pi * x.y) * std::sin(pi * x.z);
    return x +
           s * Vec3{std::sin(17 * x.y + 5 * x.z), std::sin(19 * x.z + 3 * x.x), std::sin(13 * x.x + 7 * x.y)};
  };
}

}  // namespace demvof::test
