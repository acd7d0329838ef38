// SPDX-License-Identifier: GPL-3.0-or-later
#include "coupler/exchange/owed_pressure.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "coupler/exchange/relaxation.hpp"

namespace demvof {
namespace {

constexpr double window = 0.5;

CellValues<BulkParticles> particles(double solid_volume) {
  CellValues<BulkParticles> cells{{3}, std::vector<BulkParticles>(1)};
  cells.values[0].solid_volume = solid_volume;
  return cells;
}

CellValues<BulkFluid> fluid(double gradient) {
  CellValues<BulkFluid> cells{{3, 5}, std::vector<BulkFluid>(2)};
  for (BulkFluid& cell : cells.values) {
    cell.density = 1;
    cell.pressure_gradient.z = gradient;
  }
  return cells;
}

TEST(OwedPressure, IsToldWithTheNextGradientsUntilAllIsGiven) {
  OwedPressure owed;
  double given = 0, left = 0;
  for (int n = 0; n < 60; ++n) {
    CellValues<BulkFluid> seen = fluid(-4);
    owed.tell(seen, {1, 1}, particles(2), window);
    EXPECT_EQ(seen.values[1].pressure_gradient.z, -4) << "no particles";
    given -= 2 * window * seen.values[0].pressure_gradient.z;
    EXPECT_NEAR(owed.seen().z, -2 * window * seen.values[0].pressure_gradient.z, 1e-14);
    const double lost = n == 0 ? 7 : 4;  // the first window's pressure was another one
    left += lost;
    owed.collect({{3}, {{{0, 0, 0.25 * lost}, 2 * 0.25 * window, 2}}}, 0.25 * window);
    owed.collect({{3}, {{{0, 0, 0.75 * lost}, 2 * 0.75 * window, 2}}}, 0.75 * window);
    owed.end_window(particles(2));
    EXPECT_NEAR(owed.owed_in_all().z, left - given, 1e-13);
  }
  EXPECT_NEAR(given, left, 1e-12);
}

// Of what has come of a long window as much force in the short one after it as in another long one.
TEST(OwedPressure, GoesBackAtThePaceOfTheLongerWindow) {
  for (const double ratio : {1.0, 0.125}) {
    OwedPressure owed;
    CellValues<BulkFluid> seen = fluid(0);
    owed.tell(seen, {1, 1}, particles(2), window);
    owed.collect({{3}, {{{0, 0, 8}, 2 * window, 2}}}, window);
    owed.end_window(particles(2));
    seen = fluid(0);
    owed.tell(seen, {1, 1}, particles(2), ratio * window, ratio);
    EXPECT_NEAR(seen.values[0].pressure_gradient.z, -0.5 * 8 / (2 * window), 1e-14);
    owed.end_window(particles(2));
    EXPECT_NEAR(owed.owed_in_all().z, 8 - ratio * 4, 1e-14);
  }
}

// Owed by a cell that holds next to nothing: round-off over next to nothing is no gradient.
TEST(OwedPressure, TellsNothingSteeperThanTheFluidHasBeen) {
  OwedPressure owed;
  CellValues<BulkFluid> seen = fluid(-4);
  owed.tell(seen, {1, 1}, particles(1e-16), window);
  owed.collect({{3}, {{{0, 0, 4e-16 * window}, 1e-16 * window, 1e-16}}}, window);
  owed.collect({{3}, {{{0, 0, 1e-9}, 0, 1e-16}}}, window);
  owed.end_window(particles(1e-16));
  seen = fluid(-4);
  owed.tell(seen, {1, 1}, particles(1e-16), window);
  EXPECT_NEAR(seen.values[0].pressure_gradient.z, -4 - 40, 1e-9);
  EXPECT_NEAR(owed.owed_in_all().z / 1e-9, 1, 1e-3) << "and keeps it";
  EXPECT_EQ(owed.held_back().cells, 1);
  EXPECT_NEAR(owed.held_back().impulse / 0.5e-9, 1, 1e-3) << "half of it had its turn";
  EXPECT_NEAR(owed.held_back().told / (4e-16 * window), 1, 1e-12);
  EXPECT_TRUE(owed.held_back().matters());
  // The same beside a cell that is full of particles: nobody has to hear of it.
  CellValues<BulkFluid> two{{3, 5}, {fluid(-4).values[0], fluid(-4).values[0]}};
  owed.tell(two, {1, 1}, {{3, 5}, {particles(1e-16).values[0], particles(1e6).values[0]}}, window);
  EXPECT_EQ(owed.held_back().cells, 1);
  EXPECT_FALSE(owed.held_back().matters());
}

TEST(OwedPressure, GoesBackToTheFluidWhereParticlesHaveLeft) {
  OwedPressure owed;
  CellValues<BulkFluid> seen = fluid(0);
  owed.tell(seen, {1, 1}, particles(2), window);
  owed.collect({{3}, {{{0, 0, 8}, 2 * window, 2}}}, window);
  owed.end_window(particles(2));
  CellValues<BulkParticles> fewer = particles(0.5);
  owed.return_to_fluid(fewer);
  EXPECT_EQ(fewer.values[0].drag_impulse.z, -6);
  EXPECT_EQ(owed.owed_in_all().z, 8) << "6 of it on its way";
  owed.end_window(fewer);
  EXPECT_EQ(owed.returned().z, 6);
  EXPECT_EQ(owed.owed_in_all().z, 2);
  CellValues<BulkParticles> gone;
  owed.return_to_fluid(gone);
  ASSERT_EQ(gone.cells, std::vector<CellId>{3});
  EXPECT_EQ(gone.values[0].drag_impulse.z, -2);
  owed.end_window(gone);
  EXPECT_EQ(owed.returned().z, 2);
  EXPECT_EQ(owed.owed_in_all().z, 0);
}

/// In a uniform pressure gradient, told as it is, nothing is owed to particles on their way from cell 3 to
/// cell 5.
TEST(OwedPressure, OwesNothingForTheWayOfTheParticles) {
  constexpr double gradient = -4;
  OwedPressure owed;
  CellValues<BulkFluid> seen = fluid(gradient);
  owed.tell(seen, {1, 1}, particles(2), window);
  for (const double there : {0.25, 1.0}) {  // after two steps, of which the second ends with nobody in cell 3
    const double step = 0.5 * window, exposed = 2 * step * (1 - there), other = 2 * step * there;
    owed.collect({{3, 5},
                  {{{0, 0, -gradient * exposed}, exposed, exposed / step},
                   {{0, 0, -gradient * other}, other, other / step}}},
                 step);
  }
  CellValues<BulkParticles> moved{{5}, std::vector<BulkParticles>(1)};
  moved.values[0].solid_volume = 2;
  owed.end_window(moved);
  EXPECT_NEAR(owed.owed_in_all().z, 0, 1e-15) << "the whole got what it lost";
  owed.return_to_fluid(moved);
  ASSERT_EQ(moved.cells, (std::vector<CellId>{3, 5}));
  const double back = 2 * window * gradient * 0.625;  // of the solid that was in the other cell, on the mean
  EXPECT_NEAR(moved.values[0].drag_impulse.z, -back, 1e-14);
  EXPECT_NEAR(moved.values[1].drag_impulse.z, back, 1e-14);
  owed.end_window(moved);
  CellValues<BulkFluid> next = fluid(gradient);
  owed.tell(next, {1, 1}, moved, window);
  EXPECT_EQ(next.values[1].pressure_gradient.z, gradient);
}

/// A pressure that answers what the particles get, grad p = s - mu grad p_seen, with the relaxation that goes
/// with it.
TEST(OwedPressure, IsStableWhereFluidAndParticlesPushEachOther) {
  for (const double mu : {0.05, 0.2, 0.5, 1.0, 3.0, 10.0, 100.0}) {
    const double omega = relaxation_factor(Schedule::staggered, 1.5 * mu, 0);
    OwedPressure owed;
    double pressure = -1, relaxed = -1, last = 0;
    for (int n = 0; n < 20000; ++n) {
      relaxed += omega * (pressure - relaxed);
      CellValues<BulkFluid> seen = fluid(relaxed);
      owed.tell(seen, {omega, omega}, particles(2), window);
      last = seen.values[0].pressure_gradient.z;
      pressure = -2 - mu * last;
      owed.collect({{3}, {{{0, 0, -2 * window * pressure}, 2 * window, 2}}}, window);
      owed.end_window(particles(2));
    }
    EXPECT_NEAR(last, -2 / (1 + mu), 1e-9) << mu;
    EXPECT_LT(std::abs(owed.owed_in_all().z), 1e-9) << mu;
  }
}

}  // namespace
}  // namespace demvof
