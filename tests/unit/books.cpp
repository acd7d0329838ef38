// SPDX-License-Identifier: GPL-3.0-or-later
#include "coupler/exchange/books.hpp"

#include <gtest/gtest.h>

namespace demvof {
namespace {

constexpr double liquid = 5e-4;

/// The two reports of a window with drag J, left-over L and implicit part F_i that close, staggered.
struct Reports {
  FluidReport fluid;
  ParticleReport particles;
};
Reports reports(const Vec3& drag, const Vec3& left_over, const Vec3& implicit, const Vec3& momentum_before) {
  Reports r;
  r.fluid.explicit_impulse = -drag;
  r.fluid.implicit_impulse = implicit;
  r.fluid.fine_solid_volume = 4e-5;
  r.fluid.liquid_volume = liquid;
  ParticleReport& p = r.particles;
  p.solid_volume = p.solid_volume_bulk = 4e-5;
  p.drag_impulse = p.drag_impulse_bulk = drag;
  p.left_over_given = left_over;
  p.pressure_impulse = {0, 0, 2};
  p.stress_impulse = {1, 0, 0};
  p.constant_impulse = {0, 0.5, 0};
  p.contact_impulse = {0, 0, 0.25};
  p.gravity_impulse = {0, 0, -4};
  p.held_impulse = {0.125, 0, 0};
  p.momentum = momentum_before + drag + left_over + p.pressure_impulse + p.stress_impulse +
               p.constant_impulse + p.contact_impulse + p.gravity_impulse - p.held_impulse;
  return r;
}

Books staggered() {
  return {ExchangeScheme::conservative_implicit, Schedule::staggered, {}, {}, {{}, {}, liquid, {}}};
}

TEST(Books, TwoWindowsThatClose) {
  Books books = staggered();
  const Vec3 implicit{0.25, 0, -1};
  Reports first = reports({1, 2, 3}, {}, implicit, {});
  books.window(first.fluid, first.particles);
  EXPECT_EQ(books.pending().x, -0.25) << "owed to the particles";
  Reports second = reports({-1, 0, 1}, -implicit, {}, first.particles.momentum);
  books.window(second.fluid, second.particles);
  EXPECT_EQ(books.worst().exchange, 0);
  EXPECT_EQ(books.worst().momentum, 0);
  EXPECT_EQ(books.worst().solid_volume, 0);
  EXPECT_EQ(books.worst().liquid_volume, 0);
}

TEST(Books, EachImpulseCounts) {
  using Member = Vec3 ParticleReport::*;
  for (const Member member :
       {&ParticleReport::pressure_impulse, &ParticleReport::stress_impulse, &ParticleReport::constant_impulse,
        &ParticleReport::contact_impulse, &ParticleReport::gravity_impulse, &ParticleReport::held_impulse,
        &ParticleReport::momentum}) {
    Books books = staggered();
    Reports r = reports({1, 2, 3}, {}, {}, {});
    (r.particles.*member).y += 0.5;
    books.window(r.fluid, r.particles);
    EXPECT_GT(books.worst().momentum, 0.05);
    EXPECT_EQ(books.worst().exchange, 0);
  }
  for (const Member member : {&ParticleReport::drag_impulse, &ParticleReport::left_over_given}) {
    Books books = staggered();
    Reports r = reports({1, 2, 3}, {}, {}, {});
    (r.particles.*member).y += 0.5;
    books.window(r.fluid, r.particles);
    EXPECT_GT(books.worst().exchange, 0.05);
    EXPECT_GT(books.worst().momentum, 0.05);
  }
}

TEST(Books, ConcurrentDragIsPendingForAWindow) {
  Books books(ExchangeScheme::conservative_implicit, Schedule::concurrent, {}, {}, {{}, {}, liquid, {}});
  Reports first = reports({1, 2, 3}, {}, {}, {});
  first.fluid.explicit_impulse = {};
  books.window(first.fluid, first.particles);
  EXPECT_EQ(books.pending().z, -3);
  Reports second = reports({2, 2, 2}, {}, {}, first.particles.momentum);
  second.fluid.explicit_impulse = {-1, -2, -3};
  books.window(second.fluid, second.particles);
  EXPECT_EQ(books.worst().exchange, 0);
}

TEST(Books, WhatFindsNoParticleStaysPending) {
  Books books = staggered();
  Reports first = reports({1, 0, 0}, {}, {0.5, 0, 0}, {});
  books.window(first.fluid, first.particles);
  Reports second = reports({1, 0, 0}, {-0.125, 0, 0}, {}, first.particles.momentum);
  second.particles.left_over_unplaced = {-0.375, 0, 0};
  books.window(second.fluid, second.particles);
  EXPECT_EQ(books.worst().exchange, 0);
  EXPECT_EQ(books.pending().x, -0.375);
  EXPECT_EQ(books.state().unplaced.x, -0.375);
}

/// The fluid keeps a part of what it owes for a window: the particles' cell was not told.
TEST(Books, WhatTheFluidKeepsStaysPending) {
  Books books = staggered();
  Reports first = reports({1, 0, 0}, {}, {0.5, 0, 0}, {});
  books.window(first.fluid, first.particles);
  Reports second = reports({1, 0, 0}, {-0.4375, 0, 0}, {}, first.particles.momentum);
  second.fluid.kept_left_over = {-0.0625, 0, 0};
  books.window(second.fluid, second.particles);
  EXPECT_EQ(books.pending().x, -0.0625);
  EXPECT_EQ(books.worst().exchange, 0);
}

TEST(Books, GoOnFromTheirState) {
  Books books = staggered();
  Reports first = reports({1, 2, 3}, {}, {0.25, 0, -1}, {});
  books.window(first.fluid, first.particles);
  Books later(ExchangeScheme::conservative_implicit, Schedule::staggered, first.particles.momentum, {},
              books.state());
  Reports second = reports({-1, 0, 1}, {-0.25, 0, 1}, {}, first.particles.momentum);
  later.window(second.fluid, second.particles);
  EXPECT_EQ(later.worst().exchange, 0);
  EXPECT_EQ(later.worst().momentum, 0);
}

TEST(Books, ReplacedParticlesAreLiquid) {
  Books books = staggered();
  Reports r = reports({}, {}, {}, {});
  r.particles.replaced_volume = 1e-5;
  r.particles.solid_volume_bulk = 3e-5;
  r.fluid.fine_solid_volume = 3e-5;
  r.fluid.replaced_liquid = 1e-5;
  r.fluid.liquid_volume = liquid + 1e-5;
  books.window(r.fluid, r.particles);
  EXPECT_LT(books.worst().solid_volume, 1e-15);
  EXPECT_LT(books.worst().liquid_volume, 1e-15);
}

// Beads come, and others drift out of the fluid: the mesh hears of it in the next window.
TEST(Books, TheMeshHasConcurrentParticlesOfAWindowAgo) {
  Books books(ExchangeScheme::conservative_implicit, Schedule::concurrent, {}, {}, {});
  double before = 4e-5;
  for (const double volume : {4e-5, 6e-5, 3e-5, 3e-5}) {
    Reports r = reports({}, {}, {}, {});
    r.particles.solid_volume = r.particles.solid_volume_bulk = volume;
    r.fluid.fine_solid_volume = before;
    books.window(r.fluid, r.particles);
    before = volume;
  }
  EXPECT_LT(books.worst().solid_volume, 1e-15);
  Reports r = reports({}, {}, {}, {});
  r.particles.solid_volume = r.particles.solid_volume_bulk = 6e-5;
  r.fluid.fine_solid_volume = 6e-5;
  books.window(r.fluid, r.particles);
  EXPECT_NEAR(books.worst().solid_volume, 0.5, 1e-12);
}

/// Fluid and particles together: of what the fluid's pressure leaves to the particles they get a part now and
/// are owed the rest.
TEST(Books, MomentumOfEverything) {
  Books books(ExchangeScheme::conservative_implicit, Schedule::staggered, {}, {1, 0, 0},
              {{}, {}, liquid, {}});
  Reports r = reports({1, 2, 3}, {}, {0.25, 0, -1}, {});
  OutsideImpulses& outside = r.fluid.outside;
  outside.fluid_weight = {0, 0, -16};
  outside.boundary_pressure = {0, 1, 19};
  outside.boundary_shear = {-0.5, 0, 0};
  outside.carried_in = {0, 0, 0.5};
  outside.surface_tension = {0, 0.25, 0};
  const Vec3 left = r.particles.pressure_impulse + Vec3{0, 0, 0.75};
  r.fluid.seen_pressure =
      r.particles.pressure_impulse + Vec3{0, 0, 0.5};  // the particles got too little of it
  r.fluid.owed_pressure = left - r.fluid.seen_pressure;
  r.fluid.momentum = Vec3{1, 0, 0} + r.fluid.explicit_impulse + r.fluid.implicit_impulse +
                     outside.fluid_weight + outside.boundary_pressure - left + outside.boundary_shear +
                     outside.carried_in + outside.surface_tension;
  books.window(r.fluid, r.particles);
  EXPECT_LT(norm(books.momentum().worst()), 1e-15);
  EXPECT_EQ(books.momentum().impulses().pressure_lag.z, -0.5);
  EXPECT_EQ(books.momentum().judged(), 1);

  EXPECT_EQ(books.pending().z, books.state().pending.z + 0.25);

  r.fluid.momentum += {0, 2, 0};  // from nowhere
  Books faulty(ExchangeScheme::conservative_implicit, Schedule::staggered, {}, {1, 0, 0},
               {{}, {}, liquid, {}});
  faulty.window(r.fluid, r.particles);
  EXPECT_NEAR(faulty.momentum().worst().y, 2 / norm(outside.boundary_pressure), 1e-15);
  EXPECT_LT(faulty.momentum().worst().z, 1e-15);
}

TEST(Books, WindowsInWhichParticlesComeAreCountedAsNotJudged) {
  Books books = staggered();
  Reports r = reports({1, 2, 3}, {}, {}, {});
  r.particles.inserted = 1;
  books.window(r.fluid, r.particles);
  EXPECT_EQ(books.momentum().windows(), 1);
  EXPECT_EQ(books.momentum().judged(), 0);
}

TEST(Books, LiquidThatFlowsOutIsNotLost) {
  Books books = staggered();
  FluidReport fluid;
  fluid.liquid_volume = liquid * 0.5;
  fluid.liquid_in = -liquid * 0.5;
  books.window(fluid);
  EXPECT_EQ(books.worst().liquid_volume, 0);
}

TEST(Books, WithoutParticlesLiquidIsKept) {
  Books books = staggered();
  FluidReport fluid;
  fluid.liquid_volume = liquid * 1.5;
  books.window(fluid);
  EXPECT_NEAR(books.worst().liquid_volume, 0.5, 1e-15);
}

}  // namespace
}  // namespace demvof
