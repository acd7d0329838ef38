// SPDX-License-Identifier: GPL-3.0-or-later
#include "coupler/transfer/mesh_cut.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <random>

#include "tests/support/meshes.hpp"

namespace demvof {
namespace {

using test::box;
using test::fine_mesh;
using test::mapped;
using test::measure;

const BulkGrid unit_cells({-4, -4, -4}, {4, 4, 4}, {8, 8, 8});

struct Part {
  double volume;
  Vec3 centroid;
};

std::map<std::array<int, 3>, Part> parts_of(const BulkGrid& grid, const Polyhedron& cell,
                                            Mapping mapping = Mapping::conservative) {
  const CutMesh cut = cut_mesh(grid, fine_mesh({cell}), mapping);
  std::map<std::array<int, 3>, Part> parts;
  for (std::size_t p = 0; p < cut.subcells.size(); ++p)
    EXPECT_TRUE(
        parts.insert({grid.ijk(cut.bulk[p]), {cut.subcells[p].volume, cut.subcells[p].centroid}}).second)
        << "two subcells of a cell in one bulk cell";
  return parts;
}

void expect_near(const Vec3& a, const Vec3& b, double tolerance) {
  for (int axis = 0; axis < 3; ++axis) EXPECT_NEAR(a[axis], b[axis], tolerance);
}

/// Volume of a body with plane faces where x < a.x, y < a.y, z < a.z: flux of (x - a)/3 through its faces,
/// clipped to that region; the caps lie in planes through a and contribute nothing.
double volume_below(const Polyhedron& body, const Vec3& a) {
  double volume = 0;
  for (std::vector<Vec3> face : body.faces) {
    for (int axis = 0; axis < 3; ++axis) {
      std::vector<Vec3> clipped;
      for (std::size_t i = 0; i < face.size(); ++i) {
        const Vec3 p = face[i], q = face[(i + 1) % face.size()];
        const double dp = p[axis] - a[axis], dq = q[axis] - a[axis];
        if (dp <= 0) clipped.push_back(p);
        if ((dp < 0 && dq > 0) || (dp > 0 && dq < 0)) clipped.push_back(p + (q - p) * (dp / (dp - dq)));
      }
      face = clipped;
    }
    for (std::size_t i = 2; i < face.size(); ++i)
      volume += dot(face[0] - a, cross(face[i - 1] - a, face[i] - a)) / 6;
  }
  return volume;
}

double volume_in_box(const Polyhedron& body, const Vec3& lower, const Vec3& upper) {
  double volume = 0;
  for (int corner = 0; corner < 8; ++corner) {
    const int i = corner & 1, j = corner >> 1 & 1, k = corner >> 2;
    const double sign = (i + j + k) % 2 ? 1 : -1;
    volume +=
        sign * volume_below(body, {i ? upper.x : lower.x, j ? upper.y : lower.y, k ? upper.z : lower.z});
  }
  return volume;
}

Polyhedron tetrahedron(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  return {{{a, c, b}, {a, b, d}, {b, c, d}, {a, d, c}}};
}

Polyhedron octahedron() {
  const Vec3 px{1, 0, 0}, mx{-1, 0, 0}, py{0, 1, 0}, my{0, -1, 0}, pz{0, 0, 1}, mz{0, 0, -1};
  return {{{px, py, pz},
           {py, mx, pz},
           {mx, my, pz},
           {my, px, pz},
           {py, px, mz},
           {mx, py, mz},
           {my, mx, mz},
           {px, my, mz}}};
}

/// Prism with an n-sided base.
Polyhedron prism(int n) {
  Polyhedron body;
  std::vector<Vec3> bottom, top;
  for (int i = 0; i < n; ++i) {
    const double a = 2 * std::acos(-1.0) * i / n;
    top.push_back({std::cos(a), std::sin(a), 0.5});
    bottom.insert(bottom.begin(), {std::cos(a), std::sin(a), -0.5});
  }
  body.faces = {bottom, top};
  for (int i = 0; i < n; ++i) {
    const Vec3 a = top[i], b = top[(i + 1) % n];
    body.faces.push_back({a, {a.x, a.y, -0.5}, {b.x, b.y, -0.5}, b});
  }
  return body;
}

TEST(Subcells, ABoxIsCutIntoBoxes) {
  const auto parts = parts_of(unit_cells, box({-1.25, 0.5, 0.125}, {1.5, 0.75, 1.125}));
  ASSERT_EQ(parts.size(), 8u);  // 4 x 1 x 2 bulk cells
  const double length[] = {0.25, 1, 0.5}, height[] = {0.875, 0.125}, mid_x[] = {-1.125, -0.5, 0.5, 0.75};
  EXPECT_NEAR(parts.at({2, 4, 4}).volume, length[0] * 0.25 * height[0], 1e-15);
  EXPECT_NEAR(parts.at({3, 4, 5}).volume, length[1] * 0.25 * height[1], 1e-15);
  EXPECT_NEAR(parts.at({4, 4, 4}).volume, 1 * 0.25 * height[0], 1e-15);
  EXPECT_NEAR(parts.at({5, 4, 5}).volume, length[2] * 0.25 * height[1], 1e-15);
  expect_near(parts.at({2, 4, 4}).centroid, {mid_x[0], 0.625, 0.5625}, 1e-14);
  expect_near(parts.at({5, 4, 5}).centroid, {1.25, 0.625, 1.0625}, 1e-14);
}

TEST(Subcells, ARotatedCubeFallsIntoEightEqualPartsAroundAGridCorner) {
  const double side = 1.2, half_diagonal = side / std::sqrt(2.0);
  const auto turn = test::rotation({1, 1, 1}, {0, 0, 1}, std::acos(-1.0) / 4);
  const Polyhedron cube = mapped(
      box({1 - side / 2, 1 - side / 2, 1 - side / 2}, {1 + side / 2, 1 + side / 2, 1 + side / 2}), turn);
  const auto parts = parts_of(unit_cells, cube);
  ASSERT_EQ(parts.size(), 8u);
  for (const auto& [ijk, part] : parts) {
    EXPECT_NEAR(part.volume, side * side * side / 8, 1e-14);
    const auto towards = [&](int axis) { return ijk[axis] == 5 ? 1.0 : -1.0; };
    expect_near(
        part.centroid,
        {1 + towards(0) * half_diagonal / 3, 1 + towards(1) * half_diagonal / 3, 1 + towards(2) * side / 4},
        1e-14);
  }
}

TEST(Subcells, ATetrahedronLosesItsTipToTheNextCell) {
  // Apex at height 1.5 over a base at z = 0.5: the part above z = 1 is half as high, 1/8 of the volume.
  const Vec3 apex{0.2, 0.3, 1.5};
  const auto parts =
      parts_of(unit_cells, tetrahedron({0.1, 0.1, 0.5}, {0.7, 0.1, 0.5}, {0.1, 0.9, 0.5}, apex));
  const double volume = 0.6 * 0.8 / 2 * 1.0 / 3;
  ASSERT_EQ(parts.size(), 2u);
  EXPECT_NEAR(parts.at({4, 4, 5}).volume, volume / 8, 1e-16);
  EXPECT_NEAR(parts.at({4, 4, 4}).volume, volume * 7 / 8, 1e-16);
  const Vec3 base_mean{0.3, 1.1 / 3, 0.5};
  expect_near(parts.at({4, 4, 5}).centroid, apex + (base_mean - apex) * (0.5 * 0.75), 1e-14);
  const Vec3 whole = apex + (base_mean - apex) * 0.75;
  expect_near(parts.at({4, 4, 4}).centroid, (whole - (apex + (base_mean - apex) * 0.375) / 8) * (8.0 / 7),
              1e-14);
}

TEST(Subcells, ATriangularPrismAcrossAPlane) {
  // Right triangle with legs 2 along x and 1 along y, cut at half of the long leg: 3/4 and 1/4.
  const Vec3 a{0, 0, 0.2}, b{2, 0, 0.2}, c{0, 1, 0.2}, up{0, 0, 0.5};
  const Polyhedron wedge{{{a, c, b},
                          {a + up, b + up, c + up},
                          {a, b, b + up, a + up},
                          {b, c, c + up, b + up},
                          {c, a, a + up, c + up}}};
  const auto parts = parts_of(unit_cells, wedge);
  ASSERT_EQ(parts.size(), 2u);
  EXPECT_NEAR(parts.at({4, 4, 4}).volume, 0.375, 1e-15);
  EXPECT_NEAR(parts.at({5, 4, 4}).volume, 0.125, 1e-15);
  expect_near(parts.at({5, 4, 4}).centroid, {4.0 / 3, 1.0 / 6, 0.45}, 1e-14);
  expect_near(parts.at({4, 4, 4}).centroid, {4.0 / 9, 7.0 / 18, 0.45}, 1e-14);
}

TEST(Subcells, AffineImagesOfConvexBodiesMatchIndependentClipping) {
  std::mt19937 random(7);
  std::uniform_real_distribution<> uniform(-1, 1);
  const Polyhedron bodies[] = {box({-1, -1, -1}, {1, 1, 1}), octahedron(), prism(3), prism(5), prism(8)};
  for (int sample = 0; sample < 60; ++sample)
    for (const Polyhedron& body : bodies) {
      const auto vector = [&](double s) {
        return Vec3{s * uniform(random), s * uniform(random), s * uniform(random)};
      };
      Vec3 a = vector(1.2), b = vector(1.2), c = vector(1.2);
      const Vec3 shift = vector(0.4);
      if (dot(a, cross(b, c)) < 0) a = -a;
      const Polyhedron cell =
          mapped(body, [&](const Vec3& x) { return shift + x.x * a + x.y * b + x.z * c; });
      const double whole = measure(body).volume * dot(a, cross(b, c));
      if (whole < 0.01) continue;
      double sum = 0;
      Vec3 moment;
      for (const auto& [ijk, part] : parts_of(unit_cells, cell)) {
        const Vec3 lower = unit_cells.cell_lower(ijk), upper = lower + unit_cells.spacing();
        EXPECT_NEAR(part.volume, volume_in_box(cell, lower, upper), 1e-12 * whole);
        for (int axis = 0; axis < 3; ++axis) {
          EXPECT_GE(part.centroid[axis], lower[axis]);
          EXPECT_LE(part.centroid[axis], upper[axis]);
        }
        sum += part.volume;
        moment += part.volume * part.centroid;
      }
      EXPECT_NEAR(sum, whole, 1e-13 * whole);
      expect_near(moment, whole * shift, 1e-12 * whole);
    }
}

TEST(Subcells, ACellThatIsNotConvexIsCutRightEvenWhenItsCentreIsOutside) {
  // A U of three arms, extruded along z: the centroid lies in the gap between the arms.
  const std::vector<Vec3> u = {{-1.5, -1.5, 0},  {1.5, -1.5, 0},    {1.5, 1.5, 0},   {1.25, 1.5, 0},
                               {1.25, -1.25, 0}, {-1.25, -1.25, 0}, {-1.25, 1.5, 0}, {-1.5, 1.5, 0}};
  Polyhedron cell;
  std::vector<Vec3> bottom(u.rbegin(), u.rend()), top = u;
  for (Vec3& corner : top) corner.z = 0.5;
  cell.faces = {bottom, top};
  for (std::size_t i = 0; i < u.size(); ++i) {
    const std::size_t j = (i + 1) % u.size();
    cell.faces.push_back({u[i], u[j], top[j], top[i]});
  }
  const auto parts = parts_of(unit_cells, cell);
  double sum = 0;
  for (const auto& [ijk, part] : parts) sum += part.volume;
  EXPECT_NEAR(sum, 0.5 * (3 * 0.25 + 2 * 2.75 * 0.25), 1e-13);
  EXPECT_NEAR(parts.at({2, 3, 4}).volume, 0.5 * 0.25 * 1, 1e-14);                    // left arm, -1 < y < 0
  EXPECT_NEAR(parts.at({2, 2, 4}).volume, 0.5 * (0.25 * 0.5 + 0.25 * 0.25), 1e-14);  // corner
  EXPECT_NEAR(parts.at({3, 2, 4}).volume, 0.5 * 0.25 * 1, 1e-14);                    // bottom arm
  EXPECT_EQ(parts.count({3, 3, 4}), 0u);                                             // the gap
  EXPECT_EQ(parts.count({4, 4, 4}), 0u);
}

TEST(Subcells, CellsOfNestedMeshesStayWholeDespiteRoundOff) {
  const BulkGrid grid({0, 0, 0}, {0.2, 0.1, 0.3}, {20, 10, 30});
  const CutMesh cut = cut_mesh(grid, fine_mesh(test::hexahedra({0, 0, 0}, {0.2, 0.1, 0.3}, {60, 30, 90})),
                               Mapping::conservative);
  EXPECT_EQ(cut.subcells.size(), std::size_t(60 * 30 * 90));
}

TEST(Subcells, WhatIsOutsideTheGridGoesToTheNearestCell) {
  const auto parts = parts_of(unit_cells, box({3.5, 4.5, -6}, {5, 5, 6}));  // boxes
  double sum = 0;
  for (const auto& [ijk, part] : parts) {
    EXPECT_EQ(ijk[0], 7);
    EXPECT_EQ(ijk[1], 7);
    sum += part.volume;
    EXPECT_LE(part.centroid.x, 4);
    EXPECT_LE(part.centroid.y, 4);
  }
  EXPECT_EQ(parts.size(), 8u);
  EXPECT_NEAR(sum, 1.5 * 0.5 * 12, 1e-13);
  EXPECT_NEAR(parts.at({7, 7, 0}).volume, 1.5 * 0.5 * 3, 1e-14);
  const auto tilted = parts_of(unit_cells, mapped(octahedron(), [](const Vec3& x) {
                                 return Vec3{3.8 + x.x, 0.5 + 0.3 * x.y, 0.5 + 0.3 * x.z};
                               }));
  ASSERT_EQ(tilted.size(), 2u);
  const double whole = 4.0 / 3 * 0.09, tip = whole / 2 * std::pow(0.2, 3);  // tip: 2.8 < x < 3
  EXPECT_NEAR(tilted.at({6, 4, 4}).volume, tip, 1e-15);
  EXPECT_NEAR(tilted.at({7, 4, 4}).volume, whole - tip, 1e-15);
}

TEST(Subcells, PeriodicDirectionsWrapSubcellsAndCentroids) {
  const BulkGrid grid({0, 0, 0}, {4, 4, 4}, {4, 4, 4}, {true, true, true});
  const auto straight = parts_of(grid, box({3.5, 0.25, -0.25}, {4.25, 0.75, 0.5}));
  ASSERT_EQ(straight.size(), 4u);
  EXPECT_NEAR(straight.at({3, 0, 3}).volume, 0.5 * 0.5 * 0.25, 1e-15);
  EXPECT_NEAR(straight.at({0, 0, 0}).volume, 0.25 * 0.5 * 0.5, 1e-15);
  expect_near(straight.at({0, 0, 3}).centroid, {0.125, 0.5, 3.875}, 1e-14);
  const auto round = parts_of(grid, mapped(octahedron(), [](const Vec3& x) {
                                return Vec3{4, 4, 4} + 0.6 * x;
                              }));
  ASSERT_EQ(round.size(), 8u);
  for (const auto& [ijk, part] : round) EXPECT_NEAR(part.volume, 4.0 / 3 * 0.216 / 8, 1e-15);
  expect_near(round.at({0, 3, 0}).centroid, {0.15, 3.85, 0.15}, 1e-14);
}

TEST(Subcells, NearestKeepsCellsWhole) {
  const auto parts = parts_of(unit_cells,
                              mapped(octahedron(),
                                     [](const Vec3& x) {
                                       return x + Vec3{0.9, 0.1, -0.2};
                                     }),
                              Mapping::nearest);
  ASSERT_EQ(parts.size(), 1u);
  EXPECT_NEAR(parts.at({4, 4, 3}).volume, 4.0 / 3, 1e-14);
}

}  // namespace
}  // namespace demvof
