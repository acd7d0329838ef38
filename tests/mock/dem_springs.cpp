// SPDX-License-Identifier: GPL-3.0-or-later
// Contacts that give way while the drag holds on: who counts, and the stiffness that a script gives them.

#include <cmath>

#include "dem_side/soft_contacts.hpp"
#include "tests/mock/dem_fixture.hpp"
#include "tests/support/mpi_main.hpp"

namespace demvof_test {
namespace {

using demvof::ContactStiffness;
using demvof::FluidAtParticle;
using demvof::FluidForces;
using demvof::ForceParameters;
using demvof::SoftContacts;

constexpr double time_step = 1e-6, eps = 0.6;
constexpr int steps = 10;

std::string materials(const std::string& model, const std::string& more) {
  return "units si\natom_style granular\natom_modify map array\nboundary f f f\nnewton off\ncommunicate "
         "single vel yes\n"
         "region box block 0 0.1 0 0.1 0 0.4 units box\ncreate_box 2 box\nneighbor 0.001 bin\nneigh_modify "
         "delay 0\n"
         "fix m1 all property/global youngsModulus peratomtype 5e6 2e6\n"
         "fix m2 all property/global poissonsRatio peratomtype 0.45 0.3\n"
         "fix m3 all property/global coefficientRestitution peratomtypepair 2 0.5 0.5 0.5 0.5\n"
         "fix m4 all property/global coefficientFriction peratomtypepair 2 0.3 0.3 0.3 0.3\n" +
         more + "pair_style gran model " + model + " tangential history\npair_coeff * *\ntimestep 1e-6\n" +
         integrate;
}

SoftContacts over_ranks(SoftContacts found, MPI_Comm world) {
  MPI_Allreduce(MPI_IN_PLACE, &found.touching, 2, MPI_DOUBLE, MPI_SUM, world);
  MPI_Allreduce(MPI_IN_PLACE, &found.holding_window, 2, MPI_DOUBLE, MPI_MAX, world);
  return found;
}

// Two beads that touch and one that does not, k_t = 285 N/m, in a fluid at rest: n beta = 3 pi mu d.
TEST(DemSprings, CountWhereDragOutrunsThem) {
  const double window = steps * time_step, spring = 285;
  Scene scene("springs", empty_box(time_step) + bead({0.05, 0.05, 0.2}) +
                             bead({0.05 + 0.999 * bead_diameter, 0.05, 0.2}) + bead({0.05, 0.05, 0.1}) +
                             bead_properties() + integrate);
  FluidForces forces(*scene.dem, ForceParameters{});
  scene.dem->set_up();
  // over: 2 n beta/(k_t dt); stiffness: A = n beta dt (1 - eps)/(rho eps V)
  const auto found = [&](double over, double stiffness) {
    const double tangent = over * spring * window / 2;
    FluidAtParticle still;
    still.density = tangent * window * (1 - eps) / (stiffness * eps * bead_volume);
    still.viscosity = tangent / (3 * pi * bead_diameter);
    still.void_fraction = eps;
    forces.begin_window(std::vector<FluidAtParticle>(scene.dem->particles().count, still), window);
    scene.dem->run(steps);
    return over_ranks(count_soft_contacts(*scene.dem, forces, scene.dem->contact_stiffness()),
                      scene.dem->world());
  };
  EXPECT_EQ(found(0.98, 10).soft, 0);
  EXPECT_EQ(found(1.02, 0.59).soft, 0);
  const SoftContacts soft = found(1.02, 0.61);
  EXPECT_EQ(soft.touching, 2);
  EXPECT_EQ(soft.soft, 2);
  // Not Stokes's drag to the last digit: the beads push each other apart.
  EXPECT_NEAR(soft.holding_window / window, 1.02, 2e-3);
  EXPECT_NEAR(soft.rate * window, 0.61, 1.3e-3);
}

// Sliding stiffness of two equal spheres pressed by a load, by way of their overlap (Johnson 1985).
TEST(DemSprings, HertzFollowsTheLoad) {
  const double modulus = 5e6, nu = 0.45, radius = 1e-3, load = 2e-3;
  const double effective = modulus / (2 * (1 - nu * nu)), shear = modulus / (4 * (2 - nu) * (1 + nu));
  const double overlap = std::pow(load / (4. / 3 * effective * std::sqrt(radius / 2)), 2. / 3);
  EXPECT_NEAR(demvof::hertz_tangential_stiffness(effective, nu, radius, load) /
                  (8 * shear * std::sqrt(radius / 2 * overlap)),
              1, 1e-12);
  Scene scene("hertz", materials("hertz", ""));
  const auto softer = scene.dem->contact_stiffness().tangential(2, radius, 1, load);
  ASSERT_TRUE(softer);
  EXPECT_NEAR(*softer / demvof::hertz_tangential_stiffness(2e6 / (2 * (1 - 0.09)), 0.3, radius, load), 1,
              1e-12);
}

// The spring that stores the energy of a collision at V with the same overlap as Hertz's: k V-dependent, k_t
// = k_n.
TEST(DemSprings, HookeFollowsTheCharacteristicVelocity) {
  Scene scene("hooke", materials("hooke", "fix m5 all property/global characteristicVelocity scalar 2.\n"));
  const double radius = 1e-3, mass = 1e-5, speed = 2;
  const double effective = 5e6 / (2 * (1 - 0.45 * 0.45));
  const auto spring = scene.dem->contact_stiffness().tangential(1, radius, mass, 123);
  ASSERT_TRUE(spring);
  // Largest overlap of Hertz: m* V^2/2 = 8/15 E* r*^1/2 d^5/2; the spring: m* V^2/2 = k d^2/2.
  const double energy = 0.5 * mass / 2 * speed * speed;
  const double overlap = std::pow(energy / (8. / 15 * effective * std::sqrt(radius / 2)), 0.4);
  EXPECT_NEAR(*spring / (2 * energy / (overlap * overlap)), 1, 1e-12);
}

}  // namespace
}  // namespace demvof_test
