// SPDX-License-Identifier: GPL-3.0-or-later
#include "dem_side/implicit_drag.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "coupler/closures/drag.hpp"
#include "dem_side/carried_fluid.hpp"

namespace {

using demvof::Series;
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
        const Vec3 drag = demvof::implicit_drag(beta, beta * (fluid - velocity), force, mass, end / steps);
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
      const double drag = demvof::implicit_drag(beta(velocity), {0, 0, -beta(velocity) * velocity},
                                                {0, 0, force}, mass, end / steps)
                              .z;
      velocity += (force + drag) * end / steps / mass;
    }
    return std::abs(velocity - exact);
  };
  EXPECT_NEAR(std::log2(error(20) / error(40)), 1, 0.05);
  EXPECT_NEAR(std::log2(error(40) / error(80)), 1, 0.05);
}

// (m + m_a) dv/dt = beta (u - v) + F + m_a Du/Dt has an exact solution: any step gives it, for a particle of
// a hundredth of the fluid's density too, whose added mass is fifty times its own.
TEST(ImplicitDrag, IsExactWithAddedMass) {
  const Vec3 fluid{0.3, 0, -0.1}, force{1e-4, -2e-4, 3e-5}, acceleration{2, 0, 9};
  for (const double density_ratio : {0.01, 0.5, 1.0, 2.5, 2500.0})
    for (const double beta : {0.0, 1e-6, 1e-3, 10.0}) {
      const double added = 0.5 * mass / density_ratio, inertia = mass + added, end = 1e-3;
      const Vec3 others = force + added * acceleration, start{0.01, 0.02, -0.5};
      const Vec3 exact =
          beta > 0 ? fluid + others / beta + std::exp(-beta * end / inertia) * (start - fluid - others / beta)
                   : start + end / inertia * others;
      for (const int steps : {1, 17}) {
        Vec3 velocity = start;
        for (int n = 0; n < steps; ++n) {
          const Vec3 drag =
              demvof::implicit_drag(beta, beta * (fluid - velocity), others, inertia, end / steps);
          const Vec3 mean = (drag + others) / inertia;
          const Vec3 given = drag + added * (acceleration - mean);  // to m itself, with force
          velocity += (given + force) * (end / steps / mass);
        }
        const double scale = norm(exact) + norm(start);
        EXPECT_LT(norm(velocity - exact), 1e-12 * scale / std::min(1.0, density_ratio))
            << density_ratio << ' ' << beta << ' ' << steps;
      }
    }
}

// A light sphere let go under water: (rho_p - rho) g / (rho_p + C_m rho), not -99 g.
TEST(ImplicitDrag, StartsALightSphereWithItsAddedMass) {
  for (const double ratio : {0.01, 0.1, 0.5, 2.0}) {
    const double added = 0.5 * mass / ratio, gravity = -9.81;
    const Vec3 others{0, 0, mass * gravity * (1 - 1 / ratio)};  // weight and buoyancy
    const Vec3 mean = (demvof::implicit_drag(0, {}, others, mass + added, 1e-3) + others) / (mass + added);
    EXPECT_NEAR(mean.z / (gravity * (ratio - 1) / (ratio + 0.5)), 1, 1e-14) << ratio;
  }
}

// J of a window, drag and added mass, answers to the fluid's velocity as the finite difference of the exact
// solution does.
TEST(DragResponse, CountsTheAddedMass) {
  const double window = 1e-3, added = 3 * mass;
  for (const double beta : {1e-6, 1e-2, 1e3}) {
    const auto taken = [&](double u) {  // momentum that m gains from rest
      return mass * u * -std::expm1(-beta * window / (mass + added));
    };
    EXPECT_NEAR(demvof::drag_response(beta, mass, window, 0, added) / (taken(1) / window), 1, 1e-12);
    EXPECT_EQ(demvof::drag_response(beta, mass, window, 1, added), beta);
  }
}

// beta s = a s + b s^2 has n = 1 + b s/(a + b s); single spheres from Stokes's range to Newton's.
TEST(DragExponent, IsTheSlopeOfTheDrag) {
  for (const double ratio : {0.0, 0.01, 1.0, 24.0, 1e4})  // b s/a
    EXPECT_NEAR(demvof::drag_exponent(1 + ratio * Series::of_variable(1)), 1 + ratio / (1 + ratio), 1e-14);
  const auto sphere = [](double reynolds) {
    return demvof::drag_exponent(demvof::schiller_naumann(1, 1, 1, Series::of_variable(reynolds)));
  };
  EXPECT_NEAR(sphere(100), 1 + 0.687 * (1 - 1 / (1 + 0.15 * std::pow(100, 0.687))), 1e-14);
  EXPECT_EQ(sphere(1e4), 2);
  EXPECT_EQ(demvof::drag_exponent(Series(3)), 1) << "at rest";
  EXPECT_EQ(demvof::drag_exponent(Series(0)), 1) << "no drag";
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
