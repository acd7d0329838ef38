// SPDX-License-Identifier: GPL-3.0-or-later
// What the particles are told about the fluid's state.
//
//   grad p = [(grad p_rgh + g.x grad rho).S reconstructed in the cell] + rho g
//
// The bracket is the balance that correct_pressure makes at the faces: zero in a fluid at rest.

#include "foam_side/flow.hpp"

namespace demvof {

tmp<volVectorField> pressure_gradient(const Flow& flow) {
  return fvc::reconstruct((fvc::snGrad(flow.p_rgh) + flow.ghf * fvc::snGrad(flow.rho)) * flow.mesh.magSf()) +
         flow.rho * flow.g;
}

tmp<scalarField> dynamic_viscosity(const Flow& flow) {
  return flow.rho.primitiveField() * flow.turbulence->nuEff()->primitiveField();
}

}  // namespace demvof
