// SPDX-License-Identifier: GPL-3.0-or-later
#include "coupler/output/verdict.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace demvof {
namespace {

const double nan = std::numeric_limits<double>::quiet_NaN();

TEST(Verdict, NothingIsSaidOfAGoodRun) {
  RunResults results;
  results.conservation = {1e-14, 1e-13, 2e-3, 1e-5};
  const Verdict verdict = judge(results, 0.5);
  EXPECT_TRUE(verdict.warnings.empty());
  EXPECT_FALSE(verdict.failure);
}

TEST(Verdict, LostParticlesAreAWarning) {
  RunResults results;
  results.particles.initial = 12;
  results.particles.lost = 12;
  const Verdict verdict = judge(results, 0.5);
  ASSERT_EQ(verdict.warnings.size(), 1u);
  EXPECT_EQ(verdict.warnings[0].rfind("12 of 12 particles were lost", 0), 0u) << verdict.warnings[0];
}

TEST(Verdict, BooksThatDoNotCloseAreAFailure) {
  for (const double error : {0.02, nan}) {
    RunResults results;
    results.conservation.momentum = error;
    ASSERT_TRUE(judge(results, 0.5).failure);
    EXPECT_NE(judge(results, 0.5).failure->find("conservation.momentum"), std::string::npos);
  }
  RunResults open_exchange;
  open_exchange.conservation.exchange = 0.02;
  EXPECT_TRUE(judge(open_exchange, 0.5).failure);
  EXPECT_FALSE(judge(open_exchange, 0.5, false).failure) << "a scheme that does not close";
  RunResults results;
  results.conservation.liquid_volume = 0.6;
  EXPECT_EQ(judge(results, 0.5).warnings.size(), 1u);
}

TEST(Verdict, AnAbsurdCourantNumberIsAFailure) {
  EXPECT_EQ(judge({}, 7).warnings.size(), 1u);
  EXPECT_FALSE(judge({}, 7).failure);
  EXPECT_TRUE(judge({}, 200).failure);
  EXPECT_TRUE(judge({}, nan).failure);
}

TEST(Verdict, WhatIsNoNumberIsNamed) {
  EXPECT_EQ(find_nonsense({{"a", 1}, {"b", 2}}), "");
  EXPECT_EQ(find_nonsense({{"a", 1}, {"kinetic_energy", nan}}).rfind("kinetic_energy is not a number", 0),
            0u);
}

}  // namespace
}  // namespace demvof
