// SPDX-License-Identifier: GPL-3.0-or-later
#include "coupler/exchange/seen_fluid.hpp"

#include <gtest/gtest.h>

#include "coupler/exchange/relaxation.hpp"
#include "coupler/exchange/window_rule.hpp"

namespace demvof {
namespace {

constexpr double cell_volume = 1e-6, window = 1e-3;

SeenFluid::Parameters parameters(Schedule schedule, ExchangeScheme exchange, bool fluid_moves) {
  return {schedule, exchange, window, fluid_moves};
}

BulkFluid fluid(double speed, double gradient) {
  BulkFluid cell;
  cell.velocity = {speed, -speed, 2 * speed};
  cell.pressure_gradient = {0, gradient, -gradient};
  cell.density = 1000;
  cell.void_fraction = 0.5;
  return cell;
}

/// Light particles that the fluid has to make way for, with drag.
BulkParticles particles() {
  BulkParticles sum;
  sum.solid_volume = 0.5 * cell_volume;
  sum.pressure_mobility = sum.solid_volume / 100;
  sum.following_volume = 0.1 * cell_volume;
  sum.drag_response = 0.3;
  return sum;
}

void expect_near(const Vec3& a, const Vec3& b) {
  for (int axis = 0; axis < 3; ++axis) EXPECT_NEAR(a[axis], b[axis], 1e-14 * (1 + std::abs(b[axis])));
}

/// One cell told twice: the second time half way, or whatever the factor is.
struct Twice {
  explicit Twice(const SeenFluid::Parameters& p) : seen(p) {
    CellValues<BulkFluid> first{{7}, {fluid(1, 100)}};
    seen.relax(first, {0.5 * cell_volume}, heard);
    CellValues<BulkFluidGradients> slow{{7}, {{{1, 2, 3}, {5, 0, 0}, {4, 4, 4}}}};
    seen.relax(slow);
    seen.relax(second, {0.5 * cell_volume, 0.5 * cell_volume}, heard);
    seen.relax(fast);
  }
  CellValues<BulkParticles> heard{{7}, {particles()}};
  SeenFluid seen;
  CellValues<BulkFluid> second{{7}, {fluid(3, 500)}};
  CellValues<BulkFluidGradients> fast{{7}, {{{10, 20, 30}, {50, 1, 2}, {40, 40, 40}}}};
};

TEST(SeenFluid, GoesTowardsTheFluidFromWhatWasToldBefore) {
  for (const Schedule schedule : {Schedule::staggered, Schedule::concurrent}) {
    Twice run(parameters(schedule, ExchangeScheme::conservative_implicit, true));
    const double fluid_volume = 0.5 * cell_volume;
    const double gain = making_way_gain(particles(), 1000, fluid_volume);
    const double omega = relaxation_factor(schedule, gain, 0.3 * window / (1000 * fluid_volume));
    ASSERT_LT(omega, 0.5);
    const BulkFluid& seen = run.second.values[0];
    const double u = 1 + omega * 2, g = 100 + omega * 400;
    expect_near(seen.velocity, {u, -u, 2 * u});
    expect_near(seen.pressure_gradient, {0, g, -g});
    EXPECT_EQ(seen.density, 1000);
    expect_near(run.fast.values[0].acceleration, {5 + omega * 45, omega, 2 * omega});
    expect_near(run.fast.values[0].stress_force, {10, 20, 30});
    expect_near(run.fast.values[0].vorticity, {40, 40, 40});
    EXPECT_DOUBLE_EQ(run.seen.relaxed().smallest, omega);
    EXPECT_EQ(run.seen.relaxed().cells, 1);
    expect_near(run.seen.cells().values[0].velocity, seen.velocity);
    expect_near(run.seen.cells().values[0].acceleration, run.fast.values[0].acceleration);
  }
}

// The particles are those of the window before, the relaxation that of the coming one.
TEST(SeenFluid, RelaxesAsForTheWindowToCome) {
  for (const double ratio : {0.125, 1.5}) {
    SeenFluid seen(parameters(Schedule::staggered, ExchangeScheme::conservative_implicit, true));
    const CellValues<BulkParticles> heard{{7}, {particles()}};
    CellValues<BulkFluid> first{{7}, {fluid(1, 100)}}, second{{7}, {fluid(3, 500)}};
    seen.relax(first, {0.5 * cell_volume}, heard);
    seen.set_window(ratio * window);
    seen.relax(second, {0.5 * cell_volume}, heard);
    const BulkParticles then = over_window(particles(), ratio);
    const double gain = making_way_gain(then, 1000, 0.5 * cell_volume);
    const double omega = relaxation_factor(Schedule::staggered, gain, 0);
    EXPECT_NE(gain, making_way_gain(particles(), 1000, 0.5 * cell_volume));
    EXPECT_NEAR(second.values[0].velocity.x, 1 + omega * 2, 1e-12);
  }
}

TEST(SeenFluid, TellsItAsItIsWhereNothingPushes) {
  // Staggered, no porosity: neither gain nor response counts.
  Twice run(parameters(Schedule::staggered, ExchangeScheme::conservative_implicit, false));
  expect_near(run.second.values[0].velocity, {3, -3, 6});
  expect_near(run.fast.values[0].acceleration, {50, 1, 2});
  EXPECT_EQ(run.seen.relaxed().smallest, 1);
  EXPECT_EQ(run.seen.relaxed().cells, 0);
}

TEST(SeenFluid, ResponseCountsOnlyWhereItComesBack) {
  Twice implicit(parameters(Schedule::concurrent, ExchangeScheme::conservative_implicit, false));
  EXPECT_EQ(implicit.seen.relaxed().smallest, relaxation_factor(Schedule::concurrent, 0, 0.6));
  Twice explicit_drag(parameters(Schedule::concurrent, ExchangeScheme::explicit_drag, false));
  EXPECT_EQ(explicit_drag.seen.relaxed().smallest, relaxation_factor(Schedule::concurrent, 0, 0));
}

TEST(SeenFluid, CellsThatHearItForTheFirstTime) {
  SeenFluid seen(parameters(Schedule::staggered, ExchangeScheme::conservative_implicit, true));
  const CellValues<BulkParticles> heard{{3, 5}, {particles(), particles()}};
  CellValues<BulkFluid> first{{3}, {fluid(1, 100)}};
  seen.relax(first, {0.5 * cell_volume}, heard);
  CellValues<BulkFluid> second{{3, 5}, {fluid(2, 100), fluid(2, 100)}};
  seen.relax(second, {0.5 * cell_volume, 0.5 * cell_volume}, heard);
  EXPECT_LT(second.values[0].velocity.x, 2);
  EXPECT_EQ(second.values[1].velocity.x, 2);
  EXPECT_EQ(seen.relaxed().cells, 1);
  CellValues<BulkFluidGradients> some{{5}, {{{}, {8, 0, 0}, {}}}};  // not of every cell
  seen.relax(some);
  EXPECT_EQ(some.values[0].acceleration.x, 8);
  EXPECT_EQ(seen.cells().values[1].acceleration.x, 8);
  EXPECT_EQ(seen.cells().values[0].acceleration.x, 0);
}

TEST(SeenFluid, NobodyThereHearsItAsItIs) {
  SeenFluid seen(parameters(Schedule::staggered, ExchangeScheme::conservative_implicit, true));
  CellValues<BulkFluid> cell{{3}, {fluid(1, 100)}};
  seen.relax(cell, {0.5 * cell_volume}, {});
  cell = {{3}, {fluid(2, 200)}};
  seen.relax(cell, {0.5 * cell_volume}, {});
  EXPECT_EQ(cell.values[0].velocity.x, 2);
}

TEST(SeenFluid, GoesOnFromAState) {
  const auto p = parameters(Schedule::staggered, ExchangeScheme::conservative_implicit, true);
  const CellValues<BulkParticles> heard{{7}, {particles()}};
  SeenFluid once(p), again(p);
  CellValues<BulkFluid> first{{7}, {fluid(1, 100)}};
  once.relax(first, {0.5 * cell_volume}, heard);
  again.go_on_from(once.cells());
  CellValues<BulkFluid> a{{7}, {fluid(3, 500)}}, b = a;
  once.relax(a, {0.5 * cell_volume}, heard);
  again.relax(b, {0.5 * cell_volume}, heard);
  EXPECT_EQ(a.values[0].velocity.x, b.values[0].velocity.x);
  EXPECT_LT(b.values[0].velocity.x, 3);
}

}  // namespace
}  // namespace demvof
