// SPDX-License-Identifier: GPL-3.0-or-later
// What the particles are told about the fluid's state.
//
//   grad p = [(grad p_rgh + g.x grad rho).S reconstructed in the cell] + rho g
//
// The bracket is the balance that correct_pressure makes at the faces: zero in a fluid at rest.

#include "foam_side/flow.hpp"

namespace demvof {

Foam::vectorField pressure_gradient(const Flow& flow) {
  const surfaceScalarField balance((fvc::snGrad(flow.p_rgh) + flow.ghf * fvc::snGrad(flow.rho)) *
                                   flow.mesh.magSf());
  Foam::vectorField gradient = (*flow.reconstruct)([&](const auto& at, label) { return at(balance); });
  gradient += flow.rho.primitiveField() * flow.g.value();
  return gradient;
}

}  // namespace demvof
