// SPDX-License-Identifier: GPL-3.0-or-later
// Added mass in the momentum exchange of one bulk cell (staggered): fluid of mass 1, window 1, drag factor K,
// particles of mass phi and added mass A, of which the fraction `held` is held at rest. The particles' window
// is solved exactly; what the fluid gets is what fluid_source() says. exchange_stability.cpp is the same
// without added mass.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "coupler/exchange/momentum_exchange.hpp"
#include "dem_side/implicit_drag.hpp"
#include "tests/support/growth.hpp"

namespace demvof {
namespace {

constexpr double window = 1;

// Fluid, free particles, m/s; left-over owed, N s; acceleration of the fluid in the last window, m/s2.
enum { u, v, m, a, unknowns };
using State = std::array<double, unknowns>;

struct Cell {
  double drag_factor, mass_loading, added_mass, held;

  /// One window; open: momentum that is neither in fluid, particles or left-over nor taken by contacts, N s.
  State advance(const State& now, double* open = nullptr) const {
    const double free = 1 - held, k = free * drag_factor, mass = free * mass_loading,
                 added = free * added_mass;
    State next = now;
    double other = held * added_mass * now[a];  // added mass alone
    double taken = held * drag_factor * now[u] + other;
    const double by_contacts = taken + held * now[m];
    if (held < 1) {
      // (m + m_a) dv/dt = k (u - v) + m_a Du/Dt + M/dt
      const double target = now[u] + (free * now[m] + added * now[a]) / k;
      next[v] = target + (now[v] - target) * std::exp(-k / (mass + added));
      taken += mass * (next[v] - now[v]) - free * now[m];
      other += added * (now[a] - (next[v] - now[v]));
    }
    BulkParticles particles;
    particles.drag_impulse.x = taken;
    particles.drag_factor = drag_factor;
    particles.drag_weighted_velocity.x = k * next[v] - other;
    particles.drag_response = held * drag_factor + (held < 1 ? drag_response(k, mass, window, 0, added) : 0);
    particles.response_weighted_velocity.x = particles.drag_response * now[u];
    const FluidSource source = fluid_source(ExchangeScheme::conservative_implicit, particles, window);
    const double pull = source.explicit_force.x + source.coefficient * source.reference_velocity.x;
    next[u] = (now[u] + pull) / (1 + source.coefficient);
    next[m] = -source.coefficient * (source.reference_velocity.x - next[u]);
    next[a] = next[u] - now[u];
    if (open) *open = next[u] - now[u] + mass * (next[v] - now[v]) + next[m] - now[m] + by_contacts;
    return next;
  }

  /// Growth per window in the long run.
  double growth() const {
    return growth_of<State>([this](const State& unit) { return advance(unit); });
  }
};

template <class Visit>
void for_all_cells(Visit visit) {
  for (const double held : {0.0, 0.1, 0.5, 0.9, 1.0})
    for (const double drag_factor : {1e-3, 0.1, 1.0, 1.9, 2.1, 10.0, 1e3, 1e6})
      for (const double mass_loading : {1e-4, 1e-2, 0.8, 1.25, 10.0, 1e4})
        for (const double added_mass : {0.1, 0.5, 0.75, 0.95}) {
          SCOPED_TRACE(testing::Message() << "K " << drag_factor << " phi " << mass_loading << " A "
                                          << added_mass << " held " << held);
          visit(Cell{drag_factor, mass_loading, added_mass, held});
        }
}

// The reaction to the added mass reaches the fluid a window late, as its acceleration of the last one times
// at most A: stable while A is below 1, eps > C_m/(1 + C_m), and not beyond.
TEST(AddedMassExchange, IsStableUpToTheFluidsMass) {
  for_all_cells([](const Cell& cell) { EXPECT_LT(cell.growth(), 1 + 1e-6); });
  EXPECT_NEAR((Cell{1e-3, 1e4, 1.1, 0}.growth()), 1.1, 0.01);
}

TEST(AddedMassExchange, ConservesMomentum) {
  for_all_cells([](const Cell& cell) {
    State state{1, 0, 0, 0};
    double turnover = 1;
    for (int n = 0; n < 50; ++n) {
      double open = 0;
      const State next = cell.advance(state, &open);
      turnover = std::max({turnover, std::abs(next[m]), cell.mass_loading * std::abs(next[v]),
                           cell.drag_factor * std::abs(state[u])});
      EXPECT_LT(std::abs(open), 1e-12 * turnover);
      state = next;
    }
  });
}

// What is not drag reaches the fluid in full with every scheme, with drag and without.
TEST(MomentumExchange, GivesTheFluidTheReactionToLiftAndAddedMass) {
  const double fluid = 0.3, particle = 0.1, other = 0.7;  // m/s; lift and added mass, N
  for (const ExchangeScheme scheme :
       {ExchangeScheme::explicit_drag, ExchangeScheme::semi_implicit, ExchangeScheme::conservative_implicit})
    for (const double beta : {0.0, 2.0}) {
      BulkParticles cell;
      cell.drag_impulse.x = window * (beta * (fluid - particle) + other);
      cell.drag_factor = cell.drag_response = beta;
      cell.drag_weighted_velocity.x = beta * particle - other;
      cell.response_weighted_velocity.x = beta * fluid;
      const FluidSource source = fluid_source(scheme, cell, window);
      const double force =
          source.explicit_force.x + source.coefficient * (source.reference_velocity.x - fluid);
      EXPECT_NEAR(force, -beta * (fluid - particle) - other, 1e-15);
    }
}

}  // namespace
}  // namespace demvof
