// SPDX-License-Identifier: GPL-3.0-or-later
// Pressure from continuity, then flux and velocity. Without particles, with h = H/A:
//
//   phi = mean(h).S + memory + a_f (face_force - grad p_rgh.S)
//   div(a_f grad p_rgh) = div(phi without grad p_rgh)
//   u = h + a [(face_force - grad p_rgh.S) reconstructed in the cell]
//
// With particles the face balance of face_drag.hpp, and div(phi) = -d(eps)/dt.
// Gravity, surface tension and pressure meet at the face: where they balance, flux and velocity are
// zero for any void fraction and any drag.

#include "foam_side/extras.hpp"
#include "foam_side/flow.hpp"
#include "foam_side/open_momentum.hpp"
#include "foam_side/pressure_gradient.hpp"
#include "inletOutletFvPatchFields.H"
#include "transformFvPatchFields.H"

namespace demvof {
namespace {

/// The rate that the flux being solved has to serve: it moves alpha again in this step if an outer
/// corrector follows, otherwise in the next one.
tmp<scalarField> rate_to_serve(const Flow& flow) {
  if (flow.porosity->swept) return prescribed_growth(flow);
  if (flow.pimple.finalIter()) return wanted_porosity_rate(flow);
  const Porosity& porosity = *flow.porosity;
  return (porosity.goal.field() - porosity.eps.oldTime().primitiveField()) / flow.time.deltaTValue();
}

void update_face_velocity(Flow& flow) {
  // phi is still that in space.
  if (flow.velocity_flux) *flow.velocity_flux = velocity_flux_of(flow, flow.phi);
  if (!flow.face_velocity) return;
  const surfaceVectorField normal(flow.mesh.Sf() / flow.mesh.magSf());
  surfaceVectorField& face_velocity = *flow.face_velocity;
  face_velocity = fvc::interpolate(flow.U);
  const tmp<surfaceScalarField> speed =
      (flow.porosity ? velocity_flux_of(flow, flow.phi) : tmp<surfaceScalarField>(flow.phi)) /
      flow.mesh.magSf();
  face_velocity += normal * (speed - (normal & face_velocity));
}

/// Flux without the forces that the pressure balances, m3/s.
tmp<surfaceScalarField> unforced_flux(const Flow& flow, const surfaceScalarField& transported) {
  if (!flow.source) return tmp<surfaceScalarField>::New("phiHbyA", transported);
  const FaceDrag& c = *flow.pressure_system.face_drag;
  tmp<surfaceScalarField> flux = tmp<surfaceScalarField>::New(
      "phiHbyA", (transported + c.resistance * c.reference + c.push) / (1.0 / c.eps_f + c.resistance));
  if (flow.porosity) flux.ref() += flow.porosity->carried;
  return flux;
}

/// Makes what leaves a box without a pressure boundary fit what enters it. Through patches with a given
/// velocity goes what it says: there flux still holds the push of particles beside the wall, which the wall's
/// pressure gradient takes.
void balance_boundary(Flow& flow, surfaceScalarField& flux) {
  surfaceScalarField through("balanced", flux);
  const auto given = [&flow](label patch) {
    const Foam::fvPatchVectorField& at = flow.U.boundaryField()[patch];
    if (at.coupled()) return false;
    if (Foam::isA<Foam::transformFvPatchVectorField>(at)) return true;  // slip, symmetry: nothing passes
    return at.fixesValue() && !Foam::isA<Foam::inletOutletFvPatchVectorField>(at);
  };
  forAll(flow.mesh.boundary(), patch) {
    if (!given(patch)) continue;
    Foam::fvsPatchScalarField& at = through.boundaryFieldRef()[patch];
    at == (flow.U.boundaryField()[patch] & flow.mesh.Sf().boundaryField()[patch]);
    if (flow.porosity) at *= flow.pressure_system.face_drag->eps_f.boundaryField()[patch];
  }
  make_relative(flow, through);
  Foam::adjustPhi(through, flow.U, flow.p_rgh);
  make_absolute(flow, through);
  forAll(flow.mesh.boundary(), patch) if (!given(patch))
          flux.boundaryFieldRef()[patch] == through.boundaryField()[patch];
}

/// force: (face_force - grad p_rgh.S), N/m.
void update_velocity(Flow& flow, const volVectorField& h, const surfaceScalarField& force) {
  const scalarField& rAU = flow.pressure_system.inverse_diagonal->primitiveField();
  const Foam::vectorField push = (*flow.reconstruct)([&](const auto& at, label) { return at(force); });
  Foam::vectorField& U = flow.U.primitiveFieldRef();
  forAll(U, cell) U[cell] = h[cell] + rAU[cell] * push[cell];
}

/// transported: (mean(h) - v).S of face_drag.hpp.
///
/// The pressure gradient of the cell itself is what this leaves to it (pressure_gradient.cpp):
///
///   (eps/A) G = F/A - push
void update_velocity_between_particles(Flow& flow, const volVectorField& h,
                                       const surfaceScalarField& transported) {
  const PressureSystem& system = flow.pressure_system;
  const FaceDrag& c = *system.face_drag;
  const scalarField& rAU = system.inverse_diagonal->primitiveField();
  const scalarField* eps = flow.porosity ? &flow.porosity->eps.primitiveField() : nullptr;
  const tmp<surfaceScalarField> past =  // w
      flow.porosity ? flow.phi - flow.porosity->carried : tmp<surfaceScalarField>(flow.phi);
  const Foam::vectorField push = (*flow.reconstruct)([&](const auto& at, label cell) {
    const scalar e = eps ? (*eps)[cell] : 1, k = c.stiffness[cell], w = at(past());
    const scalar pressure =
        (w - at(c.eps_f) * at(transported) + at(c.share) * k * (w - at(c.reference))) / e - at(c.push);
    return at(c.push) + e * rAU[cell] / at(*system.response) * pressure;
  });
  const Foam::vectorField& reference = flow.source->reference.field();
  const Foam::vectorField& force = flow.source->force.field();
  Foam::vectorField& U = flow.U.primitiveFieldRef();
  Foam::vectorField& own = own_gradient(flow);
  forAll(U, cell) {
    const scalar k = c.stiffness[cell];
    U[cell] = (h[cell] + k * reference[cell] + push[cell]) / (1 + k);
    own[cell] = (force[cell] - push[cell] / rAU[cell]) / (eps ? (*eps)[cell] : 1);
  }
}

/// After the last correction of a step. h: H/A as it was used.
void note_open_momentum(Flow& flow, const volVectorField& h) {
  const PressureSystem& system = flow.pressure_system;
  open_momentum(flow) =
      flow.time.deltaTValue() * (system.momentum->H()().primitiveField() -
                                 h.primitiveField() / system.inverse_diagonal->primitiveField());
}

}  // namespace

void correct_pressure(Flow& flow) {
  const PressureSystem& system = flow.pressure_system;
  const surfaceScalarField& mobility = *system.mobility;

  const volVectorField h(
      Foam::constrainHbyA(*system.inverse_diagonal * system.momentum->H(), flow.U, flow.p_rgh));
  surfaceScalarField transported(fvc::flux(h) + *system.memory);
  extras(flow).rotating.makeRelative(transported);
  if (flow.porosity) transported -= flow.porosity->along;
  surfaceScalarField phiHbyA(unforced_flux(flow, transported));
  if (flow.p_rgh.needReference()) balance_boundary(flow, phiHbyA);
  phiHbyA += mobility * flow.face_force();

  if (flow.porosity)
    Foam::constrainPressure(flow.p_rgh, flow.porosity->eps, flow.U, phiHbyA, mobility);
  else
    Foam::constrainPressure(flow.p_rgh, flow.U, phiHbyA, mobility, extras(flow).rotating);

  // The last of those of the case, or one that follows it.
  const bool further = system.further_corrections > 0;
  bool last = false;
  while (flow.pimple.correctNonOrthogonal()) {
    last = flow.pimple.finalInnerIter() || (further && flow.pimple.finalNonOrthogonalIter());
    Foam::fvScalarMatrix equation(fvm::laplacian(mobility, flow.p_rgh) == fvc::div(phiHbyA));
    if (flow.porosity) equation.source() += flow.mesh.V().field() * rate_to_serve(flow);
    if (flow.porosity && flow.porosity->swept)
      equation.source() -= flow.mesh.V().field() * fvc::div(*flow.porosity->swept)().primitiveField();
    equation.setReference(flow.p_reference_cell, Foam::getRefCellValue(flow.p_rgh, flow.p_reference_cell));
    equation.solve(flow.mesh.solver(flow.p_rgh.select(last)));
    if (!flow.pimple.finalNonOrthogonalIter()) continue;

    const tmp<surfaceScalarField> pressure_flux = equation.flux();
    flow.phi = phiHbyA - pressure_flux();
    flow.p_rgh.relax();
    if (flow.source)
      update_velocity_between_particles(flow, h, transported);
    else
      update_velocity(flow, h, flow.face_force() - pressure_flux / mobility);
    flow.U.correctBoundaryConditions();
    if (extras(flow).sources_of_momentum) extras(flow).sources.correct(flow.U);
  }
  update_face_velocity(flow);
  make_relative(flow, flow.phi);
  if (flow.source && last && flow.pimple.finalIter()) note_open_momentum(flow, h);
}

}  // namespace demvof
