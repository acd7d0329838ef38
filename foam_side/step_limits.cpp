// SPDX-License-Identifier: GPL-3.0-or-later
#include "foam_side/step_limits.hpp"

#include <cmath>

namespace demvof {

double longest_step(const Flow& flow, double window) {
  const StepLimits limits(flow.time.controlDict());
  if (window <= 0) return flow.time.deltaTValue();
  return std::min(window, limits.adjust ? limits.step : flow.time.deltaTValue());
}

CourantRates courant_rates(const Flow& flow) {
  const tmp<volScalarField> throughput = fvc::surfaceSum(Foam::mag(flow.phi));
  scalarField rate(throughput().primitiveField() / flow.mesh.V().field());
  if (flow.porosity) rate /= flow.porosity->eps.primitiveField();
  CourantRates worst;
  forAll(rate, cell) {
    worst.anywhere = std::max(worst.anywhere, rate[cell]);
    const bool interface = flow.alpha[cell] >= 0.01 && flow.alpha[cell] <= 0.99;
    if (interface) worst.interface = std::max(worst.interface, rate[cell]);
  }
  Foam::reduce(worst.anywhere, Foam::maxOp<scalar>());
  Foam::reduce(worst.interface, Foam::maxOp<scalar>());
  return {0.5 * worst.anywhere, 0.5 * worst.interface};
}

double capillary_step(const Flow& flow, double surface_tension) {
  if (surface_tension <= 0) return 0;
  const double smallest = Foam::gMin(flow.mesh.V().field());  // dx^3, m3
  const double density = flow.mixture.rho1().value() + flow.mixture.rho2().value();
  return std::sqrt(density * smallest / (4 * M_PI * surface_tension));
}

}  // namespace demvof
