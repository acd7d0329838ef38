// SPDX-License-Identifier: GPL-3.0-or-later
#include "coupler/closures/lift.hpp"
#include "coupler/closures/spin_lift.hpp"
#include "dem_side/forces.hpp"

namespace demvof {

Vec3 FluidForces::lift(const CarriedFluid& fluid, const CarriedGradients& gradients, double diameter,
                       const Vec3& slip) {
  if (parameters_.lift == LiftLaw::none) return {};
  const double speed = norm(slip), vorticity = norm(gradients.vorticity);
  const double reynolds = fluid.density * speed * diameter / fluid.viscosity;
  const bool inside =
      speed > 0 && saffman_mei_range.contains(reynolds, shear_over_slip(diameter, speed, vorticity));
  ++lift_count_.evaluations;
  lift_count_.outside += !inside;
  return saffman_mei(diameter, fluid.density, fluid.viscosity, slip, gradients.vorticity);
}

Vec3 FluidForces::spin_lift(const CarriedFluid& fluid, const CarriedGradients& gradients, double diameter,
                            const Vec3& spin, const Vec3& slip) {
  if (parameters_.spin_lift == SpinLiftLaw::none) return {};
  const bool creeping = parameters_.spin_lift == SpinLiftLaw::rubinow_keller;
  const SpinLiftRange& range = creeping ? rubinow_keller_range : oesterle_bui_dinh_range;
  const Vec3 rotation = 0.5 * gradients.vorticity - spin;
  const double speed = norm(slip);
  const double reynolds = fluid.density * speed * diameter / fluid.viscosity;
  const double over_slip = speed > 0 ? spin_over_slip(diameter, speed, norm(rotation)) : 0;
  ++spin_lift_count_.evaluations;
  spin_lift_count_.outside += !range.contains(reynolds, over_slip);
  const double factor = creeping ? 1 : oesterle_bui_dinh(reynolds, over_slip);
  return spin_lift_force(diameter, fluid.density, factor, rotation, slip);
}

}  // namespace demvof
