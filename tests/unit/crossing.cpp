// SPDX-License-Identifier: GPL-3.0-or-later
// Which particles are replaced by a drop: closing speed [43], distance, and side of the interface.
#include "coupler/exchange/crossing.hpp"

#include <gtest/gtest.h>

namespace demvof {
namespace {

constexpr double radius = 2e-3, window = 1e-3;

/// A level surface at z = 0 that rises with the given speed, liquid below.
BulkInterface level_surface(double rising = 0) {
  constexpr double area = 25e-6;
  return {area, {}, {0, 0, area * rising}, {0, 0, -area}};
}
bool hits(const BulkInterface& seen, double z, double speed, double least = 0) {
  return hits_interface(seen, {0.3, -0.2, z}, {1, 1, speed}, radius, window, least);
}

TEST(Crossing, NeedsAClosingSpeedAboveTheLeast) {
  EXPECT_TRUE(hits(level_surface(), 2e-3, -0.5));
  EXPECT_FALSE(hits(level_surface(), 2e-3, 0));
  EXPECT_FALSE(hits(level_surface(), 2e-3, 0.5)) << "it leaves the surface";
  EXPECT_TRUE(hits(level_surface(), 2e-3, -0.5, 0.49));
  EXPECT_FALSE(hits(level_surface(), 2e-3, -0.5, 0.5)) << "not above the least";
}

TEST(Crossing, TakesTheSpeedAgainstTheInterface) {
  EXPECT_FALSE(hits(level_surface(-0.5), 2e-3, -0.5)) << "both fall alike";
  EXPECT_TRUE(hits(level_surface(0.1), 2e-3, 0)) << "the surface rises to it";
}

TEST(Crossing, WaitsUntilTheSurfaceIsWithinReach) {
  EXPECT_TRUE(hits(level_surface(), 2.4e-3, -0.5)) << "0.5 mm to go in this window, 0.4 mm away";
  EXPECT_FALSE(hits(level_surface(), 2.6e-3, -0.5)) << "0.6 mm away";
}

TEST(Crossing, WorksFromBelowToo) {
  EXPECT_TRUE(hits(level_surface(), -2e-3, 0.5));
  EXPECT_FALSE(hits(level_surface(), -2e-3, -0.5));
}

TEST(Crossing, NeedsAnInterface) {
  EXPECT_FALSE(hits({}, 0, -0.5));
}

TEST(Crossing, DoesNotDependOnTheWeightsOfTheSample) {
  BulkInterface half = level_surface(0.1);
  half.area *= 0.5, half.position *= 0.5, half.velocity *= 0.5, half.gradient *= 0.5;
  EXPECT_TRUE(hits(half, 2e-3, 0));
  EXPECT_FALSE(hits(half, 2e-3, 0.1));
}

}  // namespace
}  // namespace demvof
