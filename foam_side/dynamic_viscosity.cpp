// SPDX-License-Identifier: GPL-3.0-or-later
// mu = rho nu, nu with the eddy viscosity of the turbulence model.

#include "foam_side/flow.hpp"

namespace demvof {

tmp<scalarField> dynamic_viscosity(const Flow& flow) {
  return flow.rho.primitiveField() * flow.turbulence->nuEff()->primitiveField();
}

tmp<scalarField> dynamic_viscosity(const Flow& flow, int fluid) {
  const bool liquid = fluid == 0;
  const double rho = (liquid ? flow.mixture.rho1() : flow.mixture.rho2()).value();
  const Foam::viscosityModel& model = liquid ? flow.mixture.nuModel1() : flow.mixture.nuModel2();
  return rho * (model.nu()().primitiveField() + flow.turbulence->nut()().primitiveField());
}

}  // namespace demvof
