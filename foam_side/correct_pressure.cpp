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
#include "foam_side/fluid_books.hpp"
#include "foam_side/open_momentum.hpp"
#include "foam_side/pressure_gradient.hpp"

namespace demvof {
namespace {

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
  const scalarField& rAU = system.inverse_diagonal->primitiveField();
  const scalarField* eps = flow.porosity ? &flow.porosity->eps.primitiveField() : nullptr;
  const Foam::vectorField push = own_push(flow, transported, flow.phi);
  const Foam::vectorField& reference = flow.source->reference.field();
  const Foam::vectorField& force = flow.pressure_system.force;
  Foam::vectorField& U = flow.U.primitiveFieldRef();
  Foam::vectorField& own = own_gradient(flow);
  forAll(U, cell) {
    const scalar k = system.face_drag->stiffness[cell];
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
  if (system.viscous) return project_velocity(flow);
  const surfaceScalarField& mobility = *system.mobility;

  const volVectorField h(neighbours_velocity(flow));
  const surfaceScalarField transported(transported_flux(flow, h));
  const surfaceScalarField phiHbyA(flux_without_pressure(flow, transported));

  if (flow.porosity)
    Foam::constrainPressure(flow.p_rgh, flow.porosity->eps, flow.U, phiHbyA, mobility);
  else
    Foam::constrainPressure(flow.p_rgh, flow.U, phiHbyA, mobility, extras(flow).rotating);

  bool last = false;
  while (flow.pimple.correctNonOrthogonal()) {
    last = flow.pimple.finalInnerIter();
    Foam::fvScalarMatrix equation(fvm::laplacian(mobility, flow.p_rgh) == fvc::div(phiHbyA));
    if (flow.porosity) equation.source() += flow.mesh.V().field() * rate_to_serve(flow);
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
    if (flow.source)
      correct_by_sources(flow,
                         1 / system.inverse_diagonal->primitiveField() + flow.source->coefficient.field());
    else if (extras(flow).sources_of_momentum)
      extras(flow).sources.correct(flow.U);
  }
  update_face_velocity(flow);
  make_relative(flow, flow.phi);
  if (flow.source && last && flow.pimple.finalIter()) note_open_momentum(flow, h);
}

}  // namespace demvof
