// SPDX-License-Identifier: GPL-3.0-or-later
// I dw/dt = beta_r (curl u / 2 - w) + T_contact, solved exactly over a DEM step in which beta_r, curl u and
// the torque of contacts are constant (implicit_drag.hpp with I, spin and torques in place of mass, velocity
// and forces). LIGGGHTS integrates the spin as it does the velocity: what it holds is w(n-1/2) at step n.
#include "dem_side/fluid_torque.hpp"

#include "coupler/base/mpi_check.hpp"
#include "coupler/closures/torque.hpp"
#include "dem_side/implicit_drag.hpp"

namespace demvof {

void FluidTorque::begin_window() {
  torque_sums_ = {};
  count_ = {};
}

void FluidTorque::add_fluid(Grip& grip, const ParticleArrays& particles, int i, double share, double density,
                            double viscosity, const Vec3& vorticity) {
  if (!dem_.turns(particles.mask[i])) return;
  const double diameter = 2 * particles.radius[i];
  const Vec3 rotation = 0.5 * vorticity - vec3(particles.spin[i]);
  const double turning = norm(rotation);
  ++count_.evaluations;
  count_.outside += spin_reynolds(diameter, density, viscosity, turning) > torque_largest_reynolds;
  const double factor = share * torque_factor(diameter, density, viscosity, turning);
  grip.factor += factor;
  grip.pull += factor * rotation;
}

void FluidTorque::act(const ParticleArrays& particles, int i, const Grip& grip) {
  if (!dem_.turns(particles.mask[i])) return;
  const Vec3 contact = vec3(particles.torque[i]);
  torque_sums_.contact += contact;
  if (grip.factor == 0) return;
  const Vec3 given =
      implicit_drag(grip.factor, grip.pull, contact,
                    moment_of_inertia(particles.mass[i], particles.radius[i]), dem_.time_step());
  torque_sums_.fluid += given;
  for (int axis = 0; axis < 3; ++axis) particles.torque[i][axis] += given[axis];
}

SpinImpulses FluidTorque::impulses() const {
  const double step = dem_.time_step();
  return {step * torque_sums_.fluid, step * torque_sums_.contact};
}

Vec3 half_step_spin(const Dem& dem) {
  const ParticleArrays particles = dem.particles();
  Vec3 momentum;
  for (int i = 0; i < particles.count; ++i)
    if (dem.turns(particles.mask[i]))
      momentum += moment_of_inertia(particles.mass[i], particles.radius[i]) * vec3(particles.spin[i]) +
                  0.5 * dem.time_step() * vec3(particles.torque[i]);
  check_mpi(MPI_Allreduce(MPI_IN_PLACE, &momentum.x, 3, MPI_DOUBLE, MPI_SUM, dem.world()), "MPI_Allreduce");
  return momentum;
}

}  // namespace demvof
