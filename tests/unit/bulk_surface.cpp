// SPDX-License-Identifier: GPL-3.0-or-later
// A plane surface, told cell by cell, wets a sphere as Archimedes says, wherever it lies.

#include "coupler/transfer/bulk_surface.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "coupler/base/sphere.hpp"

namespace {

using namespace demvof;

Vec3 unit(const Vec3& v) {
  return v / norm(v);
}

/// Liquid below the plane n.x = height, told as the fluid side tells it.
auto plane_surface(const BulkGrid& grid, const Vec3& normal, double height) {
  return [=](CellId cell) {
    const Vec3 centre = grid.cell_centre(grid.ijk(cell));
    BulkSurface surface;
    surface.liquid_fraction = share_of_box_below(normal, height - dot(normal, centre), grid.spacing());
    if (!is_cut(surface)) return surface;
    surface.normal = normal;
    surface.offset = plane_offset(normal, grid.spacing(), surface.liquid_fraction);
    return surface;
  };
}

const BulkGrid grid({0, 0, 0}, {1, 0.8, 1.2}, {5, 4, 6});  // cells of 0.2 m

TEST(BulkSurface, PlaneHoldsTheVolumeBelowIt) {
  const Vec3 edges{0.2, 0.3, 0.1};
  for (const Vec3& direction : {Vec3{0, 0, 1}, Vec3{1, -1, 0}, Vec3{1, 2, -3}, Vec3{1, 1e-3, 1e-5}}) {
    const Vec3 n = unit(direction);
    for (const double share : {1e-3, 0.1, 0.37, 0.5, 0.8, 0.999})
      EXPECT_NEAR(share_of_box_below(n, plane_offset(n, edges, share), edges), share, 1e-9) << share;
    EXPECT_NEAR(plane_offset(n, edges, 0.5), 0, 1e-12);
  }
  // The corner cut off by a plane is a tetrahedron, d^3/6 / (n_x n_y n_z), d its height.
  const Vec3 n = unit({1, 1, 1});
  const double d = 0.05, lowest = -0.5 * (0.2 + 0.3 + 0.1) / std::sqrt(3.0);
  EXPECT_NEAR(share_of_box_below(n, lowest + d, edges), d * d * d / 6 * std::sqrt(27.0) / (0.2 * 0.3 * 0.1),
              1e-14);
}

TEST(BulkSurface, WetsASphereAsArchimedesSays) {
  double worst = 0, worst_level = 0;
  for (const double radius : {0.02, 0.05, 0.1, 0.25})
    for (const Vec3& direction :
         {Vec3{0, 0, 1}, Vec3{0, -1, 0}, Vec3{1, 0, 1}, Vec3{1, 2, 3}, Vec3{-3, 1, 0.2}})
      for (int place = 0; place < 40; ++place) {
        const Vec3 n = unit(direction);
        const Vec3 at{0.31 + 0.011 * place, 0.42 + 0.003 * place, 0.55 + 0.007 * place};
        const double height = radius * (-1.1 + 2.2 * place / 39);  // of the plane above the centre
        const SeenSurface seen = see_surface(grid, at, radius, plane_surface(grid, n, dot(n, at) + height));
        const double error = std::abs(seen.wetted - share_below_plane(height / radius));
        (direction.z == 1 && direction.x == 0 ? worst_level : worst) =
            std::max(direction.z == 1 && direction.x == 0 ? worst_level : worst, error);
        if (std::abs(height) < radius) {
          EXPECT_NEAR(seen.distance, height, 0.04 * radius);
        }
      }
  EXPECT_LT(worst_level, 1.2e-3);  // of the quadrature's 12 rings
  EXPECT_LT(worst, 1.2e-3);
}

TEST(BulkSurface, SurfaceOnTheFacesOfBulkCells) {
  // No cell is cut then: the sphere's parts in liquid and gas cells count.
  const double radius = 0.05;
  const SeenSurface seen = see_surface(grid, {0.5, 0.4, 0.61}, radius, plane_surface(grid, {0, 0, 1}, 0.6));
  EXPECT_NEAR(seen.wetted, share_below_plane(-0.2), 1.2e-3);
  EXPECT_NEAR(seen.normal.z, 1, 1e-12);
  EXPECT_NEAR(seen.distance, -0.01, 2e-4);
  // Not touched: not at once when the sphere is near enough to see it.
  const auto on_faces = plane_surface(grid, {0, 0, 1}, 0.6);
  EXPECT_NEAR(see_surface(grid, {0.5, 0.4, 0.68}, radius, on_faces).distance, -0.08, 1e-12);
  EXPECT_NEAR(see_surface(grid, {0.5, 0.4, 0.52}, radius, on_faces).distance, 0.08, 1e-12);
  EXPECT_EQ(see_surface(grid, {0.5, 0.4, 0.52}, radius, on_faces).wetted, 1);
}

TEST(BulkSurface, ContinuousWhereSphereAndSurfacePassFaces) {
  const Vec3 n = unit({0.3, 0.2, 1});
  const double radius = 0.07, step = 4e-4;
  double before = -1;
  for (double z = 0.3; z < 0.9; z += step) {
    const double wetted =
        see_surface(grid, {0.395 + 0.05 * z, 0.41, z}, radius, plane_surface(grid, n, 0.75)).wetted;
    // d(share)/dz is at most 3/(4 R).
    if (before >= 0) {
      EXPECT_LT(std::abs(wetted - before), 2 * 0.75 / radius * step) << z;
    }
    before = wetted;
  }
}

TEST(BulkSurface, FarFromTheSurfaceOneFluid) {
  const auto surface = plane_surface(grid, {0, 0, 1}, 0.65);
  EXPECT_EQ(see_surface(grid, {0.5, 0.4, 1.0}, 0.02, surface).wetted, 0);
  EXPECT_EQ(see_surface(grid, {0.5, 0.4, 0.1}, 0.02, surface).wetted, 1);
  EXPECT_EQ(norm(see_surface(grid, {0.5, 0.4, 1.0}, 0.02, surface).normal), 0);
  // Near, but not touched: at its distance.
  const SeenSurface above = see_surface(grid, {0.5, 0.4, 0.7}, 0.02, surface);
  EXPECT_EQ(above.wetted, 0);
  EXPECT_NEAR(above.distance, -0.05, 1e-9);
}

TEST(BulkSurface, AcrossAPeriodAndAtAWall) {
  const BulkGrid periodic({0, 0, 0}, {1, 0.8, 1.2}, {5, 4, 6}, {true, false, false});
  const auto surface = plane_surface(periodic, {0, 0, 1}, 0.55);
  const double radius = 0.05, expected = share_below_plane(0.2);
  EXPECT_NEAR(see_surface(periodic, {0.01, 0.4, 0.54}, radius, surface).wetted, expected, 1.2e-3);
  EXPECT_NEAR(see_surface(periodic, {0.5, 0.79, 0.54}, radius, surface).wetted, expected, 1.2e-3);
}

}  // namespace
