// SPDX-License-Identifier: GPL-3.0-or-later
// Power series of formulas against their functions, and of the drag laws as far from the slip as they are
// used: a wrong derivative, a branch that is run over.

#include "coupler/base/series.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "coupler/closures/drag.hpp"
#include "coupler/closures/own_wake.hpp"
#include "dem_side/carried_fluid.hpp"

namespace demvof {
namespace {

// What is left out is of the fourth order: half as far, a sixteenth.
template <class Formula>
void expect_third_order(const Formula& formula, const char* name) {
  for (const double x : {0.3, 1.0, 7.0}) {
    const Series series = formula(Series::of_variable(x));
    EXPECT_DOUBLE_EQ(series.at(0), formula(x)) << name;
    const auto error = [&](double t) { return std::abs(series.at(t) - formula(x * (1 + t))); };
    EXPECT_LT(error(0.01), 1e-6 * std::abs(formula(x))) << name << " " << x;
    EXPECT_LT(error(0.02), 18 * error(0.01) + 1e-14 * std::abs(formula(x))) << name << " " << x;
  }
}

TEST(Series, AreThoseOfTheirFunctions) {
  expect_third_order([](auto x) { return pow(x, 0.687) - 2.0 * x; }, "power, difference");
  expect_third_order([](auto x) { return x * x / (1.0 + sqrt(x)); }, "product, quotient, root");
  expect_third_order([](auto x) { return exp(-(x * x) / 20); }, "exponential");
  expect_third_order([](auto x) { return 3.0 + log10(x) * x; }, "logarithm");
  expect_third_order([](auto x) { return pow(0.5, -x); }, "in the exponent");
}

/// Largest relative error of a law's series within its reach, at superficial Re 1e-3 to 5000.
template <class Law>
double error_in_reach(const Law& law) {
  constexpr double diameter = 2e-3, density = 1000, viscosity = 1e-3;
  double worst = 0;
  for (double reynolds = 1e-3; reynolds < 5000; reynolds *= 1.013)
    for (const double eps : {0.37, 0.6, 0.9, 1.0}) {
      const double slip = reynolds * viscosity / (density * diameter * eps);
      const Series series = law(diameter, density, viscosity, Series::of_variable(slip), eps);
      const double reach = std::min(series.reach, LocalDrag::near_slip);
      for (const double t : {-reach, 0.5 * reach, reach})
        worst = std::max(worst,
                         std::abs(series.at(t) / law(diameter, density, viscosity, slip * (1 + t), eps) - 1));
    }
  return worst;
}

TEST(Series, OfTheDragLawsAreGoodToTheirReach) {
  EXPECT_LT(error_in_reach([](auto... of) { return schiller_naumann(of...); }), 3e-7);
  EXPECT_LT(error_in_reach([](auto... of) { return gidaspow(of...); }), 3e-7);
  EXPECT_LT(error_in_reach([](auto... of) { return di_felice(of...); }), 3e-7);
  EXPECT_LT(error_in_reach([](auto... of) { return koch_hill(of...); }), 1e-14);
  EXPECT_LT(error_in_reach([](auto... of) { return beetstra(of...); }), 3e-7);
  EXPECT_LT(error_in_reach([](auto... of) { return rong(of...); }), 3e-7);
  const auto in_own_wake = [](double d, double rho, double mu, const auto& slip, double eps) {
    const auto beta = schiller_naumann(d, rho, mu, slip, eps);
    return beta / (1.0 - own_wake_share(beta, rho, mu, slip, 2 * d));
  };
  EXPECT_LT(error_in_reach(in_own_wake), 3e-7);
}

TEST(Series, ReachToTheBranchAndNoFarther) {
  const auto reach = [](double reynolds) {
    return schiller_naumann(1, 1, 1, Series::of_variable(reynolds)).reach;
  };
  EXPECT_NEAR(reach(990), 0.9 * 10 / 990, 1e-14);
  EXPECT_NEAR(reach(1010), 0.9 * 10 / 1010, 1e-14);
}

}  // namespace
}  // namespace demvof
