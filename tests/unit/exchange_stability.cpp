// SPDX-License-Identifier: GPL-3.0-or-later

// Momentum exchange in one bulk cell: fluid of mass 1, window 1, drag factor K, particles of mass phi of
// which the fraction `held` (by drag) is held at rest by contacts. Around the slip of a steady state the drag
// changes by n K for each change of the slip, n = 1 (Stokes) to 2 (Newton); of what holds, only the part
// `support` may be seen (dem_side/support.hpp). What the particles do in a window is solved exactly; what the
// fluid gets is what fluid_source() says. Stability is the growth of the linear map from window to window,
// and the books are closed by the ledger.

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <vector>

#include "coupler/config/enum_names.hpp"
#include "coupler/exchange/ledger.hpp"
#include "coupler/exchange/momentum_exchange.hpp"
#include "coupler/exchange/relaxation.hpp"
#include "dem_side/implicit_drag.hpp"
#include "tests/support/growth.hpp"

namespace demvof {
namespace {

constexpr double window = 1.0;
const std::vector<double> drag_factors = {1e-3, 1e-2, 0.1, 0.5, 1, 1.9, 2.1, 5, 10, 1e2, 1e3, 1e4, 1e5, 1e6};
const std::vector<double> mass_loadings = {1e-4, 1e-3, 1e-2, 0.1, 0.8, 1.25, 10, 1e2, 1e3, 1e4};
const std::vector<double> held_fractions = {0, 0.1, 0.5, 0.9, 1};

enum { u, v, m, j, felt, seen, unknowns };
/// u: fluid, v: free particles, m/s; m: left-over owed to the particles, N s; told: the fluid velocity that
/// the particles are told for the coming window, m/s. Of the particles' last window: j, the drag impulse, N
/// s, and felt, the fluid velocity they felt, m/s.
using State = std::array<double, unknowns>;

/// The fluid that particles are told: relaxed as the programs do, or as it is.
enum class Seen { relaxed, as_is };

struct Cell {
  ExchangeScheme scheme;
  Schedule schedule;
  Seen tell;
  double drag_factor, mass_loading, held;
  int fluid_steps = 1;
  double exponent = 1, support = 1;
  double counted_exponent = exponent;  // n as the response counts it

  double held_drag() const { return held * exponent * drag_factor; }
  double free_drag() const { return (1 - held) * exponent * drag_factor; }
  double free_mass() const { return (1 - held) * mass_loading; }
  BulkParticles particles() const {
    BulkParticles sum;
    sum.drag_factor = drag_factor;
    sum.drag_response =
        demvof::drag_response(counted_exponent * drag_factor, mass_loading, window, support * held);
    sum.drag_tangent = counted_exponent * drag_factor;
    sum.free_response = demvof::drag_response(counted_exponent * drag_factor, mass_loading, window, 0);
    return sum;
  }
  double drag_response() const { return particles().drag_response; }

  /// What a window gives: state, and books for the ledger; nothing but x components.
  State advance(const State& now, WindowBalance* books = nullptr) const {
    // Free particles: m dv/dt = k (u - v) + M/dt, exactly.
    const double left_over_free = (1 - held) * now[m];
    State next = now;
    double drag_free = 0;
    if (held < 1) {
      const double target = now[seen] + left_over_free / free_drag();
      next[v] = target + (now[v] - target) * std::exp(-free_drag() / free_mass());
      drag_free = free_mass() * (next[v] - now[v]) - left_over_free;
    }
    const double drag_held = held_drag() * now[seen];
    next[j] = drag_free + drag_held;
    next[felt] = now[seen];

    // The fluid's window: with what the particles did in it, or in the one before.
    const State& of_particles = schedule == Schedule::staggered ? next : now;
    BulkParticles particles = this->particles();
    particles.drag_impulse.x = of_particles[j];
    particles.drag_weighted_velocity.x = free_drag() * of_particles[v];
    particles.response_weighted_velocity.x = particles.drag_response * of_particles[felt];
    const FluidSource source = fluid_source(scheme, particles, window);
    const double step = window / fluid_steps;
    double implicit = 0;
    for (int n = 0; n < fluid_steps; ++n) {
      const double pull = source.explicit_force.x + source.coefficient * source.reference_velocity.x;
      next[u] = (next[u] + step * pull) / (1 + step * source.coefficient);
      implicit += step * source.coefficient * (source.reference_velocity.x - next[u]);
    }
    next[m] = hands_back_left_over(scheme) ? -implicit : 0;
    double omega = 1;
    if (tell == Seen::relaxed)
      omega = hands_back_left_over(scheme) ? relaxation_factor(schedule, 0, drag_response() * window,
                                                               partly_held(particles, 1, 1, window))
                                           : relaxation_factor(schedule, 0, 0);
    next[seen] = now[seen] + omega * (next[u] - now[seen]);
    if (books) {
      books->drag_to_particles.x = next[j];
      books->left_over_to_particles.x = now[m];
      books->explicit_to_fluid.x = window * source.explicit_force.x;
      books->implicit_to_fluid.x = implicit;
      books->pending.x = next[m];
      if (schedule == Schedule::concurrent && pays_drag_impulse(scheme)) books->pending.x -= next[j];
      books->turnover = std::abs(drag_free) + std::abs(drag_held);
      books->particle_momentum.x = free_mass() * next[v];
      books->fluid_momentum.x = next[u];
      books->external.x = -(drag_held + held * now[m]);  // the contacts take what held particles receive
    }
    return next;
  }

  /// Growth per window in the long run.
  double growth() const {
    return growth_of<State>([this](const State& unit) { return advance(unit); });
  }
  bool stable() const { return growth() < 1 + 1e-6; }
};

/// The fluid after some windows from a slip of 1.
double fluid_after(int windows, const Cell& cell) {
  State state{};
  state[u] = state[seen] = 1;
  for (int n = 0; n < windows; ++n) state = cell.advance(state);
  return state[u];
}

template <class Visit>
void for_all_cells(ExchangeScheme scheme, Schedule schedule, Seen tell, Visit visit) {
  for (const double held : held_fractions)
    for (const double drag_factor : drag_factors)
      for (const double mass_loading : mass_loadings)
        for (const int fluid_steps : {1, 4, 50}) {
          SCOPED_TRACE(testing::Message() << "K " << drag_factor << " phi " << mass_loading << " held "
                                          << held << " fluid steps " << fluid_steps);
          visit(Cell{scheme, schedule, tell, drag_factor, mass_loading, held, fluid_steps});
        }
}
template <class Visit>
void for_all_cells(ExchangeScheme scheme, Schedule schedule, Visit visit) {
  for_all_cells(scheme, schedule, Seen::relaxed, visit);
}

class ExchangeStability : public testing::TestWithParam<Schedule> {};
INSTANTIATE_TEST_SUITE_P(Schedules, ExchangeStability,
                         testing::Values(Schedule::staggered, Schedule::concurrent),
                         [](const auto& info) { return name_of(info.param); });

TEST_P(ExchangeStability, ConservativeImplicitIsStableEverywhere) {
  for_all_cells(ExchangeScheme::conservative_implicit, GetParam(),
                [](const Cell& cell) { EXPECT_TRUE(cell.stable()) << cell.growth(); });
}

TEST_P(ExchangeStability, SemiImplicitIsStableEverywhere) {
  for_all_cells(ExchangeScheme::semi_implicit, GetParam(),
                [](const Cell& cell) { EXPECT_TRUE(cell.stable()) << cell.growth(); });
}

// Newton's drag, and beds of which contacts are seen to hold half and more.
TEST_P(ExchangeStability, ConservativeImplicitIsStableForAnyDragLawAndSupport) {
  for (const double exponent : {1.0, 1.5, 2.0})
    for (const double support : {1.0, 0.7, 0.5})
      for_all_cells(ExchangeScheme::conservative_implicit, GetParam(), [&](Cell cell) {
        if (cell.fluid_steps == 4 || (support < 1 && cell.held < 0.9)) return;
        cell.exponent = cell.counted_exponent = exponent;
        cell.support = support;
        EXPECT_TRUE(cell.stable()) << cell.growth() << " n " << exponent << " S " << support;
      });
}

// Held in Newton's range, drag much stiffer than the window: with the secant the error keeps its size from
// window to window, with the other sign, and grows where not all of what holds is seen; the tangent leaves
// nothing of it.
TEST(ExchangeTangent, IsWhatTheFluidAnswersTo) {
  Cell cell{ExchangeScheme::conservative_implicit, Schedule::staggered, Seen::as_is, 1e4, 0.01, 1};
  cell.exponent = cell.counted_exponent = 2;
  EXPECT_LT(std::abs(fluid_after(2, cell)), 1e-7);
  cell.counted_exponent = 1;
  EXPECT_NEAR(fluid_after(10, cell), 1, 0.01);
  EXPECT_NEAR(fluid_after(11, cell), -1, 0.01);
  cell.support = 0.7;
  EXPECT_GT(cell.growth(), 1.2);
}

// A bed near lift-off, whose contacts are seen to hold a part h of it only: told the fluid as it is, a stiff
// one multiplies a disturbance by (h - 1)/h.
TEST_P(ExchangeStability, BedsHeldButSeenToLessThanHalfDoNotGrow) {
  const double least = GetParam() == Schedule::staggered ? 0.15 : 0.2;
  for (const double support : {0.45, 0.3, 0.2, least})
    for_all_cells(ExchangeScheme::conservative_implicit, GetParam(), [support](Cell cell) {
      if (cell.held < 0.9) return;
      cell.support = support;
      EXPECT_TRUE(cell.stable()) << cell.growth() << " S " << support;
    });
}
TEST(ExchangeSupport, StiffBedsHeldButSeenToATenthGrow) {  // docs/stability.md
  Cell cell{ExchangeScheme::conservative_implicit, Schedule::staggered, Seen::as_is, 1e4, 1e-2, 1};
  cell.support = 0.3;
  EXPECT_GT(cell.growth(), 2);
  cell.tell = Seen::relaxed;
  cell.support = 0.1;
  EXPECT_NEAR(cell.growth(), 3.3, 0.1);
}

// Told the fluid as it is, free particles that outweigh it swing with a window of lag.
TEST(ExchangeTold, AsItIsGrowsWithAWindowOfLag) {
  int unstable = 0, all = 0;
  double fastest = 0;
  for_all_cells(ExchangeScheme::conservative_implicit, Schedule::concurrent, Seen::as_is,
                [&](const Cell& cell) {
                  if (cell.held > 0 || cell.fluid_steps > 1) return;
                  ++all;
                  unstable += !cell.stable();
                  fastest = std::max(fastest, cell.growth());
                });
  EXPECT_GT(double(unstable) / all, 0.05);
  EXPECT_GT(fastest, 1.1);
}

TEST(ExchangeTold, IsTheFluidAsItIsWhereNothingAsksForLess) {
  EXPECT_EQ(relaxation_factor(Schedule::staggered, 0, 1e6), 1);
  EXPECT_EQ(relaxation_factor(Schedule::concurrent, 0, 0.8), 1);
  EXPECT_EQ(relaxation_factor(Schedule::concurrent, 0, 1e6), 1 / 1.9);
}

TEST(ExchangeLeftOver, ParticlesTakeNoMoreThanTheirNumberStandsFor) {
  EXPECT_EQ(share_for_particles(2, 2), 1);
  EXPECT_EQ(share_for_particles(2, 3), 1);
  EXPECT_EQ(share_for_particles(2, 0.5), 0.25);
  EXPECT_EQ(share_for_particles(2, 0), 0);
  EXPECT_EQ(share_for_particles(0, 0), 1) << "nothing is owed";
}

TEST(ExchangeLimits, ExplicitIsUnstableBeyondItsLimitAndOnlyThere) {
  // Held particles: u' = (1 - K) u. Free particles: the slip is multiplied by
  // 1 - (1 + phi) (1 - exp(-K/phi)). Either must stay above -1.
  for_all_cells(ExchangeScheme::explicit_drag, Schedule::staggered, [](const Cell& cell) {
    if (cell.held == 1) {
      EXPECT_EQ(cell.stable(), cell.drag_factor < 2);
    }
    if (cell.held == 0) {
      const double response = -(1 + cell.mass_loading) * std::expm1(-cell.drag_factor / cell.mass_loading);
      EXPECT_EQ(cell.stable(), response < 2);
    }
  });
}

TEST(ExchangeLimits, AWindowOfLagHalvesTheLimitOfExplicit) {
  // Held particles: u'' = u' - K u, so that u'' grows once K > 1.
  for_all_cells(ExchangeScheme::explicit_drag, Schedule::concurrent, [](const Cell& cell) {
    if (cell.held == 1 && cell.drag_factor != 1) {
      EXPECT_EQ(cell.stable(), cell.drag_factor < 1);
    }
  });
}

/// Runs some windows from a slip of 1; the ledger's worst errors.
ConservationErrors books_of(const Cell& cell, int windows) {
  State state{};
  state[u] = state[seen] = 1;
  Ledger ledger({cell.free_mass() * state[v], 0, 0}, {state[u], 0, 0}, 0);
  for (int n = 0; n < windows; ++n) {
    WindowBalance books;
    state = cell.advance(state, &books);
    ledger.close(books);
  }
  return ledger.worst();
}

TEST_P(ExchangeStability, ConservativeImplicitClosesItsBooks) {
  for_all_cells(ExchangeScheme::conservative_implicit, GetParam(), [](const Cell& cell) {
    const ConservationErrors errors = books_of(cell, 50);
    EXPECT_LT(errors.exchange, 1e-12);
    EXPECT_LT(errors.momentum, std::max(1e-12, 1e-14 * cell.drag_factor));  // K (u_ref - u): what cancels
  });
}

TEST_P(ExchangeStability, SemiImplicitDoesNotConserveMomentum) {
  double worst = 0;
  for_all_cells(ExchangeScheme::semi_implicit, GetParam(), [&](const Cell& cell) {
    if (cell.held == 0) worst = std::max(worst, books_of(cell, 50).momentum);
  });
  EXPECT_GT(worst, 0.5);
}

/// The same with free particles.
double fluid_after(int windows, Schedule schedule, double drag_factor, double mass_loading) {
  return fluid_after(windows, {ExchangeScheme::conservative_implicit, schedule, Seen::relaxed, drag_factor,
                               mass_loading, 0});
}

TEST_P(ExchangeStability, FreeParticlesAndFluidEndAtTheirCommonVelocity) {
  for (const double drag_factor : {1.0, 1e3})
    for (const double mass_loading : {0.01, 1.0, 100.0})
      EXPECT_NEAR(fluid_after(100000, GetParam(), drag_factor, mass_loading), 1 / (1 + mass_loading), 1e-9)
          << drag_factor << " " << mass_loading;
}

TEST(ExchangeSpeed, StiffDragReachesEquilibriumWithinThreeWindows) {
  for (const double mass_loading : mass_loadings)
    EXPECT_NEAR(fluid_after(3, Schedule::staggered, 1e6, mass_loading), 1 / (1 + mass_loading), 0.1)
        << mass_loading;
}

TEST(ExchangeSpeed, AWindowOfLagTakesTensOfWindowsWhereHeavyParticlesHaveStiffDrag) {
  EXPECT_NEAR(fluid_after(10, Schedule::concurrent, 1e3, 0.1), 1 / 1.1,
              0.01);  // lighter than the fluid: ten do
  EXPECT_NEAR(fluid_after(30, Schedule::concurrent, 1e3, 10), 1 / 11.0, 0.02);
}

}  // namespace
}  // namespace demvof
