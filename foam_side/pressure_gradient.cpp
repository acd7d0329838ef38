// SPDX-License-Identifier: GPL-3.0-or-later
// What the particles are told about the fluid's pressure.
//
//   grad p = G + (sigma kappa grad alpha) + rho g,   G = grad p_rgh + g.x grad rho - sigma kappa grad alpha
//
// The part of surface tension, the Laplace jump, is told only to particles that feel the capillary force
// against it (forces: capillary) or that displace no fluid: with a void fraction the fluid gets eps of the
// capillary force, and the particles' share cancels their share of the jump. G and surface tension come from
// the face values that drive the momentum equation: G is zero in a fluid at rest. Where void fraction or drag
// jump from one cell to the next the pressure has a kink at the face between them (face_drag.hpp), and each
// cell is pushed by the gradient of its own side. That one is told: with the gradient across the face
// instead, fluid and particles together lose (1 - eps)/(2 N) of the force on a bed N cells thick
// (tests/verification/pair/thin_bed.py). Before the first step the faces' gradient has to do.

#include "foam_side/pressure_gradient.hpp"

#include "foam_side/kept_field.hpp"

namespace demvof {

namespace {

const char* const own_name = "ownPressureGradient";
const char* const kinks_name = "pressureGradientAtKinks";

}  // namespace

const Foam::vectorField* find_own_gradient(const Flow& flow) {
  return find_kept(flow, own_name);
}
Foam::vectorField& own_gradient(Flow& flow) {
  return kept(flow, own_name, Foam::dimPressure / Foam::dimLength);
}
const Foam::vectorField* find_gradient_at_kinks(const Flow& flow) {
  return find_kept(flow, kinks_name);
}
Foam::vectorField& gradient_at_kinks(Flow& flow) {
  return kept(flow, kinks_name, Foam::dimPressure / Foam::dimLength);
}

Foam::vectorField pressure_gradient(const Flow& flow, bool with_laplace_jump) {
  const Foam::vectorField* own = find_own_gradient(flow);
  tmp<surfaceScalarField> balance;
  if (!own) balance = (fvc::snGrad(flow.p_rgh) + flow.ghf * fvc::snGrad(flow.rho)) * flow.mesh.magSf();
  if (flow.scene.surface_tension && with_laplace_jump == (own != nullptr)) {
    const surfaceScalarField tension(flow.mixture.surfaceTensionForce() * flow.mesh.magSf());
    if (own)
      balance = tmp<surfaceScalarField>::New(tension);
    else
      balance.ref() -= tension;
  }
  Foam::vectorField gradient(flow.mesh.nCells(), Foam::Zero);
  if (balance.valid()) gradient = (*flow.reconstruct)([&](const auto& at, label) { return at(balance()); });
  if (own) gradient += *own;
  gradient += flow.rho.primitiveField() * flow.g.value();
  return gradient;
}

}  // namespace demvof
