// SPDX-License-Identifier: GPL-3.0-or-later

// Momentum exchange in one bulk cell: fluid of mass 1, window 1, drag factor K, particles of mass phi of
// which the fraction `held` (by drag) is held at rest by contacts. What the particles do in a window is
// solved exactly; what the fluid gets is what fluid_source() says. Stability is the growth of the linear map
// from window to window, and the books are closed by the ledger.

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <vector>

#include "coupler/exchange/ledger.hpp"
#include "coupler/exchange/momentum_exchange.hpp"

namespace demvof {
namespace {

constexpr double window = 1.0;
const std::vector<double> drag_factors = {1e-3, 1e-2, 0.1, 0.5, 1, 1.9, 2.1, 5, 10, 1e2, 1e3, 1e4, 1e5, 1e6};
const std::vector<double> mass_loadings = {1e-4, 1e-3, 1e-2, 0.1, 0.8, 1.25, 10, 1e2, 1e3, 1e4};
const std::vector<double> held_fractions = {0, 0.1, 0.5, 0.9, 1};

struct State {
  double u = 0;  // fluid, m/s
  double v = 0;  // free particles, m/s
  double m = 0;  // left-over owed to the particles, N s
};

struct Cell {
  ExchangeScheme scheme;
  double drag_factor, mass_loading, held;

  double held_drag() const { return held * drag_factor; }
  double free_drag() const { return (1 - held) * drag_factor; }
  double free_mass() const { return (1 - held) * mass_loading; }

  /// One window. Books are for the ledger; nothing but x components.
  State advance(const State& now, WindowBalance* books = nullptr) const {
    // Free particles: m dv/dt = k (u - v) + M/dt, exactly.
    const double left_over_free = (1 - held) * now.m;
    State next = now;
    double drag_free = 0;
    if (held < 1) {
      const double target = now.u + left_over_free / free_drag();
      next.v = target + (now.v - target) * std::exp(-free_drag() / free_mass());
      drag_free = free_mass() * (next.v - now.v) - left_over_free;
    }
    const double drag_held = held_drag() * now.u;

    BulkParticles particles;
    particles.drag_impulse.x = drag_free + drag_held;
    particles.drag_factor = drag_factor;
    particles.drag_weighted_velocity.x = free_drag() * next.v;
    particles.drag_response = held_drag();
    if (held < 1) particles.drag_response -= free_mass() * std::expm1(-free_drag() / free_mass());
    particles.response_weighted_velocity.x = particles.drag_response * now.u;

    const FluidSource source = fluid_source(scheme, particles, window);
    next.u = (now.u + window * (source.explicit_force.x + source.coefficient * source.reference_velocity.x)) /
             (1 + window * source.coefficient);
    const double implicit = window * source.coefficient * (source.reference_velocity.x - next.u);
    next.m = hands_back_left_over(scheme) ? -implicit : 0;
    if (books) {
      books->drag_to_particles.x = drag_free + drag_held;
      books->left_over_to_particles.x = now.m;
      books->explicit_to_fluid.x = window * source.explicit_force.x;
      books->implicit_to_fluid.x = implicit;
      books->pending.x = next.m;
      books->turnover = std::abs(drag_free) + std::abs(drag_held);
      books->particle_momentum.x = free_mass() * next.v;
      books->fluid_momentum.x = next.u;
      books->external.x = -(drag_held + held * now.m);  // the contacts take what held particles receive
    }
    return next;
  }

  /// Growth per window in the long run: spectral radius of the map, from its 2^32nd power.
  double growth() const {
    using Matrix = std::array<std::array<double, 3>, 3>;
    Matrix a;
    for (int column = 0; column < 3; ++column) {
      const State image = advance({double(column == 0), double(column == 1), double(column == 2)});
      a[0][column] = image.u;
      a[1][column] = image.v;
      a[2][column] = image.m;
    }
    double log_size = 0;
    const int squarings = 32;
    for (int s = 0; s < squarings; ++s) {
      Matrix square{};
      double size = 0;
      for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) {
          for (int k = 0; k < 3; ++k) square[i][j] += a[i][k] * a[k][j];
          size = std::max(size, std::abs(square[i][j]));
        }
      if (size == 0) return 0;
      for (auto& row : square)
        for (double& value : row) value /= size;
      a = square;
      log_size = 2 * log_size + std::log(size);
    }
    return std::exp(log_size / std::pow(2.0, squarings));
  }
  bool stable() const { return growth() < 1 + 1e-6; }
};

template <class Visit>
void for_all_cells(ExchangeScheme scheme, Visit visit) {
  for (const double held : held_fractions)
    for (const double drag_factor : drag_factors)
      for (const double mass_loading : mass_loadings) {
        SCOPED_TRACE(testing::Message()
                     << "K " << drag_factor << " phi " << mass_loading << " held " << held);
        visit(Cell{scheme, drag_factor, mass_loading, held});
      }
}

TEST(ExchangeStability, ConservativeImplicitIsStableEverywhere) {
  for_all_cells(ExchangeScheme::conservative_implicit,
                [](const Cell& cell) { EXPECT_TRUE(cell.stable()) << cell.growth(); });
}

TEST(ExchangeStability, SemiImplicitIsStableEverywhere) {
  for_all_cells(ExchangeScheme::semi_implicit,
                [](const Cell& cell) { EXPECT_TRUE(cell.stable()) << cell.growth(); });
}

TEST(ExchangeStability, ExplicitIsUnstableBeyondItsLimitAndOnlyThere) {
  // Held particles: u' = (1 - K) u. Free particles: the slip is multiplied by
  // 1 - (1 + phi) (1 - exp(-K/phi)). Either must stay above -1.
  for_all_cells(ExchangeScheme::explicit_drag, [](const Cell& cell) {
    if (cell.held == 1) {
      EXPECT_EQ(cell.stable(), cell.drag_factor < 2);
    }
    if (cell.held == 0) {
      const double response = -(1 + cell.mass_loading) * std::expm1(-cell.drag_factor / cell.mass_loading);
      EXPECT_EQ(cell.stable(), response < 2);
    }
  });
}

/// Runs some windows from a slip of 1; the ledger's worst errors.
ConservationErrors books_of(const Cell& cell, int windows) {
  State state{1, 0, 0};
  Ledger ledger({cell.free_mass() * state.v, 0, 0}, {state.u, 0, 0}, 0);
  for (int n = 0; n < windows; ++n) {
    WindowBalance books;
    state = cell.advance(state, &books);
    ledger.close(books);
  }
  return ledger.worst();
}

TEST(ExchangeStability, ConservativeImplicitClosesItsBooks) {
  for_all_cells(ExchangeScheme::conservative_implicit, [](const Cell& cell) {
    const ConservationErrors errors = books_of(cell, 50);
    EXPECT_LT(errors.exchange, 1e-12);
    EXPECT_LT(errors.momentum, 1e-12);
  });
}

TEST(ExchangeStability, SemiImplicitDoesNotConserveMomentum) {
  double worst = 0;
  for_all_cells(ExchangeScheme::semi_implicit, [&](const Cell& cell) {
    if (cell.held == 0) worst = std::max(worst, books_of(cell, 50).momentum);
  });
  EXPECT_GT(worst, 0.5);
}

TEST(ExchangeStability, FreeParticlesAndFluidEndAtTheirCommonVelocity) {
  for (const double drag_factor : {1.0, 1e3, 1e6})
    for (const double mass_loading : {0.01, 1.0, 100.0}) {
      const Cell cell{ExchangeScheme::conservative_implicit, drag_factor, mass_loading, 0};
      State state{1, 0, 0};
      for (int n = 0; n < 3000; ++n) state = cell.advance(state);
      const double common = 1 / (1 + mass_loading);
      EXPECT_NEAR(state.u, common, 1e-9) << drag_factor << " " << mass_loading;
      EXPECT_NEAR(state.v, common, 1e-9) << drag_factor << " " << mass_loading;
    }
}

TEST(ExchangeStability, StiffDragReachesEquilibriumWithinThreeWindows) {
  for (const double mass_loading : mass_loadings) {
    const Cell cell{ExchangeScheme::conservative_implicit, 1e6, mass_loading, 0};
    State state{1, 0, 0};
    for (int n = 0; n < 3; ++n) state = cell.advance(state);
    EXPECT_NEAR(state.u, 1 / (1 + mass_loading), 0.1) << mass_loading;
  }
}

}  // namespace
}  // namespace demvof
