// SPDX-License-Identifier: GPL-3.0-or-later
// The half DEM step before the first one, in which LIGGGHTS's set-up knows no fluid.

#include "dem_side/forces.hpp"
#include "dem_side/report.hpp"
#include "tests/mock/dem_fixture.hpp"
#include "tests/support/mpi_main.hpp"

namespace demvof_test {
namespace {

using demvof::FluidAtParticle;
using demvof::FluidForces;
using demvof::WindowImpulses;

// The step before the first one has weight and fluid alike: a neutral bead stays where it is, one that
// follows its liquid within a small part of a DEM step does not fall freely for half of one, and a frozen one
// pays the fluid for whole steps alone. What comes with the half step is in the books.
TEST(DemStart, GivesTheFluidToTheFirstHalfStep) {
  const double step = 1e-3, relaxation = 1e-6;
  Scene scene("half_step", empty_box(step) + bead({0.02, 0.05, 0.2}) + bead({0.05, 0.05, 0.2}) +
                               bead_properties() + gravity +
                               "region left block 0 0.03 0 0.1 0 0.4 units box\ngroup left region left\n"
                               "fix hold left freeze\n" +
                               integrate);
  FluidForces forces(*scene.dem, demvof::ForceParameters{});
  scene.dem->set_up();
  const Vec3 start = demvof::half_step_momentum(*scene.dem);
  const double viscosity = bead_mass / (3 * pi * bead_diameter * relaxation);  // Stokes drag to round-off
  const FluidAtParticle fluid{{1e-3, 0, 0}, {0, 0, -bead_density * 9.81}, 1e-30, viscosity, {}};
  const int count = scene.dem->particles().count;
  forces.begin_window(std::vector<FluidAtParticle>(count, fluid), 4 * step);
  forces.first_half_step();
  scene.dem->run(4);
  const auto particles = scene.dem->particles();
  for (int i = 0; i < count; ++i) {
    const bool frozen = particles.position[i][0] < 0.03;
    EXPECT_NEAR(particles.position[i][2], 0.2, 1e-15);
    EXPECT_NEAR(particles.position[i][0], frozen ? 0.02 : 0.05 + 4 * step * 1e-3, 1e-12);
    if (frozen) {
      EXPECT_NEAR(forces.drag_impulse(i).x / (bead_mass / relaxation * 1e-3 * 4 * step), 1, 1e-12);
    }
  }
  WindowImpulses sums = forces.impulses();
  MPI_Allreduce(MPI_IN_PLACE, &sums.drag.x, sizeof(sums) / sizeof(double), MPI_DOUBLE, MPI_SUM,
                scene.dem->world());
  const Vec3 booked = sums.drag + sums.pressure - sums.held + sums.gravity + sums.contact;
  EXPECT_LT(norm(demvof::half_step_momentum(*scene.dem) - start - booked), 1e-12 * norm(start));
}

}  // namespace
}  // namespace demvof_test
