// SPDX-License-Identifier: GPL-3.0-or-later
// Spinning particles of the real particle side in a fluid that a test makes up: torque and lift against exact
// solutions, and the book-keeping of angular impulses.

#include <cmath>

#include "coupler/closures/torque.hpp"
#include "dem_side/forces.hpp"
#include "tests/mock/dem_fixture.hpp"
#include "tests/support/mpi_main.hpp"

namespace demvof_test {
namespace {

using demvof::FluidAtParticle;
using demvof::FluidForces;
using demvof::ForceParameters;
using demvof::SpinImpulses;

constexpr double moment = 0.1 * bead_mass * bead_diameter * bead_diameter;

ForceParameters torque_alone() {
  ForceParameters parameters;
  parameters.drag = demvof::DragLaw::none;
  parameters.pressure_gradient = false;
  parameters.torque = true;
  return parameters;
}

std::string spin_of_all(const Vec3& spin) {
  return "set group all omegax " + std::to_string(spin.x) + " omegay " + std::to_string(spin.y) + " omegaz " +
         std::to_string(spin.z) + "\n";
}

// Without inertia: Stokes's torque to round-off, w' = (curl u / 2 - w)/tau.
FluidAtParticle syrup(double spin_time, const Vec3& vorticity) {
  FluidAtParticle fluid;
  fluid.density = 1e-30;
  fluid.viscosity = bead_density * bead_diameter * bead_diameter / (60 * spin_time);
  fluid.gradients.vorticity = vorticity;
  return fluid;
}

void window(demvof::Dem& dem, FluidForces& forces, const FluidAtParticle& fluid, int steps) {
  forces.begin_window(std::vector<FluidAtParticle>(dem.particles().count, fluid), steps * dem.time_step());
  dem.run(steps);
}

Vec3 over_ranks(Vec3 value, MPI_Comm world) {
  MPI_Allreduce(MPI_IN_PLACE, &value.x, 3, MPI_DOUBLE, MPI_SUM, world);
  return value;
}

// exp(-60 mu t/(rho_p d^2)) towards half of what the fluid's curl is, for steps of 1e-3 to 1e4 spin times.
TEST(DemSpin, FollowsTheExactDecayForAnyStiffness) {
  const double step = 1e-5;
  Vec3 spin{100, -20, 300};
  Scene scene("spin_decay",
              empty_box(step) + bead({0.05, 0.05, 0.2}) + bead_properties() + spin_of_all(spin) + integrate);
  FluidForces forces(*scene.dem, torque_alone());
  scene.dem->set_up();
  EXPECT_LT(norm(half_step_spin(*scene.dem) / moment - spin), 1e-9);
  for (const double steps_per_time : {1e3, 10.0, 1.0, 0.1, 1e-4}) {
    const Vec3 vorticity{20 * steps_per_time, 7, -40 / steps_per_time};
    window(*scene.dem, forces, syrup(steps_per_time * step, vorticity), 5);
    spin = 0.5 * vorticity + (spin - 0.5 * vorticity) * std::exp(-5 / steps_per_time);
    EXPECT_LT(norm(half_step_spin(*scene.dem) / moment - spin), 1e-12 * norm(vorticity) + 1e-10)
        << steps_per_time;
  }
  // A couple has no net force.
  const auto particles = scene.dem->particles();
  for (int i = 0; i < particles.count; ++i) EXPECT_EQ(norm(demvof::vec3(particles.velocity[i])), 0);
}

// The bead of the dam break in water at 200 rad/s: Dennis, Singh and Ingham's torque, against the midpoint
// rule with a much smaller step.
TEST(DemSpin, FollowsTheNonlinearDecay) {
  const double end = 0.05, step = 1e-4, fine = 1e-6;
  const auto rate = [](double w) {
    return -demvof::torque_factor(bead_diameter, 1000, 1e-3, std::abs(w)) * w / moment;
  };
  double exact = 200;
  for (int n = 0; n < std::lround(end / fine); ++n) exact += fine * rate(exact + 0.5 * fine * rate(exact));
  Scene scene("spin_nonlinear", empty_box(step) + bead({0.05, 0.05, 0.2}) + bead_properties() +
                                    spin_of_all({0, 200, 0}) + integrate);
  FluidForces forces(*scene.dem, torque_alone());
  scene.dem->set_up();
  FluidAtParticle water;
  water.density = 1000;
  water.viscosity = 1e-3;
  window(*scene.dem, forces, water, static_cast<int>(std::lround(end / step)));
  EXPECT_LT(exact, 130);  // Stokes's alone would leave 170
  EXPECT_NEAR(half_step_spin(*scene.dem).y / moment / exact, 1, 1e-3);
  double counts[2] = {forces.closures().at(0).second.evaluations, forces.closures().at(0).second.outside};
  MPI_Allreduce(MPI_IN_PLACE, counts, 2, MPI_DOUBLE, MPI_SUM, scene.dem->world());
  EXPECT_EQ(counts[0], 500);
  EXPECT_GT(counts[1], 10);   // Re_w = 1458 at the start
  EXPECT_LT(counts[1], 490);  // below 1000 at the end
}

// Beads that rub on one another and on a floor: the change of their spin is what contacts and fluid gave.
TEST(DemSpin, AccountsForEveryAngularImpulse) {
  std::string script = empty_box(1e-5);
  for (int i = 0; i < 5; ++i)
    script += bead({0.02 + 0.0135 * i, 0.05, 0.0014}) + bead({0.0201 + 0.0135 * i, 0.0501, 0.0045});
  script += bead_properties() + spin_of_all({30, 200, -10}) + gravity +
            "fix floor all wall/gran model hooke/stiffness tangential history primitive type 1 zplane 0.0\n" +
            integrate;
  Scene scene("spin_books", script);
  ForceParameters parameters = torque_alone();
  parameters.drag = demvof::DragLaw::schiller_naumann;
  FluidForces forces(*scene.dem, parameters);
  scene.dem->set_up();
  double rubbed = 0;
  for (int n = 0; n < 20; ++n) {
    FluidAtParticle fluid;
    fluid.density = 1000;
    fluid.viscosity = 0.1;
    fluid.velocity = {0.3 * std::sin(n), 0.1, 0};
    fluid.gradients.vorticity = {10.0 * n, -30, 5};
    const Vec3 before = half_step_spin(*scene.dem);
    window(*scene.dem, forces, fluid, 100);
    const SpinImpulses impulses = *forces.spin_impulses();
    const Vec3 given = over_ranks(impulses.fluid, scene.dem->world());
    const Vec3 rubs = over_ranks(impulses.contact, scene.dem->world());
    EXPECT_LT(norm(half_step_spin(*scene.dem) - before - given - rubs), 1e-12 * (norm(given) + norm(rubs)))
        << n;
    EXPECT_GT(norm(given), 0);
    rubbed = std::max(rubbed, norm(rubs) / norm(given));
  }
  EXPECT_GT(rubbed, 0.1);
}

// Frozen particles, and those whose spin nothing integrates, get no torque.
TEST(DemSpin, LeavesAloneWhatDoesNotTurn) {
  for (const std::string held :
       {"fix hold all freeze\nfix integrate all nve/sphere\n", "fix integrate all nve\n"}) {
    Scene scene("spin_held", empty_box(1e-5) + bead({0.05, 0.05, 0.2}) + bead_properties() +
                                 spin_of_all({0, 0, 50}) + held);
    FluidForces forces(*scene.dem, torque_alone());
    scene.dem->set_up();
    window(*scene.dem, forces, syrup(1e-4, {10, 0, 0}), 10);
    const auto particles = scene.dem->particles();
    for (int i = 0; i < particles.count; ++i) {
      EXPECT_EQ(particles.spin[i][2], 50) << held;
      EXPECT_EQ(particles.spin[i][0], 0) << held;
      EXPECT_EQ(particles.torque[i][0], 0) << held;
    }
    EXPECT_EQ(norm(forces.spin_impulses()->fluid), 0);
  }
}

// A bead rolls on a floor without slipping against LIGGGHTS's rolling friction (model cdt) mu_r and the
// fluid's torque: v' = -(5/7) mu_r g - v/T, T = 1.4 m R^2/beta_r. It comes to rest after the distance
// T v_0 - b T^2 ln(1 + v_0/(b T)), b = (5/7) mu_r g; v_0^2/(2 b) without fluid.
TEST(DemSpin, ComesToRestWhereRollingFrictionSays) {
  const double speed = 0.1, rolling = 0.05, radius = bead_diameter / 2, step = 5e-6;
  const double b = 5.0 / 7 * rolling * 9.81;
  for (const double spin_time : {1e9, 0.05}) {
    std::string script = empty_box(step);
    script.replace(script.find("pair_style gran model hooke/stiffness tangential history"),
                   std::string("pair_style gran model hooke/stiffness tangential history").size(),
                   "fix m6 all property/global coefficientRollingFriction peratomtypepair 1 " +
                       std::to_string(rolling) +
                       "\npair_style gran model hooke/stiffness tangential history rolling_friction cdt");
    Scene scene("rolling", script + bead({0.02, 0.05, 0.00135}) + bead_properties() + "set group all vx " +
                               std::to_string(speed) + "\n" + spin_of_all({0, speed / radius, 0}) + gravity +
                               "fix floor all wall/gran model hooke/stiffness tangential history "
                               "rolling_friction cdt primitive type 1 zplane 0.0\n" +
                               integrate);
    FluidForces forces(*scene.dem, torque_alone());
    scene.dem->set_up();
    const double T = 1.4 * bead_mass * radius * radius / (moment / spin_time);
    const double exact =
        spin_time > 1 ? speed * speed / (2 * b) : T * speed - b * T * T * std::log(1 + speed / (b * T));
    for (int n = 0; n < 4; ++n) window(*scene.dem, forces, syrup(spin_time, {}), 20000);  // 0.4 s
    const auto particles = scene.dem->particles();
    Vec3 end = over_ranks(particles.count ? demvof::vec3(particles.position[0]) : Vec3{}, scene.dem->world());
    EXPECT_NEAR((end.x - 0.02) / exact, 1, 0.01) << spin_time;
    const Vec3 left =
        over_ranks(particles.count ? demvof::vec3(particles.velocity[0]) : Vec3{}, scene.dem->world());
    EXPECT_LT(norm(left), 0.01 * speed);
  }
}

// The lift acts in the loop with the particle's own spin, and its reaction is exchanged.
TEST(DemSpin, LiftsAndHandsTheReactionBack) {
  const double step = 1e-5;
  Scene scene("spin_lift", empty_box(step) + bead({0.05, 0.05, 0.2}) + bead_properties() +
                               spin_of_all({0, 0, 40}) + integrate);
  ForceParameters parameters;
  parameters.drag = demvof::DragLaw::none;
  parameters.pressure_gradient = false;
  parameters.spin_lift = demvof::SpinLiftLaw::rubinow_keller;
  FluidForces forces(*scene.dem, parameters);
  scene.dem->set_up();
  FluidAtParticle fluid;
  fluid.velocity = {1e-2, 0, 0};
  fluid.density = 1000;
  fluid.viscosity = 1e-3;
  fluid.gradients.vorticity = {0, 0, 20};
  window(*scene.dem, forces, fluid, 1);
  // Turns by 40 - 10 against the fluid, moves with -0.01 against it: w x v = -0.3 along y.
  const double lift = -pi / 8 * 1000 * bead_diameter * bead_diameter * bead_diameter * 30 * 1e-2;
  Vec3 given, reaction;
  for (const auto& row : all_of(forces.contributions(), *scene.dem)) {
    given += row.drag_impulse;
    reaction += row.drag_weighted_velocity;
  }
  given = over_ranks(given, scene.dem->world());
  reaction = over_ranks(reaction, scene.dem->world());
  EXPECT_NEAR(given.y / (step * lift), 1, 1e-9);
  EXPECT_NEAR(reaction.y / -lift, 1, 1e-9);
  EXPECT_NEAR(over_ranks(forces.impulses().drag, scene.dem->world()).y / (step * lift), 1, 1e-9);
  double counts[2] = {forces.closures().at(0).second.evaluations, forces.closures().at(0).second.outside};
  MPI_Allreduce(MPI_IN_PLACE, counts, 2, MPI_DOUBLE, MPI_SUM, scene.dem->world());
  EXPECT_EQ(counts[0], 1);
  EXPECT_EQ(counts[1], 1);  // Re = 27
}

}  // namespace
}  // namespace demvof_test
