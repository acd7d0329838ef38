// SPDX-License-Identifier: GPL-3.0-or-later
// Thick liquids, nu dt/dx2 > 1/4: how momentum and pressure share a correction.
//
// In thinner ones (correct_pressure.cpp) the corrections take the neighbours' part H of the stress from the
// velocity before them. Where viscosity carries momentum across many cells in a step they do not converge,
// and what they leave open has no bound. Here each correction solves the momentum equation, stress and drag
// implicit, with the pressure p* of before,
//
//   M u* = F + C (u_ref - u*) - eps grad p*
//
// makes its flux continuous by a potential, which the inertia A_0 = eps rho/dt and the drag alone resist,
//
//   w = w* - m grad(psi).S
//
// and gives the cells what it gave the faces: u = u* + (w - w*)/(eps |S|), reconstructed. m is what w*
// answers to a pressure once the stress has been solved: the mobility of face_drag.hpp with, in place of A,
// the inertia A_0 of a cell or that of a heavier neighbour to which viscosity ties it. Corrections that count
// with less than half of what answers diverge, with twice it they leave half: gas beside the liquid then
// moves by itself. The stress stays that of u*, fluxes that add
// up to zero; open are what the solver of u* leaves and what psi, which the mean of both sides of a face has
// to bear, leaves of the push. It is the incremental projection (Goda, J. Comput. Phys. 30 (1979) 76), stable
// for any nu dt/dx2. Where another correction follows, the pressure also takes what the stress needs,
//
//   p = p* + psi - (mu/eps) (div(phi*) + d(eps)/dt),   mu: where it jumps, that of the thinner side
//
// without which pressure travels by a cell or so per step (Timmermans et al., Int. J. Numer. Methods Fluids
// 22 (1996) 673). Each side of a face has its own share of psi, -(A_0 + C)/eps2 (w - w*), and of p* what
// face_drag.hpp says.

#include <algorithm>
#include <vector>

#include "foam_side/cell_field.hpp"
#include "foam_side/extras.hpp"
#include "foam_side/flow.hpp"
#include "foam_side/fluid_books.hpp"
#include "foam_side/open_momentum.hpp"
#include "foam_side/pressure_gradient.hpp"

namespace demvof {
namespace {

/// (face_force - grad p_rgh.S), N/m.
tmp<surfaceScalarField> push_of_pressure(const Flow& flow) {
  return flow.face_force() - fvc::snGrad(flow.p_rgh) * flow.mesh.magSf();
}

Foam::vectorField reconstructed(const Flow& flow, const surfaceScalarField& at_faces) {
  return (*flow.reconstruct)([&](const auto& at, label) { return at(at_faces); });
}

tmp<scalarField> void_fraction(const Flow& flow) {
  if (flow.porosity) return flow.porosity->eps.primitiveField();
  return tmp<scalarField>::New(flow.mesh.nCells(), 1.0);
}

/// Flux of u* and p*, m3/s; brings the pressure's gradient at walls to what keeps them closed, and notes what
/// the pressure's gradient has at kinks.
surfaceScalarField predicted_flux(Flow& flow) {
  const PressureSystem& system = flow.pressure_system;
  const surfaceScalarField& mobility = *system.mobility;
  const surfaceScalarField transported(transported_flux(flow, neighbours_velocity(flow)));
  surfaceScalarField flux(flux_without_pressure(flow, transported));
  if (flow.porosity)
    Foam::constrainPressure(flow.p_rgh, flow.porosity->eps, flow.U, flux, mobility);
  else
    Foam::constrainPressure(flow.p_rgh, flow.U, flux, mobility, extras(flow).rotating);
  flux -= mobility * fvc::snGrad(flow.p_rgh) * flow.mesh.magSf();
  const Foam::vectorField push = own_push(flow, transported, flux);
  const scalarField& rAU = system.inverse_diagonal->primitiveField();
  gradient_at_kinks(flow) =
      (system.force - push / rAU) / void_fraction(flow) + reconstructed(flow, push_of_pressure(flow));
  return flux;
}

/// Least dynamic viscosity of a cell and its neighbours, Pa s: with its own, a liquid that meets a gas would
/// push the gas as if that were as thick.
scalarField viscosity_of_thinner_side(const Flow& flow) {
  const tmp<scalarField> mu = dynamic_viscosity(flow);
  scalarField least(mu());
  forAll(flow.mesh.owner(), face) {
    const label owner = flow.mesh.owner()[face], neighbour = flow.mesh.neighbour()[face];
    least[owner] = std::min(least[owner], mu()[neighbour]);
    least[neighbour] = std::min(least[neighbour], mu()[owner]);
  }
  const volScalarField across(with_boundary("mu", flow.mesh, Foam::dimDynamicViscosity, mu()));
  for (const Foam::fvPatchScalarField& at : across.boundaryField()) {
    if (!at.coupled()) continue;
    const scalarField beyond(at.patchNeighbourField());
    forAll(beyond, face) {
      scalar& here = least[at.patch().faceCells()[face]];
      here = std::min(here, beyond[face]);
    }
  }
  return least;
}

/// Inertia that a cell answers with, kg/(m3 s): its own, or that of a heavier neighbour to which viscosity
/// ties it, a I/(a + I).
volScalarField tied_inertia(const Flow& flow) {
  const Foam::fvMesh& mesh = flow.mesh;
  const scalarField& volume = mesh.V();
  scalarField inertia(void_fraction(flow) * flow.rho.primitiveField() / flow.time.deltaTValue());
  const volScalarField mu(with_boundary("mu", mesh, Foam::dimDynamicViscosity, dynamic_viscosity(flow)()));
  const surfaceScalarField stress(fvc::interpolate(mu) * mesh.nonOrthDeltaCoeffs() * mesh.magSf());
  const auto tie = [](scalar& here, scalar a, scalar there) {
    here = std::max(here, a * there / (a + there));
  };
  for (int ring = 0; ring < 3; ++ring) {  // across the cells that a surface takes
    const volScalarField before(with_boundary("inertia", mesh, Foam::dimDensity / Foam::dimTime, inertia));
    forAll(mesh.owner(), face) {
      const label owner = mesh.owner()[face], neighbour = mesh.neighbour()[face];
      tie(inertia[owner], stress[face] / volume[owner], before[neighbour]);
      tie(inertia[neighbour], stress[face] / volume[neighbour], before[owner]);
    }
    forAll(before.boundaryField(), patch) {
      const Foam::fvPatchScalarField& at = before.boundaryField()[patch];
      if (!at.coupled()) continue;
      const scalarField beyond(at.patchNeighbourField());
      forAll(beyond, face) {
        const label cell = at.patch().faceCells()[face];
        tie(inertia[cell], stress.boundaryField()[patch][face] / volume[cell], beyond[face]);
      }
    }
  }
  return with_boundary("inertia", mesh, Foam::dimDensity / Foam::dimTime, inertia);
}

/// Where the case gives the pressure it may depend on the velocity (a total pressure): it stays that of the
/// equation.
void renew_boundary_pressure(Flow& flow) {
  volScalarField::Boundary& boundary = flow.p_rgh.boundaryFieldRef();
  std::vector<scalarField> given(static_cast<std::size_t>(boundary.size()));
  forAll(boundary, patch) given[static_cast<std::size_t>(patch)] = boundary[patch];
  flow.p_rgh.correctBoundaryConditions();
  forAll(boundary, patch) {
    if (boundary[patch].fixesValue()) boundary[patch] == given[static_cast<std::size_t>(patch)];
  }
}

/// Of the equation that u* solves, N/m3. pressure: G of p*.
Foam::vectorField residual(const Flow& flow, const Foam::vectorField& pressure) {
  const ParticleSource& source = *flow.source;
  const Foam::vectorField& U = flow.U.primitiveField();
  return (*flow.pressure_system.momentum & flow.U)().primitiveField() - flow.pressure_system.force -
         source.coefficient.field() * (source.reference.field() - U) + void_fraction(flow) * pressure;
}

}  // namespace

void project_velocity(Flow& flow) {
  const PressureSystem& system = flow.pressure_system;
  const bool last = flow.pimple.corrPISO() == flow.pimple.nCorrPISO();
  for (Foam::fvPatchScalarField& at : flow.p_rgh.boundaryFieldRef())
    if (at.fixesValue() && !at.coupled()) at.evaluate();
  const Foam::vectorField before(gradient_at_kinks(flow) - reconstructed(flow, push_of_pressure(flow)));
  solve_momentum(flow);
  if (flow.pimple.finalIter()) {
    note_boundary_stress(flow);
    note_sources(flow);
  }
  const Foam::vectorField left(residual(flow, before));

  const scalarField eps(void_fraction(flow));
  const scalarField inertia(eps * flow.rho.primitiveField() / flow.time.deltaTValue() +
                            flow.source->coefficient.field());  // A_0 + C
  const volScalarField resistance(with_boundary("resistance", flow.mesh, system.momentum->A()().dimensions(),
                                                scalarField(inertia / Foam::sqr(eps))));
  const surfaceScalarField of_inertia(1.0 / fvc::interpolate(resistance));  // m_0
  const surfaceScalarField mobility(FaceDrag(flow, tied_inertia(flow), system.force).mobility());
  const surfaceScalarField predicted(predicted_flux(flow));
  flow.phi = predicted;
  scalarField rate(flow.mesh.nCells(), 0.0);
  if (flow.porosity) rate = rate_to_serve(flow);
  const scalarField excess(fvc::div(predicted)().primitiveField() + rate);
  const tmp<volScalarField> potential = fit_flux(
      flow, flow.phi, mobility, &rate, flow.mesh.solver(flow.p_rgh.select(last && flow.pimple.finalIter())));

  const surfaceScalarField gained(flow.phi - predicted);
  const Foam::vectorField push = reconstructed(flow, gained);
  const Foam::vectorField of_pressure = reconstructed(flow, of_inertia / mobility * gained);
  flow.U.primitiveFieldRef() += push / eps;
  flow.U.correctBoundaryConditions();
  correct_by_sources(flow, inertia);
  const Foam::vectorField of_potential(inertia / Foam::sqr(eps) * of_pressure);
  own_gradient(flow) = before - of_potential;
  // u of the next correction is solved with it: what holds a bed, felt by the free gas beside it, throws
  // that.
  gradient_at_kinks(flow) += reconstructed(flow, gained / mobility) - of_potential;
  flow.p_rgh += potential();
  if (!last) flow.p_rgh.primitiveFieldRef() -= viscosity_of_thinner_side(flow) / eps * excess;
  renew_boundary_pressure(flow);
  update_face_velocity(flow);
  make_relative(flow, flow.phi);
  if (last && flow.pimple.finalIter())  // until then that of the step before is returned
    open_momentum(flow) = -flow.time.deltaTValue() * (left + inertia / eps * (push - of_pressure));
}

}  // namespace demvof
