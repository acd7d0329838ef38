// SPDX-License-Identifier: GPL-3.0-or-later
// The history force of the real particle side against exact solutions.

#include <cmath>

#include "coupler/closures/drag.hpp"
#include "dem_side/forces.hpp"
#include "tests/mock/dem_fixture.hpp"
#include "tests/support/mpi_main.hpp"

namespace demvof_test {
namespace {

using demvof::FluidAtParticle;
using demvof::FluidForces;
using demvof::ForceParameters;

ForceParameters with_history() {
  ForceParameters parameters;
  parameters.pressure_gradient = false;
  parameters.added_mass = 0.5;
  parameters.history = true;
  return parameters;
}

void window(demvof::Dem& dem, FluidForces& forces, const FluidAtParticle& fluid, int steps) {
  forces.begin_window(std::vector<FluidAtParticle>(dem.particles().count, fluid), steps * dem.time_step());
  dem.run(steps);
}

double x_momentum(const demvof::Dem& dem) {
  const auto particles = dem.particles();
  double momentum = 0;
  for (int i = 0; i < particles.count; ++i)
    momentum += particles.mass[i] * particles.velocity[i][0] + 0.5 * dem.time_step() * particles.force[i][0];
  MPI_Allreduce(MPI_IN_PLACE, &momentum, 1, MPI_DOUBLE, MPI_SUM, dem.world());
  return momentum;
}

TEST(DemHistory, HasTheKernel) {
  for (const double step : {1e-6, 1e-3}) {
    const demvof::HistoryKernel kernel(step);
    for (double age = 1; age < 1e6; age *= 1.3)
      EXPECT_NEAR(kernel(age * step) * std::sqrt(age * step), 1, 6e-3) << age;
  }
}

// A light sphere starts from rest under a steady force in a viscous fluid:
//   v' + v/T + k int v'(s) (t - s)^-1/2 ds = a_0
//   v = a_0 T (1 + (p exp(q^2 t) erfc(q sqrt t) - q exp(p^2 t) erfc(p sqrt t)) / (q - p)),   p q = 1/T, p + q
//   = k sqrt(pi)
// Without the history it would have its last speed at the end; with it 0.66 of that.
TEST(DemHistory, FollowsTheExactStartOfALightSphere) {
  const double step = 2e-6, density = 250, rho = 1000, mu = 1, force = 1e-9;
  Scene scene("history_start", empty_box(step) + bead({0.05, 0.05, 0.2}) + "set group all diameter " +
                                   std::to_string(bead_diameter) + " density " + std::to_string(density) +
                                   "\n" + integrate);
  ForceParameters parameters = with_history();
  parameters.viscous_stress = true;  // a force that does not act before the first window
  FluidForces forces(*scene.dem, parameters);
  scene.dem->set_up();
  FluidAtParticle fluid;
  fluid.density = rho;
  fluid.viscosity = mu;
  fluid.gradients.stress_force = {force / bead_volume, 0, 0};
  const double mass = density * bead_volume, inertia = mass + 0.5 * rho * bead_volume;
  const double rate = demvof::stokes_factor(bead_diameter, mu) / inertia;
  const double sum = std::sqrt(pi) * demvof::history_factor(bead_diameter, rho, mu) / inertia;
  const double root = std::sqrt(sum * sum - 4 * rate), p = (sum - root) / 2, q = (sum + root) / 2;
  const auto grown = [](double x) { return std::exp(x * x) * std::erfc(x); };
  for (int n = 1; n <= 4; ++n) {
    window(*scene.dem, forces, fluid, 500);
    const double t = n * 500 * step;
    const double exact =
        force / inertia / rate * (1 + (p * grown(q * std::sqrt(t)) - q * grown(p * std::sqrt(t))) / (q - p));
    EXPECT_NEAR(x_momentum(*scene.dem) / mass / exact, 1, 1e-3) << t;
    const double without = force / inertia / rate * (1 - std::exp(-rate * t));
    EXPECT_LT(exact, 0.9 * without);
  }
  EXPECT_EQ(forces.closures().back().first, "history");
}

// The reaction is exchanged: what the fluid gets and what the sphere gains add up to the force from outside.
TEST(DemHistory, HandsTheReactionBack) {
  const double step = 1e-5;
  Scene scene("history_books", empty_box(step) + bead({0.05, 0.05, 0.2}) + bead_properties() + integrate);
  FluidForces forces(*scene.dem, with_history());
  scene.dem->set_up();
  FluidAtParticle fluid;
  fluid.density = 1000;
  fluid.viscosity = 0.1;
  for (int n = 0; n < 3; ++n) {
    fluid.velocity = {1e-4 * n, 0, 0};
    fluid.gradients.acceleration = {0.1, 0, 0};
    const double before = x_momentum(*scene.dem);
    window(*scene.dem, forces, fluid, 100);
    double given = forces.impulses().drag.x;
    MPI_Allreduce(MPI_IN_PLACE, &given, 1, MPI_DOUBLE, MPI_SUM, scene.dem->world());
    EXPECT_NEAR((x_momentum(*scene.dem) - before) / given, 1, 1e-12) << n;
    double exchanged = 0;
    for (const auto& row : all_of(forces.contributions(), *scene.dem)) exchanged += row.drag_impulse.x;
    MPI_Allreduce(MPI_IN_PLACE, &exchanged, 1, MPI_DOUBLE, MPI_SUM, scene.dem->world());
    EXPECT_NEAR(exchanged / given, 1, 1e-12) << n;
  }
}

// A sphere moved down at a steady speed into a liquid at rest: what becomes wet meets its whole slip,
//   F = B w int a'(s) (t - s)^-1/2 ds,
// while in the air there is nothing to remember. Without that the slip would count as old: no force at all.
TEST(DemHistory, MeetsItsSlipOnEntry) {
  const double step = 1e-5, speed = 0.1, radius = bead_diameter / 2, rho = 1000, mu = 0.1;
  const int entering = static_cast<int>(std::lround(1.2 * bead_diameter / speed / step)),
            after = entering / 2;
  Scene scene("history_entry", empty_box(step) + bead({0.05, 0.05, 0.2}) + bead_properties() +
                                   "fix push all move linear 0 0 " + std::to_string(-speed) + " units box\n" +
                                   "group nobody subtract all all\nfix integrate nobody nve/sphere\n");
  ForceParameters parameters = with_history();
  parameters.added_mass = 0;
  parameters.drag = demvof::DragLaw::none;
  FluidForces forces(*scene.dem, parameters);
  scene.dem->set_up();
  FluidAtParticle liquid, gas;
  liquid.density = rho, liquid.viscosity = mu;
  gas.density = 1, gas.viscosity = 1e-5;
  const auto advance = [&](const demvof::SeenSurface& surface, int steps) {
    forces.begin_window(
        {{[&](int) { return liquid; }, [&](int) { return gas; }}, [&](int) { return surface; }},
        steps * step);
    scene.dem->run(steps);
    double impulse = forces.impulses().drag.z;
    MPI_Allreduce(MPI_IN_PLACE, &impulse, 1, MPI_DOUBLE, MPI_SUM, scene.dem->world());
    return impulse;
  };
  const double start = 1.05 * radius;  // of the centre above the surface
  advance({0, {0, 0, 1}, -start}, entering);
  const double impulse = advance({1, {}, 0}, after);

  const double factor = demvof::history_factor(bead_diameter, rho, mu) * speed;
  const double begin = entering * step, end = (entering + after) * step;
  double exact = 0;
  for (int n = 0; n < entering; ++n) {
    const auto share = [&](double t) { return demvof::share_below_plane((speed * t - start) / radius); };
    const double s = (n + 0.5) * step;
    exact +=
        factor * (share((n + 1) * step) - share(n * step)) * 2 * (std::sqrt(end - s) - std::sqrt(begin - s));
  }
  EXPECT_NEAR(impulse / exact, 1, 0.01);
}

}  // namespace
}  // namespace demvof_test
