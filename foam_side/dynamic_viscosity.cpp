// SPDX-License-Identifier: GPL-3.0-or-later
// mu = rho nu, nu with the eddy viscosity of the turbulence model.

#include "foam_side/flow.hpp"

namespace demvof {

tmp<scalarField> dynamic_viscosity(const Flow& flow) {
  return flow.rho.primitiveField() * flow.turbulence->nuEff()->primitiveField();
}

}  // namespace demvof
