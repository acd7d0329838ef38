// SPDX-License-Identifier: GPL-3.0-or-later
#include "coupler/output/verdict.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace demvof {
namespace {

const double nan = std::numeric_limits<double>::quiet_NaN();

Verdict judged(const RunResults& results, double courant = 0.5, bool exchange_closes = true) {
  return judge(results, {}, {courant, 1}, exchange_closes);
}

RunResults with_lost(long lost) {
  RunResults results;
  results.particles.initial = 90;
  results.particles.inserted = 10;
  results.particles.lost = lost;
  return results;
}

TEST(Verdict, NothingIsSaidOfAGoodRun) {
  RunResults results;
  results.conservation = {1e-14, 1e-13, 2e-3, 1e-5};
  const Verdict verdict = judged(results);
  EXPECT_TRUE(verdict.warnings.empty());
  EXPECT_FALSE(verdict.failure);
}

TEST(Verdict, LostParticlesAreAWarningAndManyAFailure) {
  for (const long lost : {1L, 10L}) {
    const Verdict verdict = judged(with_lost(lost));
    EXPECT_FALSE(verdict.failure);
    ASSERT_EQ(verdict.warnings.size(), 1u) << lost;
    EXPECT_NE(verdict.warnings[0].find(" of 100 particles were lost"), std::string::npos);
  }
  const Verdict verdict = judged(with_lost(11));
  ASSERT_TRUE(verdict.failure);
  EXPECT_NE(verdict.failure->find("11 of 100 particles were lost"), std::string::npos);
  EXPECT_NE(verdict.failure->find("(limits.lost_particles: 0.1)"), std::string::npos) << *verdict.failure;
  LimitParameters limits;
  limits.lost_particles = 1;
  EXPECT_FALSE(judge(with_lost(100), limits, {0.5, 1}).failure);
}

TEST(Verdict, BooksThatDoNotCloseAreAFailure) {
  for (const double error : {0.02, nan}) {
    RunResults results;
    results.conservation.momentum = error;
    ASSERT_TRUE(judged(results).failure);
    EXPECT_NE(judged(results).failure->find("conservation.momentum"), std::string::npos);
  }
  RunResults open_exchange;
  open_exchange.conservation.exchange = 0.02;
  EXPECT_TRUE(judged(open_exchange).failure);
  EXPECT_FALSE(judged(open_exchange, 0.5, false).failure) << "a scheme that does not close";
}

TEST(Verdict, MomentumOfEverythingThatIsOpenIsAWarning) {
  const auto said = [](double error, bool changed = false, double size = 1) {
    RunResults results;
    results.momentum.emplace(Vec3{});
    OutsideImpulses weight;
    weight.fluid_weight = {0, 0, -size};
    results.momentum->close(size * Vec3{error, 0, -1}, weight, changed);
    const Verdict verdict = judged(results);
    EXPECT_FALSE(verdict.failure);
    return verdict.warnings;
  };
  ASSERT_EQ(said(0.9).size(), 1u);
  EXPECT_EQ(said(0.02).at(0).rfind("momentum.error is 0.02: ", 0), 0u);
  EXPECT_EQ(said(nan).size(), 1u);
  EXPECT_TRUE(said(3e-4).empty());
  EXPECT_TRUE(said(0.9, true).empty()) << "a window that is not judged";
  EXPECT_TRUE(said(0.9, false, 1e-19).empty()) << "nothing moves";
}

TEST(Verdict, VolumesAreAWarningAndThenAFailure) {
  RunResults results;
  results.conservation.liquid_volume = 0.05;
  EXPECT_EQ(judged(results).warnings.size(), 1u);
  EXPECT_FALSE(judged(results).failure);
  results.conservation.liquid_volume = 0.6;
  EXPECT_TRUE(judged(results).failure);
  results = {};
  results.conservation.solid_volume = 0.2;
  EXPECT_TRUE(judged(results).failure);
}

TEST(Verdict, AnAbsurdCourantNumberIsAFailure) {
  EXPECT_EQ(judged({}, 7).warnings.size(), 1u);
  EXPECT_FALSE(judged({}, 7).failure);
  EXPECT_TRUE(judged({}, 200).failure);
  EXPECT_TRUE(judged({}, nan).failure);
}

TEST(Verdict, AnAbsurdSpeedIsAFailure) {
  EXPECT_TRUE(judge({}, {}, {0.5, 90}).warnings.empty());
  EXPECT_EQ(judge({}, {}, {0.5, 200}).warnings.size(), 1u);
  EXPECT_FALSE(judge({}, {}, {0.5, 200}).failure);
  EXPECT_TRUE(judge({}, {}, {0.5, 2000}).failure);
  EXPECT_TRUE(judge({}, {}, {0.5, nan}).failure);
}

TEST(Verdict, WhatIsNoNumberIsNamed) {
  EXPECT_EQ(find_nonsense({{"a", 1}, {"b", 2}}), "");
  EXPECT_EQ(find_nonsense({{"a", 1}, {"kinetic_energy", nan}}).rfind("kinetic_energy is not a number", 0),
            0u);
}

}  // namespace
}  // namespace demvof
