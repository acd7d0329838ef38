// SPDX-License-Identifier: GPL-3.0-or-later
// Torque and lift of a spinning sphere against their exact limits and values worked out by hand.

#include <gtest/gtest.h>

#include <cmath>

#include "coupler/closures/spin_lift.hpp"
#include "coupler/closures/torque.hpp"

namespace demvof::test {
namespace {

constexpr double diameter = 2e-3, density = 1000, viscosity = 1e-3;

double torque_over_stokes(double reynolds) {
  const double rotation = reynolds * viscosity / (density * diameter * diameter);
  return torque_factor(diameter, density, viscosity, rotation) / (pi * viscosity * std::pow(diameter, 3));
}

TEST(Torque, IsStokesForSlowSpin) {
  // 8 pi mu R^3 w, and a factor of 8 in the diameter or 2 in the radius shows.
  EXPECT_NEAR(torque_factor(diameter, density, viscosity, 0) / (8 * pi * viscosity * 1e-9), 1, 1e-12);
  EXPECT_EQ(torque_over_stokes(20), 1);
}

// 0.5 rho w^2 R^5 (12.9/sqrt(Re) + 128.4/Re) at the spin of a bead of the dam break that rolls with 0.27
// m/s: 3.1 times Stokes's. The two branches meet at Re = 31.7.
TEST(Torque, FollowsDennisSinghAndIngham) {
  EXPECT_NEAR(torque_over_stokes(1460), 1460 * (12.9 / std::sqrt(1460.0) + 128.4 / 1460) / (64 * pi), 1e-12);
  EXPECT_NEAR(torque_over_stokes(1460), 3.0901, 1e-4);
  EXPECT_NEAR(torque_over_stokes(32), 1, 5e-3);
  // Bickley's first effect of inertia, Phil. Mag. 25 (1938) 746: 1 + (Re/4)^2/1200 at Re/4 = 10.
  EXPECT_NEAR(torque_over_stokes(40), 1 + 100.0 / 1200, 0.05);
}

// A ball that flies to +x with backspin, the spin along -y, is lifted to +z: pi R^3 rho w x v.
TEST(SpinLift, LiftsABallWithBackspin) {
  const double speed = 0.3, spin = 20;
  const Vec3 force = spin_lift_force(diameter, density, 1, {0, spin, 0}, {-speed, 0, 0});
  EXPECT_NEAR(force.z / (pi * 1e-9 * density * spin * speed), 1, 1e-12);
  EXPECT_EQ(force.x, 0);
  EXPECT_EQ(force.y, 0);
}

TEST(SpinLift, GoesOverIntoRubinowAndKellers) {
  EXPECT_NEAR(oesterle_bui_dinh(1e-9, 2), 1, 1e-6);
  EXPECT_EQ(oesterle_bui_dinh(0, 2), 1);
  EXPECT_EQ(oesterle_bui_dinh(10, 0), 1);
}

// Their formula in their own variables, Re_r = 2 g Re: C = 0.45 + (Re_r/Re - 0.45) exp(-0.05684 Re_r^0.4
// Re^0.3).
TEST(SpinLift, FollowsOesterleAndBuiDinh) {
  for (const double reynolds : {10.0, 50.0, 140.0})
    for (const double spin : {1.0, 3.0, 6.0}) {
      const double turning = 2 * spin * reynolds;
      const double C = 0.45 + (turning / reynolds - 0.45) *
                                  std::exp(-0.05684 * std::pow(turning, 0.4) * std::pow(reynolds, 0.3));
      EXPECT_NEAR(oesterle_bui_dinh(reynolds, spin) * 2 * spin / C, 1, 1e-4) << reynolds << ' ' << spin;
    }
  EXPECT_TRUE(oesterle_bui_dinh_range.contains(50, 3));
  EXPECT_FALSE(oesterle_bui_dinh_range.contains(50, 0.5));
}

}  // namespace
}  // namespace demvof::test
