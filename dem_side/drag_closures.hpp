// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "coupler/closures/drag.hpp"
#include "coupler/closures/own_wake.hpp"
#include "dem_side/carried_fluid.hpp"
#include "dem_side/closure_count.hpp"

namespace demvof {

// A law as the particle loop has it: inlined, chosen once. Slip: double or Series.
template <class Law>
struct DragClosure {
  Law law;
  DragRange range;

  template <class Slip>
  Slip factor(const CarriedFluid& fluid, double diameter, const Slip& slip, ClosureCount& count) const {
    const double eps = fluid.void_fraction;
    const double reynolds = superficial_reynolds(diameter, fluid.density, fluid.viscosity, value(slip), eps);
    ++count.evaluations;
    count.outside += !range.contains(reynolds, eps);
    return law(diameter, fluid.density, fluid.viscosity, slip, eps);
  }
};
template <class Law>
DragClosure(Law, DragRange) -> DragClosure<Law>;
// Beetstra's, which knows beds of several sizes (closures/size_mix.hpp).
struct BeetstraOfSizes {
  template <class Slip>
  Slip factor(const CarriedFluid& fluid, double diameter, const Slip& slip, ClosureCount& count) const {
    const double eps = fluid.void_fraction;
    const double mean = fluid.sizes.sauter_diameter > 0 ? fluid.sizes.sauter_diameter : diameter;
    const double reynolds = superficial_reynolds(mean, fluid.density, fluid.viscosity, value(slip), eps);
    const double ratio = diameter / mean;
    ++count.evaluations;
    count.outside += !beetstra_range.contains(reynolds, eps) || !size_ratio_known(ratio);
    return ratio * size_share(ratio, fluid.sizes.coarseness) *
           beetstra(mean, fluid.density, fluid.viscosity, slip, eps);
  }
};
struct NoDrag {
  template <class Slip>
  Slip factor(const CarriedFluid&, double, const Slip&, ClosureCount&) const {
    return 0;
  }
};

// Drag factor for the slip that is seen when the drag follows the slip without the particle's own wake, which
// is slip / (1 - psi); psi at that slip, which one repetition finds.
template <class Drag, class Slip>
Slip without_own_wake(const Drag& law, const CarriedFluid& fluid, double diameter, const Slip& slip,
                      double width, ClosureCount& count) {
  const auto ratio = [&](const Slip& beta, const Slip& true_slip) -> Slip {
    return 1.0 / (1.0 - own_wake_share(beta, fluid.density, fluid.viscosity, true_slip, width));
  };
  ClosureCount first_guess;
  const Slip true_slip = slip * ratio(law.factor(fluid, diameter, slip, first_guess), slip);
  const Slip beta = law.factor(fluid, diameter, true_slip, count);
  return beta * ratio(beta, true_slip);
}

}  // namespace demvof
