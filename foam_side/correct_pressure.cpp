// SPDX-License-Identifier: GPL-3.0-or-later
// Pressure from continuity, then flux and velocity.
//
//   phi = eps_f (H/A)_f.S + memory + M (face_force - grad p_rgh.S),   M = eps_f (eps/A)_f
//   div(M grad p_rgh) = div(phi without grad p_rgh) + d(eps)/dt
//   u = H/A + (eps/A) [face_force - grad p_rgh.S reconstructed in the cell]
//
// Gravity, surface tension and pressure meet at the face before eps or A enter: where they balance,
// flux and velocity are zero for any void fraction and any drag.

#include "foam_side/flow.hpp"

namespace demvof {
namespace {

/// The rate that the flux being solved has to serve: it moves alpha again in this step if an outer
/// corrector follows, otherwise in the next one.
tmp<scalarField> rate_to_serve(const Flow& flow) {
  if (flow.pimple.finalIter()) return wanted_porosity_rate(flow);
  const Porosity& porosity = *flow.porosity;
  return (porosity.goal.field() - porosity.eps.oldTime().primitiveField()) / flow.time.deltaTValue();
}

void update_face_velocity(Flow& flow) {
  if (!flow.face_velocity) return;
  const surfaceVectorField normal(flow.mesh.Sf() / flow.mesh.magSf());
  surfaceVectorField& face_velocity = *flow.face_velocity;
  face_velocity = fvc::interpolate(flow.U);
  tmp<surfaceScalarField> speed = flow.phi / flow.mesh.magSf();
  if (flow.porosity) speed.ref() /= *flow.pressure_system.eps_f;
  face_velocity += normal * (speed - (normal & face_velocity));
}

}  // namespace

bool pressure_corrector(Flow& flow) {
  if (flow.pimple.correct()) return true;
  if (flow.pimple.turbCorr()) flow.turbulence->correct();
  return false;
}

void correct_pressure(Flow& flow) {
  const PressureSystem& system = flow.pressure_system;
  const volScalarField& rAU = *system.inverse_diagonal;
  const surfaceScalarField& mobility_f = *system.mobility_f;

  volVectorField HbyA(Foam::constrainHbyA(rAU * system.momentum->H(), flow.U, flow.p_rgh));
  surfaceScalarField phiHbyA("phiHbyA", fvc::flux(HbyA));
  if (flow.porosity) phiHbyA *= *system.eps_f;
  phiHbyA += *system.memory;
  if (flow.p_rgh.needReference()) Foam::adjustPhi(phiHbyA, flow.U, flow.p_rgh);
  phiHbyA += flow.face_force() * mobility_f;

  if (flow.porosity)
    Foam::constrainPressure(flow.p_rgh, flow.porosity->eps, flow.U, phiHbyA, mobility_f);
  else
    Foam::constrainPressure(flow.p_rgh, flow.U, phiHbyA, mobility_f);

  while (flow.pimple.correctNonOrthogonal()) {
    Foam::fvScalarMatrix equation(fvm::laplacian(mobility_f, flow.p_rgh) == fvc::div(phiHbyA));
    if (flow.porosity) equation.source() += flow.mesh.V().field() * rate_to_serve(flow);
    equation.setReference(flow.p_reference_cell, Foam::getRefCellValue(flow.p_rgh, flow.p_reference_cell));
    equation.solve(flow.mesh.solver(flow.p_rgh.select(flow.pimple.finalInnerIter())));
    if (!flow.pimple.finalNonOrthogonalIter()) continue;

    const tmp<surfaceScalarField> pressure_flux = equation.flux();
    flow.phi = phiHbyA - pressure_flux();
    flow.p_rgh.relax();
    tmp<volScalarField> mobility = flow.porosity ? flow.porosity->eps * rAU : tmp<volScalarField>(rAU);
    flow.U = HbyA + mobility * fvc::reconstruct(flow.face_force() - pressure_flux / mobility_f);
    flow.U.correctBoundaryConditions();
  }
  update_face_velocity(flow);
}

}  // namespace demvof
