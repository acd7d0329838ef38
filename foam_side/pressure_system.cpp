// SPDX-License-Identifier: GPL-3.0-or-later
#include "foam_side/pressure_system.hpp"

#include "foam_side/cell_field.hpp"
#include "foam_side/extras.hpp"
#include "foam_side/flow.hpp"
#include "foam_side/last_answer.hpp"
#include "inletOutletFvPatchFields.H"
#include "transformFvPatchFields.H"

namespace demvof {
namespace {

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
  adjust_outflow(flow, through, flow.p_rgh);
  make_absolute(flow, through);
  forAll(flow.mesh.boundary(), patch) if (!given(patch))
          flux.boundaryFieldRef()[patch] == through.boundaryField()[patch];
}

}  // namespace

tmp<volScalarField> set_response(Flow& flow, const volScalarField& A) {
  PressureSystem& system = flow.pressure_system;
  system.inverse_diagonal.reset();  // first: OpenFOAM maps the field that has the name
  system.inverse_diagonal = std::make_unique<volScalarField>("rAU", 1.0 / A);
  tmp<volScalarField> response(*system.inverse_diagonal);
  if (flow.porosity)
    response = with_boundary("eps", flow.mesh, Foam::dimless, flow.porosity->eps.primitiveField()) *
               *system.inverse_diagonal;  // at its ends, too, that of the cell
  if (flow.source) {
    system.face_drag = std::make_unique<FaceDrag>(flow, A, system.force);
    system.mobility = std::make_unique<surfaceScalarField>("rAUf", system.face_drag->mobility());
  } else {
    system.mobility = std::make_unique<surfaceScalarField>("rAUf", fvc::interpolate(response()));
  }
  return response;
}

tmp<surfaceScalarField> last_answer(const Flow& flow) {
  if (const auto& answer = flow.pressure_system.inverse_diagonal)
    return tmp<surfaceScalarField>::New("rAUf", fvc::interpolate(*answer));
  return surfaceScalarField::New("rAUf", flow.mesh,
                                 dimensionedScalar("one", Foam::dimTime / Foam::dimDensity, 1));
}

tmp<volVectorField> neighbours_velocity(const Flow& flow) {
  const PressureSystem& system = flow.pressure_system;
  return Foam::constrainHbyA(*system.inverse_diagonal * system.momentum->H(), flow.U, flow.p_rgh);
}

tmp<surfaceScalarField> transported_flux(const Flow& flow, const volVectorField& h) {
  tmp<surfaceScalarField> transported = fvc::flux(h) + *flow.pressure_system.memory;
  extras(flow).rotating.makeRelative(transported.ref());
  if (flow.porosity) transported.ref() -= flow.porosity->along;
  return transported;
}

tmp<surfaceScalarField> flux_without_pressure(Flow& flow, const surfaceScalarField& transported) {
  tmp<surfaceScalarField> flux = unforced_flux(flow, transported);
  if (flow.p_rgh.needReference()) balance_boundary(flow, flux.ref());
  flux.ref() += *flow.pressure_system.mobility * flow.face_force();
  return flux;
}

Foam::vectorField own_push(const Flow& flow, const surfaceScalarField& transported,
                           const surfaceScalarField& flux) {
  const FaceDrag& c = *flow.pressure_system.face_drag;
  const scalarField& rAU = flow.pressure_system.inverse_diagonal->primitiveField();
  const scalarField* eps = flow.porosity ? &flow.porosity->eps.primitiveField() : nullptr;
  const tmp<surfaceScalarField> past =  // w
      flow.porosity ? flux - flow.porosity->carried : tmp<surfaceScalarField>(flux);
  return (*flow.reconstruct)([&](const auto& at, label cell) {
    const scalar e = eps ? (*eps)[cell] : 1, k = c.stiffness[cell], w = at(past());
    return rAU[cell] / at(c.response) * (w - at(c.eps_f) * at(transported)) + k * (w - at(c.reference)) / e;
  });
}

tmp<scalarField> rate_to_serve(const Flow& flow) {
  if (flow.porosity->swept)
    return prescribed_growth(flow) - fvc::div(*flow.porosity->swept)().primitiveField();
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

}  // namespace demvof
