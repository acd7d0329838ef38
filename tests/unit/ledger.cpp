// SPDX-License-Identifier: GPL-3.0-or-later
#include "coupler/exchange/ledger.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace demvof {
namespace {

/// A window of conservative_implicit that closes: drag J, implicit part F_i.
WindowBalance closed(const Vec3& drag, const Vec3& implicit, const Vec3& pending_before) {
  WindowBalance window;
  window.drag_to_particles = drag;
  window.left_over_to_particles = pending_before;
  window.explicit_to_fluid = -drag;
  window.implicit_to_fluid = implicit;
  window.pending = -implicit;
  window.bulk_solid_volume = window.particle_volume = 4e-5;
  window.liquid_volume = 5e-4;
  return window;
}

Ledger at_rest() {
  return Ledger({}, {}, 5e-4);
}

TEST(Ledger, AClosedExchangeHasNoError) {
  Ledger ledger = at_rest();
  EXPECT_EQ(ledger.close(closed({1, 2, 3}, {0.25, 0, -1}, {})).exchange, 0);
  EXPECT_EQ(ledger.close(closed({-1, 0, 2}, {0, 4, 0}, {-0.25, 0, 1})).exchange, 0);
  EXPECT_EQ(ledger.worst().exchange, 0);
}

TEST(Ledger, ParticlesThatComeOrGoTakeTheirMomentumWithThem) {
  Ledger ledger({1, 0, 0}, {}, 5e-4);
  WindowBalance window = closed({}, {}, {});
  window.particle_momentum = {0.75, 0, 0};
  window.particles_changed = true;
  EXPECT_EQ(ledger.close(window).momentum, 0);
  window.particles_changed = false;
  EXPECT_EQ(ledger.close(window).momentum, 0);
  window.particle_momentum = {0.5, 0, 0};
  EXPECT_GT(ledger.close(window).momentum, 0.2) << "from the new start";
}

TEST(Ledger, SolidOnTheFineMeshCountsWhereItIsPutThere) {
  Ledger ledger = at_rest();
  WindowBalance window = closed({}, {}, {});
  EXPECT_EQ(ledger.close(window).solid_volume, 0);
  window.fine_solid_error = -1e-5;
  EXPECT_DOUBLE_EQ(ledger.close(window).solid_volume, 0.25);
}

TEST(Ledger, ALeftOverThatIsNotHandedOverIsAnError) {
  Ledger ledger = at_rest();
  ledger.close(closed({1, 0, 0}, {0.5, 0, 0}, {}));
  WindowBalance window = closed({1, 0, 0}, {0, 0, 0}, {});  // owed -0.5, nothing given, nothing pending
  EXPECT_DOUBLE_EQ(ledger.close(window).exchange, 0.5);
  window.turnover = 10;  // |J| summed over cells
  ledger = at_rest();
  ledger.close(closed({1, 0, 0}, {0.5, 0, 0}, {}));
  EXPECT_DOUBLE_EQ(ledger.close(window).exchange, 0.05);
}

TEST(Ledger, WhatCouldNotBeHandedOverStaysPending) {
  Ledger ledger = at_rest();
  ledger.close(closed({1, 0, 0}, {0.5, 0, 0}, {}));
  WindowBalance window = closed({1, 0, 0}, {0.25, 0, 0}, {});
  window.pending = {-0.75, 0, 0};
  EXPECT_EQ(ledger.close(window).exchange, 0);
}

TEST(Ledger, SemiImplicitLeavesTheBooksOpen) {
  WindowBalance window;
  window.drag_to_particles = {0, 0, 2};
  window.implicit_to_fluid = {0, 0, -1.5};  // K (u_s - u) dt, not what the particles received
  EXPECT_DOUBLE_EQ(at_rest().close(window).exchange, 0.25);
}

TEST(Ledger, MomentumMayChangeByOutsideImpulsesOnly) {
  Ledger ledger({1, 0, 0}, {0, 0, 0}, 5e-4);
  WindowBalance window = closed({-0.5, 0, 0}, {0.125, 0, 0}, {});
  window.external = {0, 0, -3};
  window.particle_momentum = {0.5, 0, -3};
  window.fluid_momentum = {0.5 + 0.125, 0, 0};
  EXPECT_EQ(ledger.close(window).momentum, 0);
  window = closed({0, 0, 0}, {0, 0, 0}, {-0.125, 0, 0});
  window.particle_momentum = {0.375, 0, -3};
  window.fluid_momentum = {0.625, 0, 0.25};  // 0.25 from nowhere; the scale is |m_s| + |m_f| of now
  EXPECT_DOUBLE_EQ(ledger.close(window).momentum, 0.25 / (std::hypot(0.375, 3) + std::hypot(0.625, 0.25)));
}

TEST(Ledger, SolidAndLiquidVolume) {
  Ledger ledger = at_rest();
  WindowBalance window = closed({}, {}, {});
  window.bulk_solid_volume = 4e-5 * (1 - 1e-6);
  window.liquid_in = 1e-4;
  window.liquid_volume = 6e-4 * (1 + 1e-5);
  const ConservationErrors errors = ledger.close(window);
  EXPECT_NEAR(errors.solid_volume, 1e-6, 1e-15);
  EXPECT_NEAR(errors.liquid_volume, 1e-5, 1e-15);
  EXPECT_EQ(errors.exchange, 0);
}

TEST(Ledger, KeepsTheWorstAndDoesNotLoseWhatIsNotANumber) {
  Ledger ledger = at_rest();
  WindowBalance bad = closed({1, 0, 0}, {}, {});
  bad.explicit_to_fluid.x += 1e-3;
  bad.liquid_volume *= 1.01;
  ledger.close(bad);
  ledger.close(closed({1, 0, 0}, {}, {}));
  EXPECT_NEAR(ledger.worst().exchange, 1e-3, 1e-15);
  EXPECT_NEAR(ledger.worst().liquid_volume, 1e-2, 1e-14);
  bad.fluid_momentum.y = std::nan("");
  ledger.close(bad);
  ledger.close(closed({1, 0, 0}, {}, {}));
  EXPECT_TRUE(std::isinf(ledger.worst().momentum));
}

}  // namespace
}  // namespace demvof
