// SPDX-License-Identifier: GPL-3.0-or-later
// The real particle side in a fluid that a test makes up: drag, pressure gradient and left-over
// impulse against exact solutions, and the book-keeping of impulses.

#include <algorithm>
#include <cmath>

#include "coupler/closures/drag.hpp"
#include "dem_side/forces.hpp"
#include "tests/mock/dem_fixture.hpp"
#include "tests/support/mpi_main.hpp"

namespace demvof_test {
namespace {

using demvof::CarriedRow;
using demvof::FluidAtParticle;
using demvof::FluidForces;
using demvof::ForceParameters;
using demvof::WindowImpulses;

FluidAtParticle still_water() {
  return {{}, {0, 0, -1000 * 9.81}, 1000, 1e-3, {}};
}

// Inertia so small that drag is Stokes drag to round-off: v' = (u - v)/tau.
FluidAtParticle syrup(double relaxation_time, const Vec3& velocity) {
  const double viscosity = bead_mass / (3 * pi * bead_diameter * relaxation_time);
  return {velocity, {}, 1e-30, viscosity, {}};
}

// One window of the same fluid everywhere.
void window(demvof::Dem& dem, FluidForces& forces, const FluidAtParticle& fluid, int steps) {
  forces.begin_window(std::vector<FluidAtParticle>(dem.particles().count, fluid), steps * dem.time_step());
  dem.run(steps);
}

Vec3 half_step_momentum(const demvof::Dem& dem) {
  const auto particles = dem.particles();
  Vec3 momentum;
  for (int i = 0; i < particles.count; ++i)
    if (dem.integrates(i))
      momentum += particles.mass[i] * demvof::vec3(particles.velocity[i]) +
                  0.5 * dem.time_step() * demvof::vec3(particles.force[i]);
  MPI_Allreduce(MPI_IN_PLACE, &momentum.x, 3, MPI_DOUBLE, MPI_SUM, dem.world());
  return momentum;
}

WindowImpulses over_ranks(WindowImpulses impulses, MPI_Comm world) {
  MPI_Allreduce(MPI_IN_PLACE, &impulses.drag.x, sizeof(impulses) / sizeof(double), MPI_DOUBLE, MPI_SUM,
                world);
  return impulses;
}

// Vertical velocity of the only particle, on all ranks.
double falling_speed(const demvof::Dem& dem) {
  const auto particles = dem.particles();
  double velocity = particles.count ? particles.velocity[0][2] : 0;
  MPI_Allreduce(MPI_IN_PLACE, &velocity, 1, MPI_DOUBLE, MPI_SUM, dem.world());
  return velocity;
}

TEST(DemForces, FollowTheExactLinearRelaxationForAnyStiffness) {
  const double step = 1e-5;
  Scene scene("relaxation", empty_box(step) + bead({0.05, 0.05, 0.2}) + bead_properties() + integrate);
  FluidForces forces(*scene.dem, ForceParameters{});
  scene.dem->set_up();
  Vec3 velocity;
  for (const double steps_per_relaxation : {1e3, 10.0, 1.0, 0.1, 1e-3}) {
    const Vec3 wind{0.2 * steps_per_relaxation, 1 / steps_per_relaxation, -0.1};
    const double relaxation = steps_per_relaxation * step;
    window(*scene.dem, forces, syrup(relaxation, wind), 5);
    velocity = wind + (velocity - wind) * std::exp(-5 * step / relaxation);
    EXPECT_LT(norm(half_step_momentum(*scene.dem) / bead_mass - velocity), 1e-12 * norm(wind))
        << steps_per_relaxation;
  }
}

// With a constant force F beside the drag the particle goes to u + F/beta and never beyond, however
// stiff the drag is.
TEST(DemForces, NeverOvershootTheEquilibriumOfDragAndGravity) {
  const double step = 1e-5;
  Scene scene("equilibrium",
              empty_box(step) + bead({0.05, 0.05, 0.2}) + bead_properties() + gravity + integrate);
  FluidForces forces(*scene.dem, ForceParameters{});
  scene.dem->set_up();
  double velocity = half_step_momentum(*scene.dem).z / bead_mass;
  for (const double relaxation : {1e-3, 1e-8, 1e-5}) {
    const double terminal = -9.81 * relaxation;
    for (int n = 0; n < 40; ++n) {
      window(*scene.dem, forces, syrup(relaxation, {}), 25);
      const double next = half_step_momentum(*scene.dem).z / bead_mass;
      const double round_off = 1e-12 * std::abs(terminal);
      EXPECT_GE(next, std::min(velocity, terminal) - round_off);
      EXPECT_LE(next, std::max(velocity, terminal) + round_off);
      velocity = next;
    }
    EXPECT_NEAR(velocity / terminal, 1, 1e-3);
  }
}

// The bead of the dam break sinks in still water, pressure gradient included, at 0.3430 m/s.
TEST(DemForces, ReachTheTerminalVelocityInStillWater) {
  Scene scene("terminal",
              empty_box(1e-4) + bead({0.05, 0.05, 0.35}) + bead_properties() + gravity + integrate);
  FluidForces forces(*scene.dem, ForceParameters{});
  scene.dem->set_up();
  for (int n = 0; n < 50; ++n) window(*scene.dem, forces, still_water(), 100);  // 0.5 s
  EXPECT_NEAR(falling_speed(*scene.dem), -0.3430, 0.3430e-3);
}

// On the way there: against an integration of v' by the midpoint rule with a much smaller step. What is
// left is the lag of beta by one DEM step (tests/unit/implicit_drag.cpp holds its order).
TEST(DemForces, FollowTheNonlinearEquationOfMotion) {
  const double end = 0.02, step = 2e-5, fine = 1e-7;
  const auto acceleration = [](double v) {
    const double beta = demvof::schiller_naumann(bead_diameter, 1000, 1e-3, std::abs(v));
    return -9.81 * (1 - 1000 / bead_density) - beta * v / bead_mass;
  };
  double exact = 0;
  for (int n = 0; n < std::lround(end / fine); ++n)
    exact += fine * acceleration(exact + 0.5 * fine * acceleration(exact));

  Scene scene("nonlinear",
              empty_box(step) + bead({0.05, 0.05, 0.35}) + bead_properties() + gravity + integrate);
  FluidForces forces(*scene.dem, ForceParameters{});
  scene.dem->set_up();
  window(*scene.dem, forces, still_water(), static_cast<int>(std::lround(end / step)));
  EXPECT_NEAR(falling_speed(*scene.dem) / exact, 1, 1e-3);
}

// Beads that fall on one another and on a wall, in moving water, with left-over impulses: what LIGGGHTS
// did to the momentum is what the book-keeping says, window by window, and a cell's drag is the sum of
// what its particles received.
void expect_account(const ForceParameters& parameters) {
  std::string script = empty_box(1e-5);
  for (int i = 0; i < 5; ++i)
    script += bead({0.02 + 0.0135 * i, 0.05, 0.0014}) + bead({0.0201 + 0.0135 * i, 0.0501, 0.0048});
  script += bead_properties() + gravity +
            "fix floor all wall/gran model hooke/stiffness tangential history primitive type 1 zplane 0.0\n" +
            integrate;
  Scene scene("impulses", script);
  FluidForces forces(*scene.dem, parameters);
  scene.dem->set_up();
  bool touched = false;
  for (int n = 0; n < 20; ++n) {
    FluidAtParticle fluid = still_water();
    fluid.velocity = {0.3 * std::sin(n), 0.1, 0.2 * std::cos(3 * n)};
    fluid.left_over_rate = {1e-4, -1e-5 * n, 5e-5};
    fluid.gradients = {{10, -20, 5.0 * n}, {1, 0.5 * n, -2}, {3, 30, -5}};
    const Vec3 before = half_step_momentum(*scene.dem);
    window(*scene.dem, forces, fluid, 100);
    const Vec3 change = half_step_momentum(*scene.dem) - before;
    const WindowImpulses impulses = over_ranks(forces.impulses(), scene.dem->world());
    const Vec3 booked = impulses.drag + impulses.pressure + impulses.left_over + impulses.stress +
                        impulses.constant + impulses.contact + impulses.gravity;
    EXPECT_LT(norm(change - booked), 1e-12 * norm(impulses.gravity)) << n;
    touched = touched || norm(impulses.contact) > 1e-3 * norm(impulses.gravity);
    Vec3 received;
    for (const auto& particle : all_of(forces.contributions(), *scene.dem)) received += particle.drag_impulse;
    MPI_Allreduce(MPI_IN_PLACE, &received.x, 3, MPI_DOUBLE, MPI_SUM, scene.dem->world());
    EXPECT_LT(norm(received - impulses.drag), 1e-12 * norm(impulses.drag)) << n;
  }
  EXPECT_TRUE(touched);
}

TEST(DemForces, AccountForEveryImpulse) {
  ForceParameters parameters;
  parameters.viscous_stress = parameters.capillary = true;
  parameters.added_mass = 0.5;
  parameters.lift = demvof::LiftLaw::saffman_mei;
  parameters.constant = {1e-5, 0, -2e-5};
  expect_account(parameters);
}

TEST(DemForces, AccountForEveryImpulseOfLoneParticles) {
  ForceParameters parameters;
  parameters.constant = {1e-5, 0, -2e-5};
  expect_account(parameters);
}

// A law that knows the void fraction gets the sampled one; what lies outside its range is counted.
TEST(DemForces, UseTheVoidFractionInTheDragLaw) {
  Scene scene("void_fraction", empty_box(1e-5) + bead({0.05, 0.05, 0.2}) + bead_properties() + integrate);
  ForceParameters parameters;
  parameters.drag = demvof::DragLaw::gidaspow;
  FluidForces forces(*scene.dem, parameters);
  scene.dem->set_up();
  FluidAtParticle fluid = syrup(1e-3, {0.1, 0, 0});
  for (const double eps : {0.5, 0.2}) {
    fluid.void_fraction = eps;
    window(*scene.dem, forces, fluid, 10);
    const double expected = bead_mass / 1e-3 * 150 * (1 - eps) / (18 * eps);  // Ergun's bed for Re -> 0
    for (const auto& row : all_of(forces.contributions(), *scene.dem))
      EXPECT_NEAR(row.drag_factor / expected, 1, 1e-12);
    const auto closures = forces.closures();
    ASSERT_EQ(closures.size(), 1u);
    EXPECT_EQ(closures[0].first, "gidaspow");
    double counts[2] = {closures[0].second.evaluations, closures[0].second.outside};
    MPI_Allreduce(MPI_IN_PLACE, counts, 2, MPI_DOUBLE, MPI_SUM, scene.dem->world());
    EXPECT_EQ(counts[0], 10);
    EXPECT_EQ(counts[1], eps < 0.36 ? 10 : 0);
  }
}

// A light sphere let go in still water: buoyancy works on its own mass and on half its volume of water. The
// first half step is LIGGGHTS's own, without fluid.
TEST(DemForces, StartALightSphereWithItsAddedMass) {
  const double step = 1e-6, density = 25;
  Scene scene("light", empty_box(step) + bead({0.05, 0.05, 0.2}) + "set group all diameter " +
                           std::to_string(bead_diameter) + " density " + std::to_string(density) + "\n" +
                           gravity + integrate);
  ForceParameters parameters;
  parameters.drag = demvof::DragLaw::none;
  parameters.added_mass = 0.5;
  FluidForces forces(*scene.dem, parameters);
  scene.dem->set_up();
  const double mass = density * bead_volume;
  const Vec3 before = half_step_momentum(*scene.dem);
  window(*scene.dem, forces, still_water(), 100);
  const double acceleration = (half_step_momentum(*scene.dem) - before).z / mass / (100 * step);
  EXPECT_NEAR(acceleration / (9.81 * (1000 - density) / (density + 0.5 * 1000)), 1, 1e-12);

  // Of what buoyancy and weight gave, the fluid gets back what its added mass took.
  const WindowImpulses impulses = over_ranks(forces.impulses(), scene.dem->world());
  EXPECT_NEAR(impulses.drag.z / (-0.5 * 1000 * bead_volume * acceleration * 100 * step), 1, 1e-12);
  for (const auto& row : all_of(forces.contributions(), *scene.dem)) {
    EXPECT_EQ(row.drag_factor, 0);
    EXPECT_NEAR(row.drag_weighted_velocity.z / (-impulses.drag.z / (100 * step)), 1, 1e-12);
  }
}

// In a fluid that accelerates a neutrally buoyant sphere goes with it: pressure gradient and added mass
// together are (1 + C_m) rho V Du/Dt on the mass (1 + C_m) rho V.
TEST(DemForces, CarryANeutralSphereWithAnAcceleratingFluid) {
  const double step = 1e-5;
  Scene scene("neutral", empty_box(step) + bead({0.05, 0.05, 0.2}) + bead_properties() + integrate);
  ForceParameters parameters;
  parameters.drag = demvof::DragLaw::none;
  parameters.added_mass = 0.5;
  FluidForces forces(*scene.dem, parameters);
  scene.dem->set_up();
  const Vec3 acceleration{3, -1, 0.5};
  FluidAtParticle fluid{{}, -bead_density * acceleration, bead_density, 1e-30, {}};
  fluid.gradients.acceleration = acceleration;
  for (int n = 0; n < 5; ++n) window(*scene.dem, forces, fluid, 10);
  const Vec3 velocity = half_step_momentum(*scene.dem) / bead_mass;
  EXPECT_LT(norm(velocity - 50 * step * acceleration), 1e-12 * norm(velocity));
}

// Stress and constant force act as given; the stress is not the exchange's, lift is.
TEST(DemForces, AddStressConstantForceAndLift) {
  const double step = 1e-5;
  Scene scene("others", empty_box(step) + bead({0.05, 0.05, 0.2}) + bead_properties() + integrate);
  ForceParameters parameters;
  parameters.drag = demvof::DragLaw::none;
  parameters.viscous_stress = true;
  parameters.constant = {0, 0, 3e-5};
  parameters.lift = demvof::LiftLaw::saffman_mei;
  FluidForces forces(*scene.dem, parameters);
  scene.dem->set_up();
  const Vec3 before = half_step_momentum(*scene.dem);
  EXPECT_NEAR(before.z / (0.5 * step * 3e-5), 1, 1e-12);  // acts from the first half step on
  FluidAtParticle fluid{{1e-2, 0, 0}, {}, 1000, 1e-3, {}};
  fluid.gradients = {{0, 100, 0}, {}, {0, 0, -2}};
  window(*scene.dem, forces, fluid, 1);
  const Vec3 force = (half_step_momentum(*scene.dem) - before) / step;
  // To 1e-6: the constant force has moved the bead a little before its lift is found.
  const double Re = 1000 * 1e-2 * bead_diameter / 1e-3, shear = bead_diameter * 2 / (2 * 1e-2);
  const double mei = (1 - 0.3314 * std::sqrt(shear)) * std::exp(-Re / 10) + 0.3314 * std::sqrt(shear);
  const double lift = 1.615 * bead_diameter * bead_diameter * std::sqrt(1000 * 1e-3 / 2) * mei * 1e-2 * 2;
  EXPECT_NEAR(force.x, 0, 1e-20);
  EXPECT_NEAR(force.y / (bead_volume * 100 + lift), 1, 1e-6);
  EXPECT_NEAR(force.z / 3e-5, 1, 1e-9);
  const WindowImpulses impulses = over_ranks(forces.impulses(), scene.dem->world());
  EXPECT_NEAR(impulses.drag.y / (step * lift), 1, 1e-6);
  EXPECT_NEAR(impulses.stress.y / (step * bead_volume * 100), 1, 1e-12);
  double counts[2] = {forces.closures().at(0).second.evaluations, forces.closures().at(0).second.outside};
  MPI_Allreduce(MPI_IN_PLACE, counts, 2, MPI_DOUBLE, MPI_SUM, scene.dem->world());
  EXPECT_EQ(counts[0], 1);
  EXPECT_EQ(counts[1], 0);
}

// The impulse of the last window that is still owed arrives in full: rate times beta of that window.
TEST(DemForces, HandOverTheLeftOverImpulse) {
  Scene scene("left_over", empty_box(1e-5) + bead({0.05, 0.05, 0.2}) + bead_properties() + integrate);
  FluidForces forces(*scene.dem, ForceParameters{});
  scene.dem->set_up();
  FluidAtParticle fluid = syrup(1e-3, {0.1, 0, 0});
  window(*scene.dem, forces, fluid, 20);
  fluid.left_over_rate = {0, 3e-5, 0};
  window(*scene.dem, forces, fluid, 20);
  EXPECT_NEAR(over_ranks(forces.impulses(), scene.dem->world()).left_over.y / (3e-5 * bead_mass / 1e-3), 1,
              1e-12);
}

// A frozen particle takes drag without moving, and answers to the fluid with all of beta; a free one
// follows it. A particle on the floor counts as held for the steps in which it touches.
TEST(DemForces, TellFrozenRestingAndFreeParticlesApart) {
  Scene scene(
      "roles",
      empty_box(1e-5) + bead({0.02, 0.05, 0.2}) + bead({0.05, 0.05, 0.00135}) + bead({0.08, 0.05, 0.2}) +
          bead_properties() + gravity +
          "fix floor all wall/gran model hooke/stiffness tangential history primitive type 1 zplane 0.0\n"
          "region left block 0 0.03 0 0.1 0 0.4 units box\ngroup left region left\n"
          "fix hold left freeze\n" +
          integrate + "run 500\n");
  FluidForces forces(*scene.dem, ForceParameters{});
  scene.dem->set_up();
  const double relaxation = 1e-4;
  window(*scene.dem, forces, syrup(relaxation, {0, 0, 1e-4}), 20);
  const double beta = bead_mass / relaxation;
  const auto particles = scene.dem->particles();
  const auto rows = all_of(forces.contributions(), *scene.dem);
  const auto support = all_of(forces.support(), *scene.dem);
  for (int i = 0; i < particles.count; ++i) {
    const double x = particles.position[i][0];
    EXPECT_NEAR(rows[i].drag_factor / beta, 1, 1e-12);
    const double free_response = (1 - std::exp(-2.0)) / 2;  // window = 2 relaxation times
    EXPECT_NEAR(support[i].free_response / beta, x < 0.03 ? 1 : free_response, 1e-9) << x;
    const bool rests = x > 0.03 && x < 0.06;
    EXPECT_EQ(support_by_contacts(support[i]), rests ? 1 : 0) << x;
    if (rests) {  // nearly: it is still coming to rest
      EXPECT_NEAR(norm(support[i].contact + support[i].drag + support[i].others), 0,
                  0.2 * norm(support[i].contact));
    }
    EXPECT_NEAR(rows[i].drag_response / beta, x < 0.06 ? 1 : free_response, 1e-9) << x;
    if (x < 0.03) {
      EXPECT_EQ(particles.position[i][2], 0.2);
      EXPECT_EQ(particles.velocity[i][2], 0);
      EXPECT_NEAR(rows[i].drag_impulse.z / (beta * 1e-4 * 2e-4), 1, 1e-12);
    }
  }
}

// In Newton's range a change of the fluid's velocity changes the drag twice as much as the drag factor says.
TEST(DemForces, AnswerWithTheSlopeOfTheDrag) {
  Scene scene("slope", empty_box(1e-5) + bead({0.02, 0.05, 0.2}) + bead({0.08, 0.05, 0.2}) +
                           bead_properties() +
                           "region left block 0 0.03 0 0.1 0 0.4 units box\ngroup left region left\n"
                           "fix hold left freeze\n" +
                           integrate);
  FluidForces forces(*scene.dem, ForceParameters{});
  scene.dem->set_up();
  FluidAtParticle stream;
  stream.velocity = {1, 0, 0};  // Re = 2700
  stream.density = 1000;
  stream.viscosity = 1e-3;
  const int steps = 5;
  forces.begin_window(std::vector<FluidAtParticle>(scene.dem->particles().count, stream), steps * 1e-5);
  scene.dem->run(steps);
  const auto rows = all_of(forces.contributions(), *scene.dem);
  const auto particles = scene.dem->particles();
  for (int i = 0; i < particles.count; ++i) {
    const double x = 2 * rows[i].drag_factor * steps * 1e-5 / bead_mass;
    const double free = (1 - std::exp(-x)) / x;
    EXPECT_NEAR(rows[i].drag_response / rows[i].drag_factor, particles.position[i][0] < 0.03 ? 2 : 2 * free,
                1e-9);
    EXPECT_NEAR(rows[i].response_weighted_velocity.x, rows[i].drag_response, 1e-12 * rows[i].drag_response);
    EXPECT_NEAR(forces.support()(i).free_response, rows[i].drag_response, 1e-12 * rows[i].drag_response);
  }
}

// A particle that comes into being during a window waits for the next one without any fluid force.
TEST(DemForces, LetInsertedParticlesWaitForTheNextWindow) {
  Scene scene(
      "insertion",
      empty_box(1e-5) + bead({0.05, 0.05, 0.3}) + bead_properties() + integrate +
          "fix pts all particletemplate/sphere 15485863 atom_type 1 density constant 2500 radius constant "
          "0.00135\n"
          "fix pdd all particledistribution/discrete 32452843 1 pts 1.0\n"
          "region low block 0.01 0.09 0.01 0.09 0.01 0.1 units box\n"
          "fix ins all insert/rate/region seed 49979687 distributiontemplate pdd nparticles 6 particlerate "
          "30000 "
          "start 5 insert_every 10 overlapcheck yes all_in yes region low\n");
  FluidForces forces(*scene.dem, ForceParameters{});
  scene.dem->set_up();
  const auto waiting = [&] {
    long count = forces.waiting_for_fluid();
    MPI_Allreduce(MPI_IN_PLACE, &count, 1, MPI_LONG, MPI_SUM, scene.dem->world());
    return count;
  };
  const long at_start = scene.dem->census().count;
  EXPECT_TRUE(scene.dem->inserts_particles());
  window(*scene.dem, forces, syrup(1e-3, {1, 0, 0}), 10);
  const long inserted = scene.dem->census().count - at_start;
  EXPECT_GT(inserted, 0);
  EXPECT_EQ(scene.dem->inserted(), inserted);
  EXPECT_EQ(waiting(), inserted);
  const auto particles = scene.dem->particles();
  for (int i = 0; i < particles.count; ++i)
    if (forces.carried(i).waits()) {
      EXPECT_EQ(particles.velocity[i][0], 0);
    }
  window(*scene.dem, forces, syrup(1e-3, {1, 0, 0}), 1);
  EXPECT_EQ(waiting(), scene.dem->census().count - at_start - inserted);
}

}  // namespace
}  // namespace demvof_test
