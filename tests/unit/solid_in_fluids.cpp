// SPDX-License-Identifier: GPL-3.0-or-later
#include "coupler/exchange/solid_in_fluids.hpp"

#include <gtest/gtest.h>

#include <limits>

using namespace demvof;

namespace {

constexpr double limit = 0.7;

double sum(const SolidInFluids& solid, double liquid, double gas) {
  return solid.liquid * liquid + solid.gas * gas;
}

}  // namespace

TEST(SolidInFluids, EachFluidKeepsItsOwn) {
  const SolidInFluids solid = solid_in_fluids(0.2, 0.05, 0.6, 0.4, limit);
  EXPECT_DOUBLE_EQ(solid.liquid, 0.2 / 0.6);
  EXPECT_DOUBLE_EQ(solid.gas, 0.05 / 0.4);
  EXPECT_EQ(solid.moved, 0);
}

TEST(SolidInFluids, WhatFillsItsFluidGoesToTheOther) {
  const SolidInFluids solid = solid_in_fluids(0.2, 0.1, 0.95, 0.05, limit);
  EXPECT_DOUBLE_EQ(solid.gas, limit);
  EXPECT_DOUBLE_EQ(solid.moved, 0.1 - limit * 0.05);
  EXPECT_DOUBLE_EQ(sum(solid, 0.95, 0.05), 0.3);
}

/// Within a fluid step the last gas, or liquid, of a bulk cell can leave it.
TEST(SolidInFluids, TheSumIsKeptWhenAFluidIsGone) {
  const double tiny = std::numeric_limits<double>::denorm_min();
  for (const double gone : {0.0, tiny, 1e-300, 1e-30, 1e-17}) {
    for (const bool gas_goes : {true, false}) {
      const double liquid = gas_goes ? 1 : gone, gas = gas_goes ? gone : 1;
      const SolidInFluids solid = solid_in_fluids(0.2, 0.1, liquid, gas, limit);
      EXPECT_NEAR(sum(solid, liquid, gas), 0.3, 1e-16) << gone;
      EXPECT_NEAR(solid.moved, gas_goes ? 0.1 : 0.2, 1e-16) << gone;
      EXPECT_LE(gas_goes ? solid.gas : solid.liquid, 1) << gone;
    }
  }
}
