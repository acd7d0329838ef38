// SPDX-License-Identifier: GPL-3.0-or-later
// Beds of several sizes, and the viscosity of suspensions, against what their authors state.

#include <gtest/gtest.h>

#include <cmath>

#include "coupler/closures/drag_range.hpp"
#include "coupler/closures/size_mix.hpp"
#include "coupler/closures/suspension_viscosity.hpp"

namespace demvof::test {
namespace {

// Two sizes, d and 2 d, with the same solid volume: d_32 = 4/3 d.
constexpr double sauter = 4.0 / 3, coarseness = 1.5 / sauter;

TEST(SizeMix, LeavesEqualSpheresTheirLaw) {
  EXPECT_DOUBLE_EQ(size_share(1, 1), 1);
}

// The drag of all is that of a bed of the Sauter diameter: sum n_i d_i s_i = sum V / (pi/6) / d_32^2.
TEST(SizeMix, KeepsTheDragOfTheBed) {
  const double share = size_share(1 / sauter, coarseness) / 1 + size_share(2 / sauter, coarseness) / 4;
  EXPECT_NEAR(share / (2 / (sauter * sauter)), 1, 1e-12);
}

// Void fraction 0.4: the whole force of the fluid, drag s and pressure y^2 (1 - eps)/eps in units of model
// A's drag, has the ratio of the published form, 6.28, but for what makes the sum right.
TEST(SizeMix, GivesThePublishedRatioOfForces) {
  const double eps = 0.4;
  const auto whole = [&](double diameter) {
    const double y = diameter / sauter;
    return diameter * (size_share(y, coarseness) + (1 - eps) / eps * y * y);
  };
  const auto published = [&](double diameter) {
    const double y = diameter / sauter;
    return diameter * (eps * y + (1 - eps) * y * y + 0.064 * eps * y * y * y);
  };
  EXPECT_NEAR(published(2) / published(1), 6.28, 0.005);
  EXPECT_NEAR(whole(2) / whole(1) / (published(2) / published(1)), 1, 0.012);
  EXPECT_NEAR(2 * size_share(2 / sauter, coarseness) / size_share(1 / sauter, coarseness), 4.417,
              1e-3);  // drag
}

TEST(SuspensionViscosity, GoesOverIntoEinsteins) {
  for (const auto law : {SuspensionViscosity::krieger_dougherty, SuspensionViscosity::eilers}) {
    EXPECT_EQ(relative_viscosity(law, 0), 1);
    EXPECT_NEAR((relative_viscosity(law, 1e-6) - 1) / 2.5e-6, 1, 1e-5);
    EXPECT_NEAR(relative_viscosity(law, 0.05), 1 + 2.5 * 0.05 + 5.2 * 0.05 * 0.05, 0.003);
    EXPECT_GT(relative_viscosity(law, 0.6), 80);
    EXPECT_EQ(relative_viscosity(law, 0.64), relative_viscosity(law, 0.6));
    EXPECT_EQ(relative_viscosity(law, -1e-15), 1);
  }
  EXPECT_EQ(relative_viscosity(SuspensionViscosity::none, 0.3), 1);
  // Krieger and Dougherty at 0.3: 0.53125^-1.6; Eilers: (1 + 0.375/0.53125)^2.
  EXPECT_NEAR(relative_viscosity(SuspensionViscosity::krieger_dougherty, 0.3), 2.7511, 1e-3);
  EXPECT_NEAR(relative_viscosity(SuspensionViscosity::eilers, 0.3), 2.9100, 1e-3);
}

TEST(DragRange, IsThatOfTheLaw) {
  EXPECT_EQ(drag_range(DragLaw::schiller_naumann).smallest_void_fraction, 0.98);
  EXPECT_EQ(drag_range(DragLaw::koch_hill).largest_reynolds, 200);
  EXPECT_TRUE(drag_range(DragLaw::none).contains(1e9, 0.1));
}

}  // namespace
}  // namespace demvof::test
