// SPDX-License-Identifier: GPL-3.0-or-later
#include "dem_side/implicit_drag.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "coupler/closures/drag.hpp"

namespace {

using demvof::Vec3;

constexpr double mass = 2.5765e-5;  // the bead of the dam break, kg

// Reference values of (1 - exp(-x))/x in 80 bits.
TEST(ImplicitDrag, MeanDecayIsAccurateOnBothSidesOfItsSwitch) {
  for (const double x : {1e-12, 1e-6, 1e-3, 9.99e-3, 1.001e-2, 0.1, 1.0, 50.0}) {
    const double exact = static_cast<double>(-std::expm1(-static_cast<long double>(x)) / x);
    EXPECT_NEAR(demvof::mean_decay(x) / exact, 1, 4e-16) << x;
  }
  EXPECT_EQ(demvof::mean_decay(0), 1);
}

// Any number of steps gives what one step of the same length gives: the solution is exact.
TEST(ImplicitDrag, DoesNotDependOnTheStep) {
  const Vec3 fluid{0.3, 0, -0.1}, force{1e-4, -2e-4, 3e-5};
  for (const double beta : {0.0, 1e-6, 1e-3, 10.0}) {
    const double end = 1e-3;
    const auto advance = [&](int steps) {
      Vec3 velocity{0.01, 0.02, -0.5};
      for (int n = 0; n < steps; ++n) {
        const Vec3 drag = demvof::implicit_drag(beta, fluid - velocity, force, mass, end / steps);
        velocity += (force + drag) * (end / steps / mass);
      }
      return velocity;
    };
    EXPECT_LT(norm(advance(1) - advance(17)), 1e-13) << beta;
  }
}

TEST(ImplicitDrag, CarriesTheWholeForceAtInfiniteStiffness) {
  const Vec3 force{1e-4, -2e-4, 3e-5};
  const Vec3 drag = demvof::implicit_drag(1e6, {}, force, mass, 1e-3);
  EXPECT_LT(norm(drag + force), 1e-7 * norm(force));
}

// With a drag factor that follows the slip, beta of the step's start makes the scheme first order.
TEST(ImplicitDrag, IsFirstOrderForNonlinearDrag) {
  const double end = 0.02, force = -mass * 9.81 * 0.6;
  const auto beta = [](double v) { return demvof::schiller_naumann(2.7e-3, 1000, 1e-3, std::abs(v)); };
  double exact = 0;
  for (int n = 0; n < 200000; ++n) {
    const double middle = exact + 0.5 * end / 200000 * (force - beta(exact) * exact) / mass;
    exact += end / 200000 * (force - beta(middle) * middle) / mass;
  }
  const auto error = [&](int steps) {
    double velocity = 0;
    for (int n = 0; n < steps; ++n) {
      const double drag =
          demvof::implicit_drag(beta(velocity), {0, 0, -velocity}, {0, 0, force}, mass, end / steps).z;
      velocity += (force + drag) * end / steps / mass;
    }
    return std::abs(velocity - exact);
  };
  EXPECT_NEAR(std::log2(error(20) / error(40)), 1, 0.05);
  EXPECT_NEAR(std::log2(error(40) / error(80)), 1, 0.05);
}

TEST(DragResponse, IsThatOfAFreeOrAHeldParticle) {
  const double window = 1e-3;
  for (const double beta : {1e-6, 1e-2, 1e3}) {
    const double free = mass / window * -std::expm1(-beta * window / mass);
    EXPECT_NEAR(demvof::drag_response(beta, mass, window, 0) / free, 1, 1e-14);
    EXPECT_NEAR(demvof::drag_response(beta, mass, window, 1) / beta, 1, 1e-14);
    EXPECT_NEAR(demvof::drag_response(beta, mass, window, 0.25) / (0.25 * beta + 0.75 * free), 1, 1e-14);
  }
}

}  // namespace
