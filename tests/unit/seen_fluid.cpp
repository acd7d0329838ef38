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

// All that has changed is the weight, and all of that is told.
TEST(SeenFluid, ComesFromWhatWasToldWithTheNewWeight) {
  SeenFluid seen(parameters(Schedule::staggered, ExchangeScheme::conservative_implicit, true));
  const CellValues<BulkParticles> heard{{7}, {particles()}};
  CellValues<BulkFluid> first{{7}, {fluid(1, 100)}}, second = first, third = first;
  seen.relax(first, {0.5 * cell_volume}, heard);
  seen.change_gravity({3, 0, -0.5});
  seen.change_gravity({1, 2, 0});
  second.values[0].pressure_gradient += 1000.0 * Vec3{4, 2, -0.5};
  third = second;
  for (CellValues<BulkFluid>* told : {&second, &third}) {
    seen.relax(*told, {0.5 * cell_volume}, heard);
    ASSERT_LT(seen.relaxed().smallest, 0.5);
    expect_near(told->values[0].pressure_gradient, {4000, 100 + 2000, -100 - 500});
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

/// Particles that are told the fluid as it is with order 1.
BulkParticles few() {
  BulkParticles sum;
  sum.solid_volume = 0.001 * cell_volume;
  sum.drag_response = 0.3;
  sum.response_weighted_velocity = {1, 1, 1};  // of the kernel: other cells, too
  return sum;
}
SeenFluid::Parameters of_order_two(bool fluid_moves) {
  return {Schedule::staggered, ExchangeScheme::conservative_implicit, window, fluid_moves, 2, 0.5};
}

/// Tells one cell a fluid that speeds up by steps of its own, in windows of the given lengths over the first.
struct Told {
  Told(SeenFluid& seen, double speed, double ratio) {
    seen.set_window(ratio * window);
    CellValues<BulkFluid> cell{{7}, {fluid(speed, 100 * speed)}};
    seen.relax(cell, {cell_volume}, {{7}, {few()}});
    CellValues<BulkFluidGradients> slow{{7}, {{{}, {10 * speed, 0, 0}, {speed, 0, 0}}}};
    seen.relax(slow);
    here = cell.values[0];
    derivatives = slow.values[0];
  }
  BulkFluid here;
  BulkFluidGradients derivatives;
};

TEST(SeenFluid, OfOrderTwoIsThatOfTheWindowsMiddle) {
  for (const bool fluid_moves : {true, false}) {
    SeenFluid seen(of_order_two(fluid_moves));
    EXPECT_EQ(Told(seen, 1, 1).here.velocity.x, 1) << "nothing is known of before";
    const Told second(seen, 3, 1);
    EXPECT_DOUBLE_EQ(second.here.velocity.x, 4);
    EXPECT_DOUBLE_EQ(second.derivatives.acceleration.x, 30) << "the first was of no window";
    const Told third(seen, 4, 1.5);
    EXPECT_DOUBLE_EQ(third.here.velocity.x, 4 + 0.5 * 1.5);
    EXPECT_DOUBLE_EQ(third.derivatives.acceleration.x, 40 + 1.25 * 10);
    EXPECT_DOUBLE_EQ(third.derivatives.vorticity.x, 4);
    EXPECT_DOUBLE_EQ(third.here.pressure_gradient.y, fluid_moves ? 400 : 400 + 1.25 * 100);
    EXPECT_DOUBLE_EQ(seen.ahead().values[0].x, 0.75);
    EXPECT_DOUBLE_EQ(seen.cells().values[0].expected_at_end().x, 5.5);
    EXPECT_EQ(seen.relaxed().cells, 0);
    CellValues<BulkParticles> felt{{7}, {few()}};
    felt.values[0].free_response = felt.values[0].drag_response;
    seen.refer_to_own_cell(felt);
    EXPECT_DOUBLE_EQ(felt.values[0].response_weighted_velocity.x, 0.3 * 4.75) << "what it was told";
  }
}

TEST(SeenFluid, OfOrderTwoIsNotContinuedWhereItIsRelaxed) {
  Twice first(parameters(Schedule::staggered, ExchangeScheme::conservative_implicit, true));
  Twice second(of_order_two(true));
  ASSERT_LT(first.seen.relaxed().smallest, 0.75);
  EXPECT_EQ(first.second.values[0].velocity.x, second.second.values[0].velocity.x);
  EXPECT_EQ(first.fast.values[0].acceleration.x, second.fast.values[0].acceleration.x);
}

// A little relaxed: what was told lags, but the change that is continued is the fluid's own.
TEST(SeenFluid, OfOrderTwoContinuesTheFluidAndNotWhatWasTold) {
  SeenFluid seen(of_order_two(true));
  BulkParticles some = few();
  some.solid_volume = 0.2 * cell_volume;
  some.pressure_mobility = some.solid_volume / 3000;
  some.drag_response = 0;
  const double omega =
      relaxation_factor(Schedule::staggered, making_way_gain(some, 1000, 0.4 * cell_volume), 0);
  ASSERT_TRUE(omega > 0.8 && omega < 0.999) << omega;
  const double speeds[] = {1, 3, 4};
  double told = 0;
  for (const double speed : speeds) {
    CellValues<BulkFluid> cell{{7}, {fluid(speed, 0)}};
    seen.relax(cell, {0.4 * cell_volume}, {{7}, {some}});
    told = cell.values[0].velocity.x;
  }
  const double second = 1 + omega * 2;
  EXPECT_DOUBLE_EQ(told, second + omega * (4 - second) + 0.5 * (1 - 4 * (1 - omega)));
}

TEST(SeenFluid, OfOrderTwoGoesOnFromAState) {
  SeenFluid once(of_order_two(true)), again(of_order_two(true));
  Told(once, 1, 1), Told(once, 3, 1), Told(once, 4, 1);
  again.go_on_from(once.cells());
  const Told a(once, 7, 1), b(again, 7, 1);
  EXPECT_EQ(a.here.velocity.x, b.here.velocity.x);
  EXPECT_EQ(a.derivatives.acceleration.x, b.derivatives.acceleration.x);
  EXPECT_EQ(b.here.velocity.x, 8.5);
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
