// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "coupler/base/vec3.hpp"
#include "dem_side/closure_count.hpp"
#include "dem_side/dem.hpp"

namespace demvof {

/// Angular impulses of one window on the particles of this rank that torques turn, N m s. They add up to the
/// change of their spin momentum, sum of I w at half steps (forces.hpp), to round-off.
struct SpinImpulses {
  Vec3 fluid, contact;
};

/// Torque of the fluid on the particles, in every DEM step, integrated like the drag: stable and without
/// overshoot for any step. A couple has no net force: nothing of it goes back to the fluid, it is only
/// booked.
class FluidTorque {
 public:
  explicit FluidTorque(const Dem& dem) : dem_(dem) {}

  void begin_window();

  /// What the fluids do to a particle: sums of beta_r, N m s, and of beta_r W, N m.
  struct Grip {
    double factor = 0;
    Vec3 pull;
  };
  /// share: of local particle i that lies in a fluid of this density, kg/m3, viscosity, Pa s, and vorticity,
  /// 1/s.
  void add_fluid(Grip& grip, const ParticleArrays& particles, int i, double share, double density,
                 double viscosity, const Vec3& vorticity);
  /// Adds to the torque of local particle i in the present DEM step.
  void act(const ParticleArrays& particles, int i, const Grip& grip);

  SpinImpulses impulses() const;
  const ClosureCount& count() const { return count_; }

 private:
  const Dem& dem_;
  SpinImpulses torque_sums_;  // N m, over the steps of this window
  ClosureCount count_;
};

/// Spin momentum of the particles that torques turn at half steps, sum of I w + (dt/2) T, over all ranks,
/// kg m2/s. Collective.
Vec3 half_step_spin(const Dem& dem);

}  // namespace demvof
