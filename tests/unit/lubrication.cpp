// SPDX-License-Identifier: GPL-3.0-or-later
// The film between two surfaces over one DEM step.
#include "coupler/closures/lubrication.hpp"

#include <gtest/gtest.h>

namespace demvof {
namespace {

constexpr FilmLimits limits{1e-6, 1e-4};
constexpr double step = 1e-4;

double strain_of(double gap, double velocity) {
  return std::log(limits.clamp(gap + velocity * step) / limits.clamp(gap));
}

/// s = L(h + v dt) - L(h) with v = v* - 6 pi mu a^2 k s, wherever the step begins and ends.
TEST(FilmStrain, IsThatOfTheVelocityItLeaves) {
  for (const double gap : {-1e-6, 1e-7, 1e-6, 2e-6, 1e-5, 9e-5, 1e-4, 2e-4})
    for (const double free : {-10.0, -1.0, -0.1, -1e-2, -1e-3, 1e-3, 1e-2, 0.1, 1.0, 10.0})
      for (const double lost : {1e-4, 1e-2, 1.0, 100.0}) {
        const double strain = film_strain(limits, gap, free, lost, 1, step);
        const double stiffness = lost * step / limits.clamp(gap);
        EXPECT_NEAR(strain_of(gap, free - lost * strain), strain,
                    1e-12 * (1 + stiffness) * (1 + std::abs(strain)))
            << "gap " << gap << ", free " << free << ", lost " << lost;
      }
}

TEST(FilmStrain, EndsAtTheLimits) {
  EXPECT_DOUBLE_EQ(film_strain(limits, 9e-5, 1, 1e-4, 1, step), std::log(1e-4 / 9e-5));
  EXPECT_DOUBLE_EQ(film_strain(limits, 2e-6, -1, 1e-4, 1, step), std::log(1e-6 / 2e-6));
  EXPECT_EQ(film_strain(limits, 2e-4, 1, 1e-4, 1, step), 0);
  EXPECT_EQ(film_strain(limits, 5e-7, -1, 1e-4, 1, step), 0);
}

}  // namespace
}  // namespace demvof
