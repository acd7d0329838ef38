// SPDX-License-Identifier: GPL-3.0-or-later
// The drag laws against what is known of them from elsewhere: Stokes's limit, tabulated drag
// coefficients, the terminal velocity of a bead.

#include "coupler/closures/drag.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace {

constexpr double pi = 3.14159265358979323846;
constexpr double water = 1000, water_viscosity = 1e-3;

double drag_coefficient(double reynolds) {
  const double diameter = 2.7e-3;
  const double slip = reynolds * water_viscosity / (water * diameter);
  const double beta = demvof::schiller_naumann(diameter, water, water_viscosity, slip);
  return beta * slip / (pi / 8 * diameter * diameter * water * slip * slip);
}

TEST(SchillerNaumann, IsStokesDragAtRest) {
  EXPECT_DOUBLE_EQ(demvof::schiller_naumann(1e-3, 1000, 2e-3, 0.0), 3 * pi * 2e-3 * 1e-3);
  EXPECT_EQ(demvof::schiller_naumann(1e-3, 1000, 0, 0.0), 0);  // no viscosity, no slip: no drag
}

TEST(SchillerNaumann, TendsToStokesDragLikeReToTheirPower) {
  for (const double reynolds : {1e-6, 1e-4, 1e-2}) {
    const double over_stokes = drag_coefficient(reynolds) * reynolds / 24 - 1;
    EXPECT_NEAR(over_stokes / (0.15 * std::pow(reynolds, 0.687)), 1, 1e-6) << reynolds;
  }
}

// The standard drag curve by the correlations that Clift, Grace and Weber, Bubbles, Drops and
// Particles (1978), recommend; Schiller and Naumann's fit stays within 5 % of it below Re = 800.
TEST(SchillerNaumann, FollowsTheStandardDragCurve) {
  const double curve[][2] = {{0.1, 244}, {1, 27.1}, {10, 4.26}, {100, 1.087}, {500, 0.556}};
  for (const auto& [reynolds, expected] : curve)
    EXPECT_NEAR(drag_coefficient(reynolds) / expected, 1, 0.05) << reynolds;
}

TEST(SchillerNaumann, IsConstantInNewtonsRangeAndNearlyContinuousAtItsEdge) {
  EXPECT_NEAR(drag_coefficient(1000.1), 0.44, 1e-12);
  EXPECT_NEAR(drag_coefficient(5e4), 0.44, 1e-12);
  EXPECT_NEAR(drag_coefficient(999.9), 0.44, 0.005);
  EXPECT_NEAR(demvof::schiller_naumann(1e-3, 1000, 0, 2.0), pi / 8 * 0.44 * 1e-6 * 1000 * 2, 1e-15);
}

// A 2.7 mm, 2500 kg/m3 bead in water: beta v = (rho_p - rho) V g at 0.3430 m/s.
TEST(SchillerNaumann, GivesTheTerminalVelocityOfTheDamBreakBeads) {
  const double diameter = 2.7e-3;
  const double weight = (2500 - water) * pi / 6 * diameter * diameter * diameter * 9.81;
  double slow = 0, fast = 1;
  while (fast - slow > 1e-9) {
    const double v = (slow + fast) / 2;
    (demvof::schiller_naumann(diameter, water, water_viscosity, v) * v < weight ? slow : fast) = v;
  }
  EXPECT_NEAR(slow, 0.3430, 1e-4);
}

}  // namespace
