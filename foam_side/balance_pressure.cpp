// SPDX-License-Identifier: GPL-3.0-or-later
// Pressure of the fluid as it stands, before it has moved:
//
//   div(M (face_force - grad p_rgh.S)) = 0,   M = dt eps/rho at faces
//
// Its accelerations keep the flow free of divergence. A case's uniform p_rgh says nothing of that, and the
// particles feel the pressure gradient of the start for a whole window.

#include "foam_side/flow.hpp"

namespace demvof {

void balance_pressure(Flow& flow) {
  constexpr int most = 30;  // solutions: between fine and coarse cells a part of each face's gradient lags
  update_face_force(flow);
  const tmp<surfaceScalarField> mobility = projection_mobility(flow);
  const surfaceScalarField forced("phiHbyA", mobility() * flow.face_force());
  // What comes in with a given velocity does not accelerate either.
  const volVectorField still(Foam::IOobject("still", flow.time.timeName(), flow.mesh), flow.mesh,
                             Foam::dimensionedVector(Foam::dimVelocity, Foam::Zero));
  for (int n = 0; n < most; ++n) {
    Foam::constrainPressure(flow.p_rgh, still, forced, mobility());
    Foam::fvScalarMatrix equation(fvm::laplacian(mobility(), flow.p_rgh) == fvc::div(forced));
    equation.setReference(flow.p_reference_cell, Foam::getRefCellValue(flow.p_rgh, flow.p_reference_cell));
    if (equation.solve(flow.mesh.solver(flow.p_rgh.select(true))).nIterations() == 0) break;
  }
  flow.p == flow.p_rgh + flow.rho* flow.gh;
}

bool pressure_says_nothing(const Flow& flow) {
  const scalarField& p = flow.p_rgh.primitiveField();
  return Foam::gMax(p) == Foam::gMin(p);
}

}  // namespace demvof
