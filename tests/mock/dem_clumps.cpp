// SPDX-License-Identifier: GPL-3.0-or-later
// Clumps of LIGGGHTS's fix multisphere in a fluid that a test makes up: two spheres that touch, against exact
// motions of the whole, and the book-keeping of impulses.

#include <cmath>

#include "coupler/base/errors.hpp"
#include "dem_side/forces.hpp"
#include "dem_side/report.hpp"
#include "tests/mock/dem_fixture.hpp"
#include "tests/support/mpi_main.hpp"

namespace demvof_test {
namespace {

using demvof::FluidAtParticle;
using demvof::FluidForces;
using demvof::ForceParameters;
using demvof::half_step_momentum;
using demvof::WindowImpulses;

constexpr double volume = 2 * bead_volume, mass = 2 * bead_mass;
const double diameter = bead_diameter * std::cbrt(2.0);  // of the sphere of that volume

/// Clumps of one template somewhere between the heights, m, at rest over a floor.
std::string clumps(double step, const std::string& spheres, double lowest, double highest, int count,
                   const std::string& more, const std::string& motion = "vel constant 0 0 0") {
  std::string box = empty_box(step);
  box.insert(box.find("map array") + 9, " sort 0 0");
  return box +
         "fix floor all wall/gran model hooke/stiffness tangential history primitive type 1 zplane 0.0\n"
         "fix shape all particletemplate/multisphere 15485863 atom_type 1 density constant 2500 " +
         spheres +
         "\nfix one all particledistribution/discrete 15485867 1 shape 1.0\n"
         "region room block 0.02 0.08 0.02 0.08 " +
         std::to_string(lowest) + " " + std::to_string(highest) +
         " units box\n"
         "fix put all insert/pack seed 32452843 distributiontemplate one " +
         motion +
         " insert_every once "
         "overlapcheck yes region room particles_in_region " +
         std::to_string(count) + "\nfix move all multisphere\nrun 1\nunfix put\n" + more;
}

/// Its mass and moments are given, not found by chance.
std::string doublet(double step, double lowest, double highest, const std::string& more = gravity,
                    const std::string& kept = "") {
  const double a = bead_diameter / 2, m = bead_mass;
  const std::string r = std::to_string(1000 * a) + "e-3",
                    along = std::to_string(1e9 * 0.8 * m * a * a) + "e-9",
                    across = std::to_string(1e9 * 2.8 * m * a * a) + "e-9";
  return clumps(step,
                "nspheres 2 ntry 100000 spheres -" + r + " 0 0 " + r + " " + r + " 0 0 " + r +
                    " type 1 mass " + std::to_string(1e6 * mass) + "e-6 inertia_tensor " + along + " 0 0 " +
                    across + " 0 " + across + " use_density" + kept,
                lowest, highest, 1, more);
}

/// Three in a row, whose centre LIGGGHTS finds by chance.
std::string row(double lowest, double highest, const std::string& more) {
  return clumps(1e-5, "nspheres 3 ntry 100000 spheres -2e-3 0 0 1e-3 0 0 0 1e-3 2e-3 0 0 1e-3 type 1", lowest,
                highest, 1, more);
}

/// A row of overlapping spheres, large to small, on its side.
std::string uneven(double lowest, double highest, int count, const std::string& kept = "") {
  return clumps(1e-5,
                "nspheres 4 ntry 1000000 spheres 0 0 0 2e-3 1e-3 0.5e-3 0 1.8e-3 2e-3 0 0.7e-3 1.2e-3 "
                "4e-3 0 0 0.6e-3 type 1" +
                    kept,
                lowest, highest, count, gravity);
}

void window(demvof::Dem& dem, FluidForces& forces, const FluidAtParticle& fluid, int steps) {
  forces.begin_window(std::vector<FluidAtParticle>(dem.particles().count, fluid), steps * dem.time_step());
  dem.run(steps);
}

FluidAtParticle water(double density = 1000) {
  return {{}, {0, 0, -density * 9.81}, density, 1e-3, {}};
}

TEST(DemClumps, DisplaceTheirVolumeOnce) {
  Scene scene("clump_volume", doublet(1e-5, 0.2, 0.22));
  FluidForces forces(*scene.dem, ForceParameters{});
  scene.dem->set_up();
  window(*scene.dem, forces, water(), 1);
  double sum = 0;
  for (int i = 0; i < 2; ++i) sum += forces.contributions()(i).solid_volume;
  EXPECT_NEAR(sum / volume, 1, 1e-5);
  EXPECT_NEAR(scene.dem->census().solid_volume / volume, 1, 1e-5);
  EXPECT_EQ(scene.dem->census().whole, 1);
}

// What its fluid does to it has no moment.
TEST(DemClumps, AreNotTurnedByBuoyancy) {
  Scene scene("clump_uneven", uneven(0.1, 0.3, 3));
  FluidForces forces(*scene.dem, ForceParameters{});
  scene.dem->set_up();
  const Vec3 start = half_step_momentum(*scene.dem);
  for (int n = 0; n < 10; ++n) window(*scene.dem, forces, {{}, {0, 0, -2500 * 9.81}, 1e-30, 1e-30, {}}, 100);
  const auto particles = scene.dem->particles();
  ASSERT_EQ(particles.count, 12);
  for (int n = 0; n < 3; ++n)
    EXPECT_LT(norm(particles.off_centre[n]), 1e-5) << n;  // m; by chance across them
  for (int i = 0; i < particles.count; ++i) {
    EXPECT_GT(particles.of_clump[i].share, 0);
    EXPECT_LT(norm(demvof::vec3(particles.spin[i])), 1e-6);  // 1 rad/s when shares are the spheres' volumes
  }
  EXPECT_LT(norm(half_step_momentum(*scene.dem) - start), 1e-12 * mass);
}

// What its centre is off the row by has no moment either: the row would begin to turn about itself, and there
// is nothing to end that.
TEST(DemClumps, RowsAreNotTurnedAboutThemselves) {
  Scene scene("clump_row", row(0.2, 0.22, gravity));
  FluidForces forces(*scene.dem, ForceParameters{});
  scene.dem->set_up();
  EXPECT_GT(norm(scene.dem->particles().off_centre[0]), 1e-8);
  for (int n = 0; n < 10; ++n) window(*scene.dem, forces, water(), 100);
  EXPECT_LT(norm(demvof::vec3(scene.dem->particles().spin[0])), 1e-10);
}

// A liquid that turns as a rigid body takes a clump along at the rate of the drag on its spheres,
// I dw/dt = sum of beta_i r_i^2 (W - w), to round-off and in liquids of 1e-6 to 1e4 m2/s: the spin between
// the steps is exact, however stiff.
TEST(DemClumps, TurnWithTheLiquidAtTheRateOfTheirDrag) {
  const double step = 1e-5;
  Scene scene("clump_turns", doublet(step, 0.2, 0.22, ""));
  FluidForces forces(*scene.dem, ForceParameters{});
  scene.dem->set_up();
  double turning = 1e-3, expected = 0;  // rad/s, of the liquid and of the clump at half steps
  for (double viscosity = 1e-3; viscosity < 2e7; viscosity *= 10, turning = -turning) {  // Pa s
    const auto start = scene.dem->particles();
    const double beta = 3 * pi * viscosity * start.of_clump[0].diameter;
    std::vector<FluidAtParticle> fluid;
    double resistance = 0;
    for (int i = 0; i < 2; ++i) {
      const demvof::SphereOfClump& sphere = start.of_clump[i];
      fluid.push_back({{0, turning * sphere.arm.x, 0}, {}, 1e-30, viscosity, {}});
      resistance += sphere.share * beta * sphere.arm.x * sphere.arm.x;
    }
    const double across = std::max(start.clumps[0].inertia[0], start.clumps[0].inertia[2]);
    double before = 0;
    forces.begin_window(fluid, 20 * step);
    scene.dem->run(20);
    for (int n = 0; n < 20; ++n) {
      before = expected;
      expected = turning + (expected - turning) * std::exp(-resistance / across * step);
    }
    EXPECT_NEAR(scene.dem->particles().spin[0][2] / turning, (before + expected) / 2 / turning, 1e-7)
        << viscosity;
  }
}

// Drag takes energy, gives none: one that hangs on its sphere in the syrup, the other in nothing, is never
// faster than from that height, in liquids of 1e-6 to 1e4 m2/s.
TEST(DemClumps, AreNotThrownByThickLiquids) {
  Scene scene("clump_hangs", doublet(1e-5, 0.3, 0.32));
  FluidForces forces(*scene.dem, ForceParameters{});
  scene.dem->set_up();
  const auto height = [&] {
    const auto particles = scene.dem->particles();
    return (particles.position[0][2] + particles.position[1][2]) / 2;
  };
  const double start = height();
  for (double viscosity = 1e-3; viscosity < 2e7; viscosity *= 10) {
    forces.begin_window(
        std::vector<FluidAtParticle>{{{}, {}, 1e-30, viscosity, {}}, {{}, {}, 1e-30, 1e-30, {}}}, 1e-3);
    scene.dem->run(100);
    const auto particles = scene.dem->particles();
    const demvof::RigidBody& clump = particles.clumps[0];
    const Vec3 velocity = particles.of_clump[0].velocity;
    const double energy =
        0.5 * clump.mass * dot(velocity, velocity) + 0.5 * dot(clump.spin(), clump.angular_momentum);
    EXPECT_LT(energy, clump.mass * 9.81 * (start - height()) * (1 + 1e-3)) << viscosity;
  }
}

// In Stokes's range to round-off, as the sphere of its volume.
TEST(DemClumps, SettleAsTheSphereOfTheirVolume) {
  const double step = 1e-5, relaxation = 2e-3;
  Scene scene("clump_settles", doublet(step, 0.2, 0.22));
  FluidForces forces(*scene.dem, ForceParameters{});
  scene.dem->set_up();
  const FluidAtParticle syrup{{}, {}, 1e-30, mass / (3 * pi * diameter * relaxation), {}};
  const double start = half_step_momentum(*scene.dem).z / mass;
  const int steps = 1000;
  for (int n = 0; n < 10; ++n) window(*scene.dem, forces, syrup, steps / 10);
  const double end = -9.81 * relaxation;
  EXPECT_NEAR(
      half_step_momentum(*scene.dem).z / mass / (end + (start - end) * std::exp(-steps * step / relaxation)),
      1, 1e-3);
}

// One sphere is in syrup, the other in nothing, and the drag is stiff: 20 times over in a step. The whole
// comes to what all of its weight and the drag of the half make.
TEST(DemClumps, OneSphereDragsTheWhole) {
  const double step = 1e-5, relaxation = step / 20;
  Scene scene("clump_half", doublet(step, 0.2, 0.22, gravity, " tflag off off off"));
  FluidForces forces(*scene.dem, ForceParameters{});
  scene.dem->set_up();
  const FluidAtParticle syrup{{}, {}, 1e-30, mass / (3 * pi * diameter * relaxation), {}};
  const FluidAtParticle nothing{{}, {}, 1e-30, 1e-30, {}};
  for (int n = 0; n < 3; ++n) {
    forces.begin_window(std::vector<FluidAtParticle>{syrup, nothing}, 10 * step);
    scene.dem->run(10);
  }
  EXPECT_NEAR(half_step_momentum(*scene.dem).z / mass / (-9.81 * 2 * relaxation), 1, 0.01);
}

TEST(DemClumps, StayWhereTheyAreNeutral) {
  Scene scene("clump_neutral", doublet(1e-5, 0.2, 0.22, gravity));
  FluidForces forces(*scene.dem, ForceParameters{});
  scene.dem->set_up();
  const Vec3 start = half_step_momentum(*scene.dem);
  for (int n = 0; n < 10; ++n) window(*scene.dem, forces, {{}, {0, 0, -2500 * 9.81}, 1e-30, 1e-30, {}}, 100);
  EXPECT_LT(norm(half_step_momentum(*scene.dem) - start), 1e-5 * mass * 9.81 * 1e-2);
}

// Through a fall, and through contacts with the floor.
TEST(DemClumps, KeepTheBooksOfMomentum) {
  Scene scene("clump_books", doublet(1e-5, 0.005, 0.008));
  ForceParameters parameters;
  parameters.added_mass = 0.5;
  FluidForces forces(*scene.dem, parameters);
  scene.dem->set_up();
  Vec3 before = half_step_momentum(*scene.dem);
  bool touched = false;
  for (int n = 0; n < 60; ++n) {
    forces.begin_window(std::vector<FluidAtParticle>(scene.dem->particles().count, water()), 1e-3);
    if (n == 0) forces.first_half_step();
    scene.dem->run(100);
    const WindowImpulses given = forces.impulses();
    const Vec3 after = half_step_momentum(*scene.dem);
    EXPECT_LT(norm(after - before - given.drag - given.pressure - given.contact - given.gravity),
              1e-14 * mass)
        << n;
    touched = touched || norm(given.contact) > 0;
    EXPECT_EQ(forces.carried(0).contacts.touching, forces.carried(1).contacts.touching);
    before = after;
  }
  EXPECT_TRUE(touched);
}

// On its largest sphere: that holds all of them, and none is accelerated.
TEST(DemClumps, RestAsAWhole) {
  Scene scene("clump_rests", uneven(0.001, 0.006, 1, " tflag off off off"));
  ForceParameters parameters;
  parameters.added_mass = 0.5;
  FluidForces forces(*scene.dem, parameters);
  scene.dem->set_up();
  for (int n = 0; n < 300; ++n) window(*scene.dem, forces, water(), 100);
  const double weight = scene.dem->census().solid_volume * 2500 * 9.81;
  const auto particles = scene.dem->particles();
  ASSERT_EQ(particles.count, 4);
  for (int i = 0; i < particles.count; ++i) {
    EXPECT_EQ(forces.carried(i).contacts.touching, 100);
    EXPECT_LT(norm(forces.drag_impulse(i)), 1e-6 * weight * 1e-3) << "added mass";
  }
}

TEST(DemClumps, AreRefusedWhereTheyAreNotKnown) {
  const std::string put_now = "run 1\nunfix put\n";
  const auto message = [&](const std::string& more, const ForceParameters& parameters,
                           bool later = false) -> std::string {
    std::string script = doublet(1e-5, 0.2, 0.22, more);
    if (later) {  // and in a group of their own
      script.erase(script.find(put_now), put_now.size());
      script.replace(script.find("fix move all"), 12, "group whole type 1\nfix move whole");
    }
    try {
      const Scene scene("clump_refused", script);
      const FluidForces forces(*scene.dem, parameters);
    } catch (const demvof::InputError& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_EQ(message("", {}), "");
  for (const char* holding : {"fix hold all freeze\n", "fix hold all move linear 0 0 0\n"})
    for (const bool later : {false, true})
      EXPECT_NE(message(holding, {}, later).find("LIGGGHTS moves clumps as if it were not there"),
                std::string::npos)
          << holding << "clumps put in by the coupled run: " << later;
  EXPECT_NE(message("create_atoms 1 single 0.05 0.05 0.3 units box\n", {})
                .find("nothing moves a sphere that belongs to no clump (id 3)"),
            std::string::npos);
  EXPECT_NE(
      message(integrate, {}).find("fix integrate nve/sphere: fix multisphere moves these spheres already"),
      std::string::npos);
  ForceParameters torque;
  torque.torque = true;
  EXPECT_NE(message("", torque).find("forces: torque is known for spheres alone"), std::string::npos);
}

}  // namespace
}  // namespace demvof_test
