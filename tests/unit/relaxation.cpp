// SPDX-License-Identifier: GPL-3.0-or-later

// Particles and fluid that push each other about, in one bulk cell. Fluid of density 1, window 1, volume 1;
// particles of density rho_p, of which the fraction `held` is held by contacts, fill eps_s. What the
// particles do in a window is solved exactly; what the fluid gets and what they are told is what
// fluid_source() and relaxation_factor() say.
//
//   volume   the fluid has to make way: eps u + eps_s v = 0, v the mean over the window; its pressure
//   gradient
//            is what takes it to this velocity, in the first of its steps
//   shear    nobody makes way: u from the momentum equation, no pressure gradient
//
// Stability is the growth of the linear map from window to window.

#include "coupler/exchange/relaxation.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <vector>

#include "coupler/exchange/momentum_exchange.hpp"
#include "dem_side/implicit_drag.hpp"
#include "tests/support/growth.hpp"

namespace demvof {
namespace {

constexpr double window = 1;
enum class Mode { volume, shear };
enum class Seen { relaxed, as_is };

// u, v: fluid, free particles; u_seen, g_seen, a_seen: velocity, pressure gradient, acceleration that the
// particles feel in the coming window; m: left-over owed to them. Of their last window: j, the impulse they
// received, way, eps_s times their mean velocity, and felt, the fluid velocity.
enum { u, v, u_seen, g_seen, a_seen, m, j, way, felt, unknowns };
using State = std::array<double, unknowns>;

struct Cell {
  double solid_fraction, density, x;  // eps_s; rho_p; beta window/(mass and added mass of a particle)
  int fluid_steps = 1;
  double added_coefficient = 0;
  Schedule schedule = Schedule::staggered;
  double held = 0;

  double eps() const { return 1 - solid_fraction; }
  double added() const { return added_coefficient * solid_fraction; }
  double inertia() const { return solid_fraction * density + added(); }
  double drag() const { return x * inertia() / window; }

  BulkParticles particles() const {
    BulkParticles sum;
    const double theta = inertial_share(drag(), inertia(), window);
    sum.solid_volume = solid_fraction;
    sum.drag_factor = drag();
    sum.drag_tangent = drag();
    sum.drag_response = drag_response(drag(), solid_fraction * density, window, held, added());
    sum.free_response = drag_response(drag(), solid_fraction * density, window, 0, added());
    sum.pressure_mobility = theta * solid_fraction * (1 + added_coefficient) * solid_fraction / inertia();
    sum.following_volume = (1 - theta) * solid_fraction;
    return sum;
  }
  double relaxation() const {
    return relaxation_factor(schedule, making_way_gain(particles(), 1, eps()),
                             particles().drag_response * window / eps(),
                             partly_held(particles(), 1, eps(), window));
  }

  State advance(const State& now, Mode mode, Seen seen) const {
    const double k = drag(), free = 1 - held;
    const double other = -solid_fraction * now[g_seen] + now[m] / window + added() * now[a_seen];
    const double target = now[u_seen] + other / k;
    State next = now;
    next[v] = target + (now[v] - target) * std::exp(-x);
    const double mean = target + (now[v] - target) * mean_decay(x);
    next[j] = window * k * (now[u_seen] - free * mean) +
              added() * (window * now[a_seen] - free * (next[v] - now[v]));
    next[way] = solid_fraction * free * mean;
    next[felt] = now[u_seen];

    const State& of_particles = schedule == Schedule::staggered ? next : now;
    BulkParticles cell = particles();
    cell.drag_impulse.x = of_particles[j];
    cell.response_weighted_velocity.x = cell.drag_response * of_particles[felt];
    const FluidSource source = fluid_source(ExchangeScheme::conservative_implicit, cell, window);

    const double step = window / fluid_steps;
    double gradient = 0, implicit = 0, acceleration = 0;
    for (int n = 0; n < fluid_steps; ++n) {
      const double before = next[u];
      const double pull = source.explicit_force.x + source.coefficient * source.reference_velocity.x;
      if (mode == Mode::volume) {
        next[u] = -of_particles[way] / eps();
        gradient = (pull - source.coefficient * next[u] - eps() * (next[u] - before) / step) / eps();
      } else {
        next[u] = (eps() * before + step * pull) / (eps() + step * source.coefficient);
      }
      acceleration = (next[u] - before) / step;
      implicit += step * source.coefficient * (source.reference_velocity.x - next[u]);
    }
    next[m] = -implicit;
    const double omega = seen == Seen::relaxed ? relaxation() : 1;
    next[u_seen] += omega * (next[u] - now[u_seen]);
    next[g_seen] += omega * (gradient - now[g_seen]);
    next[a_seen] += omega * (acceleration - now[a_seen]);
    return next;
  }

  /// Growth per window in the long run.
  double growth(Mode mode, Seen seen = Seen::relaxed) const {
    return growth_of<State>([&](const State& unit) { return advance(unit, mode, seen); });
  }
};

const std::vector<double> densities = {0.01, 0.03, 0.1, 0.2, 0.5, 0.8, 1.1, 2.5, 5, 8, 20};
const std::vector<double> solid_fractions = {0.01, 0.05, 0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.65, 0.7};
const std::vector<double> responses = {1e-3, 1e-2, 0.03, 0.1, 0.3, 1, 1.7, 3, 10, 30, 100, 1e3, 1e4};

template <class Visit>
void for_all_cells(double added_coefficient, Visit visit) {
  for (const double density : densities)
    for (const double solid_fraction : solid_fractions)
      for (const double x : responses)
        for (const int steps : {1, 2, 5, 20}) {
          SCOPED_TRACE(testing::Message() << "rho_p " << density << " eps_s " << solid_fraction << " x " << x
                                          << " fluid steps " << steps << " C_m " << added_coefficient);
          visit(Cell{solid_fraction, density, x, steps, added_coefficient});
        }
}

TEST(Relaxation, NothingGrows) {
  for_all_cells(0, [](const Cell& cell) {
    EXPECT_LT(cell.growth(Mode::volume), 1 + 1e-6);
    EXPECT_LT(cell.growth(Mode::shear), 1 + 1e-6);
  });
}

// The reaction to the added mass is a window late (added_mass_exchange.cpp: by itself stable while it is
// below the fluid's own inertia, eps > C_m/(1 + C_m)). Told a relaxed acceleration, dense beds bear it beyond
// that.
TEST(Relaxation, NothingGrowsWithAddedMass) {
  for (const Schedule schedule : {Schedule::staggered, Schedule::concurrent})
    for (const double held : {0.0, 0.1, 0.5, 0.9})
      for_all_cells(0.5, [schedule, held](Cell cell) {
        if (schedule == Schedule::concurrent && cell.solid_fraction > 0.65) return;
        cell.schedule = schedule;
        cell.held = held;
        EXPECT_LT(cell.growth(Mode::volume), 1 + 1e-6) << held;
        EXPECT_LT(cell.growth(Mode::shear), 1 + 1e-6) << held;
      });
  const Cell heavy{0.7, 20, 1e-3, 1, 1.0};  // C_m 1: nothing relaxes what hardly moves
  EXPECT_NEAR(heavy.growth(Mode::shear), 1.81, 0.01);
}

TEST(Relaxation, NothingGrowsWithSomeHeld) {
  for_all_cells(0, [](Cell cell) {
    for (const double held : {0.1, 0.5, 0.9}) {
      cell.held = held;
      EXPECT_LT(cell.growth(Mode::volume), 1 + 1e-6) << held;
      EXPECT_LT(cell.growth(Mode::shear), 1 + 1e-6) << held;
    }
  });
}

TEST(Relaxation, NothingGrowsWithAWindowOfLag) {
  for (const double held : {0.0, 0.5, 0.9})
    for_all_cells(0, [held](Cell cell) {
      if (cell.solid_fraction > 0.65) return;
      cell.schedule = Schedule::concurrent;
      cell.held = held;
      EXPECT_LT(cell.growth(Mode::volume), 1 + 1e-6) << held;
      EXPECT_LT(cell.growth(Mode::shear), 1 + 1e-6) << held;
    });
}

// Far above the fluid's mass: dust and beads in a gas.
TEST(Relaxation, NothingHeavyGrowsWithAWindowOfLag) {
  for (const double density : {100.0, 1e3, 1e4})
    for (const double solid_fraction : {1e-4, 1e-3, 0.01, 0.1, 0.3, 0.6})
      for (const double x : responses)
        for (const int steps : {1, 5, 20}) {
          const Cell cell{solid_fraction, density, x, steps, 0, Schedule::concurrent};
          EXPECT_LT(cell.growth(Mode::volume), 1 + 1e-6) << density << " " << solid_fraction << " " << x;
          EXPECT_LT(cell.growth(Mode::shear), 1 + 1e-6) << density << " " << solid_fraction << " " << x;
        }
}

TEST(Relaxation, WithoutItBedsGrow) {
  // Where inertia rules: times R = s rho/rho_p per window, however short.
  EXPECT_NEAR((Cell{0.6, 0.05, 1e-3}.growth(Mode::volume, Seen::as_is)), 1.5 / 0.05, 20);
  EXPECT_GT((Cell{0.6, 0.05, 1e-6}.growth(Mode::volume, Seen::as_is)), 10);
  // Where drag rules: dense beds, in windows longer than the particles' response.
  EXPECT_GT((Cell{0.6, 2.5, 1e4}.growth(Mode::volume, Seen::as_is)), 1.5);
  EXPECT_LT((Cell{0.6, 2.5, 1e-2}.growth(Mode::volume, Seen::as_is)), 1);
}

TEST(Relaxation, LeavesDiluteAndHeavyParticlesAlone) {
  for (const double x : responses) {
    EXPECT_EQ((Cell{0.1, 2.5, x}.relaxation()), 1);
    EXPECT_EQ((Cell{0.01, 0.1, x}.relaxation()), 1);
  }
  EXPECT_EQ(making_way_gain(BulkParticles{}, 1000, 1e-6), 0);
  BulkParticles fixed;
  fixed.solid_volume = 0.6;
  EXPECT_EQ(making_way_gain(fixed, 1000, 0.4), 0) << "no force moves them";
}

TEST(Relaxation, IsAShareOfTheChange) {
  for_all_cells(0.5, [](const Cell& cell) {
    EXPECT_GT(cell.relaxation(), 1e-3);
    EXPECT_LE(cell.relaxation(), 1);
  });
}

}  // namespace
}  // namespace demvof
