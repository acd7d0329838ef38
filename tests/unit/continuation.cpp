// SPDX-License-Identifier: GPL-3.0-or-later

// Particles that are told of the fluid of the window's middle (coupling.order 2), in one bulk cell: the map
// of relaxation.cpp with what the pressure owes (owed_pressure.hpp) and what is known of the window before.
// Fluid of density 1, window 1, volume 1. Stability: no disturbance grows that does not grow with order 1.
// Order: two-body relaxation against its exact course.

#include "coupler/exchange/continuation.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <vector>

#include "coupler/exchange/momentum_exchange.hpp"
#include "coupler/exchange/relaxation.hpp"
#include "dem_side/implicit_drag.hpp"
#include "tests/support/growth.hpp"

namespace demvof {
namespace {

constexpr double window = 1;
enum class Mode { volume, shear };

// u, v: fluid, free particles; u_seen, g_seen, a_seen: told, but for what is continued; u_before, a_before:
// of the window before; m: left-over owed to the particles; o: pressure's impulse owed to them.
enum { u, v, u_seen, g_seen, a_seen, u_before, a_now, a_before, m, o, unknowns };
using State = std::array<double, unknowns>;

struct Cell {
  double solid_fraction, density, x;  // eps_s; rho_p; beta window/(mass and added mass of a particle)
  int fluid_steps = 1;
  double added_coefficient = 0, held = 0;
  double ratio = 1;           // of this window to the one before, all of which are of length 1
  double forced_weight = -1;  // >= 0: w

  double eps() const { return 1 - solid_fraction; }
  double added() const { return added_coefficient * solid_fraction; }
  double inertia() const { return solid_fraction * density + added(); }
  double drag() const { return x * inertia() / window; }

  BulkParticles particles() const {
    BulkParticles sum;
    const double theta = inertial_share(drag(), inertia(), window);
    sum.solid_volume = solid_fraction;
    sum.drag_factor = sum.drag_tangent = drag();
    sum.drag_response = drag_response(drag(), solid_fraction * density, window, held, added());
    sum.free_response = drag_response(drag(), solid_fraction * density, window, 0, added());
    sum.pressure_mobility = theta * solid_fraction * (1 + added_coefficient) * solid_fraction / inertia();
    sum.following_volume = (1 - theta) * solid_fraction;
    return sum;
  }
  double relaxation() const {
    return relaxation_factor(Schedule::staggered, making_way_gain(particles(), 1, eps()),
                             particles().drag_response * window / eps(),
                             partly_held(particles(), 1, eps(), window));
  }

  State advance(const State& now, Mode mode, int order) const {
    const double omega = relaxation();
    double w = order == 2 ? continuation_weight(omega) : 0;
    if (forced_weight >= 0) w = forced_weight;
    const double ahead = 0.5 * w * ratio * (now[u] - now[u_before]);
    const double u_told = now[u_seen] + ahead;
    const double w_a = w * continued_acceleration(added_coefficient * solid_fraction / eps());
    const double a_told = now[a_seen] + 0.5 * (1 + ratio) * w_a * (now[a_now] - now[a_before]);
    const double returned = omega / 2 * now[o];
    const double k = drag(), free = 1 - held;
    const double other = -solid_fraction * now[g_seen] + returned + now[m] + added() * a_told;
    const double target = u_told + other / k;
    State next = now;
    next[v] = target + (now[v] - target) * std::exp(-x);
    const double mean = target + (now[v] - target) * mean_decay(x);

    BulkParticles cell = particles();
    cell.drag_impulse.x = k * (u_told - free * mean) + added() * (a_told - free * (next[v] - now[v]));
    cell.response_weighted_velocity.x = cell.drag_response * u_told;
    const FluidSource source = fluid_source(ExchangeScheme::conservative_implicit, cell, window);
    const double step = window / fluid_steps;
    double gradient = 0, pressure = 0, implicit = 0, acceleration = 0;
    for (int n = 1; n <= fluid_steps; ++n) {
      const double before = next[u];
      const double reference = source.reference_velocity.x + (2 * n * step - 1) * ahead;
      const double pull = source.explicit_force.x + source.coefficient * reference;
      if (mode == Mode::volume) {
        next[u] = -solid_fraction * free * mean / eps();
        gradient = (pull - source.coefficient * next[u] - eps() * (next[u] - before) / step) / eps();
      } else {
        next[u] = (eps() * before + step * pull) / (eps() + step * source.coefficient);
      }
      acceleration = (next[u] - before) / step;
      implicit += step * source.coefficient * (reference - next[u]);
      pressure += step * gradient;
    }
    next[m] = -implicit;
    next[o] += solid_fraction * (now[g_seen] * window - pressure) - returned;
    next[u_seen] += omega * (next[u] - now[u_seen]);
    next[g_seen] += omega * (gradient - now[g_seen]);
    next[a_seen] += omega * (acceleration - now[a_seen]);
    next[u_before] = now[u];
    next[a_before] = now[a_now];
    next[a_now] = acceleration;
    return next;
  }

  double growth(Mode mode, int order) const {
    return growth_of<State>([&](const State& unit) { return advance(unit, mode, order); });
  }
};

const std::vector<double> densities = {0.01, 0.1, 0.5, 1.1, 2.5, 8, 100, 1e4};
const std::vector<double> solid_fractions = {1e-4, 0.01, 0.1, 0.2, 0.3, 0.5, 0.6, 0.7};
const std::vector<double> responses = {1e-3, 1e-2, 0.1, 0.3, 1, 3, 10, 100, 1e4};

template <class Visit>
void for_all_cells(double added_coefficient, Visit visit) {
  for (const double density : densities)
    for (const double solid_fraction : solid_fractions)
      for (const double x : responses)
        for (const double held : {0.0, 0.1, 0.5, 0.9, 1.0})
          for (const int steps : {1, 5}) {
            SCOPED_TRACE(testing::Message()
                         << "rho_p " << density << " eps_s " << solid_fraction << " x " << x << " held "
                         << held << " fluid steps " << steps << " C_m " << added_coefficient);
            visit(Cell{solid_fraction, density, x, steps, added_coefficient, held});
          }
}

// With order 1 some light particles grow by what the pressure owes them (docs/stability.md).
void expect_no_more_growth(const Cell& cell) {
  if (continuation_weight(cell.relaxation()) == 0) return;
  for (const Mode mode : {Mode::volume, Mode::shear})
    EXPECT_LT(cell.growth(mode, 2), std::max(1.0, cell.growth(mode, 1)) + 1e-6) << (mode == Mode::shear);
}

TEST(Continuation, NothingGrowsThatDoesNotWithoutIt) {
  int continued = 0, all = 0;
  for_all_cells(0, [&](const Cell& cell) {
    ++all;
    continued += continuation_weight(cell.relaxation()) > 0;
    expect_no_more_growth(cell);
  });
  EXPECT_GT(continued, 0.45 * all);
}

TEST(Continuation, NothingGrowsWithAddedMassUpToItsOwnLimit) {
  for_all_cells(0.5, [](const Cell& cell) {
    if (cell.eps() >= 0.4) expect_no_more_growth(cell);
  });
}

// Windows that grow by as much as a window may, for ever.
TEST(Continuation, NothingGrowsInLongerAndLongerWindows) {
  for (const double added_coefficient : {0.0, 0.5})
    for_all_cells(added_coefficient, [](Cell cell) {
      if (cell.eps() < 0.4) return;
      cell.ratio = 1.5;
      expect_no_more_growth(cell);
    });
}

TEST(Continuation, GrowsWhereItIsNotLeftOff) {
  Cell dense{0.6, 2.5, 100};
  EXPECT_LT(dense.growth(Mode::volume, 2), 1);
  dense.forced_weight = 1;
  EXPECT_GT(dense.growth(Mode::volume, 2), 1.05);
  EXPECT_EQ(continuation_weight(1), 1);
  EXPECT_EQ(continuation_weight(0.75), 0);
  EXPECT_EQ(continuation_weight(0.1), 0);
}

/// Error of the fluid's and the particles' velocity after so many windows, particles that are let go in a
/// fluid of velocity 1: K T = 1, as heavy as the fluid.
double relaxation_error(int windows, int order, int fluid_steps) {
  constexpr double solid_fraction = 1e-6;  // makes no way for anybody
  const Cell cell{solid_fraction, (1 - solid_fraction) / solid_fraction, 1.0 / windows, fluid_steps};
  State state{};
  state[u] = state[u_seen] = state[u_before] = 1;
  for (int n = 0; n < windows; ++n) state = cell.advance(state, Mode::shear, order);
  const double fluid = 0.5 + 0.5 * std::exp(-2.0);
  return std::hypot(state[u] - fluid, state[v] - (1 - fluid));
}

TEST(Continuation, IsOfSecondOrderInTheWindow) {
  for (const int steps : {1, 5}) {
    const double coarse = relaxation_error(20, 2, steps), fine = relaxation_error(40, 2, steps);
    EXPECT_GT(std::log2(coarse / fine), 1.9) << steps;
    EXPECT_LT(coarse, relaxation_error(20, 1, steps) / 5) << steps;
    EXPECT_LT(std::log2(relaxation_error(20, 1, steps) / relaxation_error(40, 1, steps)), 1.1) << steps;
  }
}

}  // namespace
}  // namespace demvof
