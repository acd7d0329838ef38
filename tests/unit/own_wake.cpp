// SPDX-License-Identifier: GPL-3.0-or-later
#include "coupler/closures/own_wake.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "coupler/closures/drag.hpp"
#include "coupler/transfer/kernel_weights.hpp"
#include "coupler/transfer/wake_width.hpp"

namespace demvof {
namespace {

const double pi = std::acos(-1.0);

/// Phi of own_wake.hpp; its inner integral by hand, the outer one by the midpoint rule in log q.
double phi(double reynolds) {
  double sum = 0;
  const int n = 200000;
  const double low = std::log(1e-9), high = std::log(12.0), step = (high - low) / n;
  for (int i = 0; i < n; ++i) {
    const double q = std::exp(low + (i + 0.5) * step), p = reynolds / q;
    const double inner =
        p < 1e-2 ? 4. / 3 - 4. / 15 * p * p : 2 * ((1 + 1 / (p * p)) * std::atan(p) / p - 1 / (p * p));
    sum += std::exp(-0.5 * q * q) * inner * q * step;
  }
  return sum / (4 * pi * pi);
}

TEST(OwnWake, IsTheSteadyOseenSolutionAtAnyReynoldsNumber) {
  const double mu = 0.3, width = 0.02, rho = 7;
  for (double reynolds = 1e-4; reynolds < 1e5; reynolds *= 3) {
    const double slip = reynolds * mu / (rho * width);
    const double share = own_wake_share(1.0, rho, mu, slip, width);
    EXPECT_NEAR(share * mu * width / phi(reynolds), 1, 4e-4) << reynolds;
  }
}

TEST(OwnWake, Limits) {
  // Regularised Stokeslet: d / (s sqrt(2 pi)); wake of a sphere with drag coefficient 0.44: C_d d^2 / (32
  // s^2).
  const double d = 1e-3, s = 5e-3;
  EXPECT_NEAR(own_wake_share(schiller_naumann(d, 1000, 1e-3, 0.0), 1000, 1e-3, 0.0, s),
              d / s / std::sqrt(2 * pi), 1e-9);
  EXPECT_NEAR(own_wake_share(schiller_naumann(d, 1000, 1e-3, 50.0), 1000, 1e-3, 50.0, s) /
                  (0.44 * d * d / (32 * s * s)),
              1, 1e-4);
  EXPECT_NEAR(own_wake_share(1.0, 1000, 0, 2.0, s), 1 / (4 * pi * 1000 * 2 * s * s), 1e-12) << "no viscosity";
  EXPECT_EQ(own_wake_share(0.0, 1000, 0, 0.0, s), 0);
}

TEST(WakeWidth, HoldsTheVarianceOfTheWeights) {
  const BulkGrid grid({0, 0, 0}, {41, 1, 1}, {41, 1, 1});
  for (const Kernel kernel : {Kernel::centre, Kernel::volume, Kernel::linear, Kernel::gaussian})
    for (const double diameter : {0.2, 0.8, 6.0}) {
      AveragingParameters averaging;
      averaging.kernel = kernel;
      double variance = 0;  // mean over the particle's positions
      const int n = 2000;
      for (int i = 0; i < n; ++i) {
        const KernelWeights w =
            kernel_weights(grid, averaging, {{20 + (i + 0.5) / n, 0.5, 0.5}}, {diameter / 2});
        double mean = 0, second = 0;
        w.for_each_cell(0, [&](int slot, double weight) {
          const double x = grid.cell_centre(grid.ijk(w.cells()[slot])).x;
          mean += weight * x;
          second += weight * x * x;
        });
        variance += (second - mean * mean) / n;
      }
      // On cubes, where the mean over the axes is that of one.
      const double s = WakeWidth(BulkGrid({0, 0, 0}, {41, 41, 41}, {41, 41, 41}), averaging)(diameter);
      EXPECT_NEAR((s * s - 1. / 6) / 2, variance, kernel == Kernel::centre ? 1e-12 : 0.002 + 0.005 * variance)
          << "kernel " << int(kernel) << " diameter " << diameter;
    }
}

}  // namespace
}  // namespace demvof
