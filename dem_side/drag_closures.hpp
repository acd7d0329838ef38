// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "coupler/closures/drag.hpp"
#include "coupler/closures/own_wake.hpp"
#include "dem_side/carried_fluid.hpp"
#include "dem_side/closure_count.hpp"

namespace demvof {

// A law as the particle loop has it: inlined, chosen once.
using DragFunction = double(double diameter, double density, double viscosity, double slip, double eps);
template <DragFunction* law>
struct DragClosure {
  DragRange range;
  double factor(const CarriedFluid& fluid, double diameter, double slip, ClosureCount& count) const {
    const double eps = fluid.void_fraction;
    const double reynolds = superficial_reynolds(diameter, fluid.density, fluid.viscosity, slip, eps);
    ++count.evaluations;
    count.outside += !range.contains(reynolds, eps);
    return law(diameter, fluid.density, fluid.viscosity, slip, eps);
  }
};
// Beetstra's, which knows beds of several sizes (closures/size_mix.hpp).
struct BeetstraOfSizes {
  double factor(const CarriedFluid& fluid, double diameter, double slip, ClosureCount& count) const {
    const double eps = fluid.void_fraction;
    const double mean = fluid.sizes.sauter_diameter > 0 ? fluid.sizes.sauter_diameter : diameter;
    const double reynolds = superficial_reynolds(mean, fluid.density, fluid.viscosity, slip, eps);
    const double ratio = diameter / mean;
    ++count.evaluations;
    count.outside += !beetstra_range.contains(reynolds, eps) || !size_ratio_known(ratio);
    return ratio * size_share(ratio, fluid.sizes.coarseness) *
           beetstra(mean, fluid.density, fluid.viscosity, slip, eps);
  }
};
struct NoDrag {
  double factor(const CarriedFluid&, double, double, ClosureCount&) const { return 0; }
};

// Drag factor for the slip that is seen when the drag follows the slip without the particle's own wake, which
// is slip / (1 - psi); psi at that slip, which one repetition finds.
template <class Drag>
double without_own_wake(const Drag& law, const CarriedFluid& fluid, double diameter, double slip,
                        double width, ClosureCount& count) {
  const auto ratio = [&](double beta, double true_slip) {
    return 1 / (1 - own_wake_share(beta, fluid.density, fluid.viscosity, true_slip, width));
  };
  ClosureCount first_guess;
  const double true_slip = slip * ratio(law.factor(fluid, diameter, slip, first_guess), slip);
  const double beta = law.factor(fluid, diameter, true_slip, count);
  return beta * ratio(beta, true_slip);
}

}  // namespace demvof
