// SPDX-License-Identifier: GPL-3.0-or-later
#include "coupler/exchange/window_rule.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "dem_side/implicit_drag.hpp"

namespace demvof {
namespace {

constexpr double volume = 1e-6, density = 2500, added = 0.5 * 1000 * volume;
constexpr double mass = density * volume;

/// What dem_side sends of particles of one kind after a window in which a part of them was held by contacts.
BulkParticles simulated(double drag, double window, double held = 0) {
  BulkParticles sum;
  const double inertia = mass + added, theta = inertial_share(drag, inertia, window);
  sum.solid_volume = volume;
  sum.drag_factor = sum.drag_tangent = drag;
  sum.drag_response = drag_response(drag, mass, window, held, added);
  sum.free_response = drag_response(drag, mass, window, 0, added);
  sum.pressure_mobility = theta * volume * 1.5 * volume / inertia;
  sum.following_volume = (1 - theta) * volume;
  sum.following_response = (1 - theta) * sum.free_response;
  return sum;
}

TEST(WindowRule, FindsTheResponseTimesOfAWindow) {
  for (const double x : {1e-6, 1e-3, 0.1, 1.0, 1.6, 3.0, 30.0, 1e4})
    EXPECT_NEAR(response_times(mean_decay(x)) / x, 1, 1e-9 + 1e-15 / x) << x;
  EXPECT_EQ(response_times(1), 0);
}

// A free particle in a fluid whose velocity and pressure gradient are others than it was told: what it would
// have been faster by.
TEST(WindowRule, CountsWhatAParticleWouldHaveBeenFasterBy) {
  for (const double x : {1e-3, 0.3, 2.0, 50.0})
    for (const double window : {1e-4, 1e-2}) {
      const double inertia = mass + added, drag = x * inertia / window;
      const double faster = 0.2, push = 300;  // m/s, Pa/m
      const double by_drag = -std::expm1(-x) * faster;
      const double by_pressure = 1.5 * volume * push / drag * -std::expm1(-x);
      EXPECT_NEAR(late_velocity(simulated(drag, window), {0, faster, 0}, {0, 0, -push}, window) /
                      (by_drag + by_pressure),
                  1, 1e-9)
          << x;
    }
  EXPECT_EQ(late_velocity(BulkParticles{}, {1, 0, 0}, {1, 0, 0}, 1), 0) << "nobody is late";
  BulkParticles frozen;
  frozen.solid_volume = volume;
  EXPECT_EQ(late_velocity(frozen, {1, 0, 0}, {1, 0, 0}, 1), 0) << "no force moves them";
}

TEST(WindowRule, LooksAtAllButAHundredthOfTheSolid) {
  LateVelocities late;
  EXPECT_EQ(late.all_but(0.01), 0);
  late.add(0, 0.5);
  EXPECT_EQ(late.all_but(0.01), 0);
  late.add(1e-3, 0.5);
  late.add(1, 0.009);
  late.add(1e12, 1e-5);
  EXPECT_GE(late.all_but(0.01), 1e-3);
  EXPECT_LT(late.all_but(0.01), 1.2e-3 * (1 + 1e-9));
  late.add(2, 0.002);
  EXPECT_GE(late.all_but(0.01), 1);
  EXPECT_LT(late.all_but(0.01), 1.2 * (1 + 1e-9));
}

TEST(WindowRule, KnowsParticlesAfterAWindowOfAnotherLength) {
  const double window = 1e-3;
  for (const double x : {1e-3, 0.3, 2.0, 50.0})
    for (const double held : {0.0, 0.4})
      for (const double ratio : {0.125, 0.9, 1.5}) {
        const double drag = x * (mass + added) / window;
        const BulkParticles guess = over_window(simulated(drag, window, held), ratio);
        const BulkParticles right = simulated(drag, ratio * window, held);
        for (double BulkParticles::*member :
             {&BulkParticles::solid_volume, &BulkParticles::drag_tangent, &BulkParticles::drag_response,
              &BulkParticles::free_response, &BulkParticles::pressure_mobility,
              &BulkParticles::following_volume, &BulkParticles::following_response})
          EXPECT_NEAR(guess.*member / (right.*member), 1, 1e-9) << x << " " << held << " " << ratio;
      }
  BulkParticles frozen;
  frozen.solid_volume = volume;
  frozen.drag_tangent = frozen.drag_response = 3;
  EXPECT_EQ(over_window(frozen, 2).drag_response, 3);
}

TEST(WindowRule, TheWorstOfThreeLimitsCounts) {
  EXPECT_DOUBLE_EQ(window_error({2e-3, 0, 0}, 1e-3), 2);
  EXPECT_DOUBLE_EQ(window_error({0, 0.6, 0}, 1e-3), 2);
  EXPECT_DOUBLE_EQ(window_error({1e-3, 0.3, 0.2}, 1e-3), 2);
}

TEST(WindowRule, ShrinksAtOnceAndGrowsSlowly) {
  const StepRange range{2, 1000};
  EXPECT_EQ(steps_of_next_window(100, 4, range), 20);
  EXPECT_EQ(steps_of_next_window(100, 1e9, range), 12) << "an eighth at most";
  EXPECT_EQ(steps_of_next_window(100, 1, range), 100);
  EXPECT_EQ(steps_of_next_window(100, 0.4, range), 100);
  EXPECT_EQ(steps_of_next_window(100, 0.39, range), 150);
  EXPECT_EQ(steps_of_next_window(100, 0, range), 150);
  EXPECT_EQ(steps_of_next_window(2, 0, range), 3) << "grows from the shortest, too";
  EXPECT_EQ(steps_of_next_window(4, 100, range), 2) << "shortest";
  EXPECT_EQ(steps_of_next_window(900, 0, range), 1000) << "longest";
}

TEST(WindowRule, KnowsHowFarTheNextWindowsCanReach) {
  const StepRange range{2, 1000};
  EXPECT_EQ(most_steps(1, 100, 100, range), 100);
  EXPECT_EQ(most_steps(4, 100, 100, range), 100 + 150 + 225 + 337);
  EXPECT_EQ(most_steps(4, 60, 100, range), 60 + 150 + 225 + 337) << "cut short by an output";
  EXPECT_EQ(most_steps(3, 900, 900, range), 2900) << "longest";
  EXPECT_EQ(most_steps(4, 7, 7, {7, 7}), 28) << "windows of one length";
}

TEST(WindowRule, WindowsToAnOutputAreEqualParts) {
  EXPECT_EQ(equal_part(100, 100), 100);
  EXPECT_EQ(equal_part(101, 100), 51);
  EXPECT_EQ(equal_part(7, 100), 7);
  EXPECT_EQ(equal_part(1000, 300), 250);
  for (long left = 997, windows = 0; left > 0; left -= equal_part(left, 100))
    EXPECT_LE(++windows, 10) << "not one more than needed";
}

}  // namespace
}  // namespace demvof
