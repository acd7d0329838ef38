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
//   p = p* + psi + mu' div((w - w*)/e),   mu' = mu/(1 + mu |grad e|^2/(eps A')),   mu: where it jumps, that
//   of
//                                         the thinner side
//
// without which pressure travels by a cell or so per step (Timmermans et al., Int. J. Numer. Methods Fluids
// 22 (1996) 673). A push of p must not be answered by more than twice itself. Fluid that moves as a whole
// through a jump of e brings a flux that is not continuous and no stress: what resists it is A', inertia and
// drag, its own or a neighbour's to which viscosity ties the cell, and mu' |grad e|^2 is to stay below that.
// Each side of a face has its own share of psi, -(A_0 + C)/eps2 (w - w*), and of p* what face_drag.hpp says.
// What holds a bed changes the pressure on the free side of its edge with it; there no more of the drag
// counts than what viscosity resists a push with (drag_that_answers).

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

tmp<scalarField> own_inertia(const Flow& flow) {
  return void_fraction(flow) * flow.rho.primitiveField() / flow.time.deltaTValue();
}

/// What a cell answers with, kg/(m3 s): its own resistance, or that of a neighbour with more to which
/// viscosity ties it, a I/(a + I).
volScalarField tied(const Flow& flow, scalarField inertia) {
  const Foam::fvMesh& mesh = flow.mesh;
  const scalarField& volume = mesh.V();
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

/// mean(C/eps2) of a face, as far as a change of it pushes neither side by more than what resists it there:
/// inertia, drag, and the other side's drag to which viscosity ties it.
surfaceScalarField drag_that_answers(const Flow& flow, const scalarField& own) {
  const Foam::fvMesh& mesh = flow.mesh;
  const FaceDrag& c = *flow.pressure_system.face_drag;
  const scalarField& volume = mesh.V();
  surfaceScalarField drag(c.resistance / c.response);
  const scalarField eps(void_fraction(flow));
  const volScalarField mu(
      with_boundary("mu", mesh, Foam::dimDynamicViscosity, scalarField(eps * dynamic_viscosity(flow))));
  const volScalarField resists(with_boundary("inertia", mesh, Foam::dimDensity / Foam::dimTime, own));
  const volScalarField held(
      with_boundary("held", mesh, Foam::dimDensity / Foam::dimTime, flow.source->coefficient.field()));
  const surfaceScalarField stress(fvc::interpolate(mu) * mesh.nonOrthDeltaCoeffs() * mesh.magSf());
  const auto limit = [](scalar& here, scalar least, scalar e, scalar response) {
    here = std::min(here, 2 * least / e * (1 / e + response * here));  // 2: half of a face is the cell's
  };
  const auto resisted = [](scalar inertia, scalar a, scalar there) {
    return inertia + a * there / (a + there + Foam::VSMALL);
  };
  forAll(mesh.owner(), face) {
    const label owner = mesh.owner()[face], neighbour = mesh.neighbour()[face];
    const scalar least =
        std::min(resisted(resists[owner], stress[face] / volume[owner], held[neighbour]),
                 resisted(resists[neighbour], stress[face] / volume[neighbour], held[owner]));
    limit(drag[face], least, c.eps_f[face], c.response[face]);
  }
  const volScalarField volumes(with_boundary("volumes", mesh, Foam::dimVolume, volume));
  forAll(drag.boundaryField(), patch) {
    const Foam::fvPatchScalarField& at = resists.boundaryField()[patch];
    if (!at.coupled()) continue;
    const scalarField here(at.patchInternalField()), there(at.patchNeighbourField());
    const Foam::fvPatchScalarField &drag_at = held.boundaryField()[patch],
                                   &v = volumes.boundaryField()[patch];
    const scalarField held_here(drag_at.patchInternalField()), held_there(drag_at.patchNeighbourField());
    const scalarField v_here(v.patchInternalField()), v_there(v.patchNeighbourField());
    Foam::fvsPatchScalarField& limited = drag.boundaryFieldRef()[patch];
    forAll(limited, face) {
      const scalar a = stress.boundaryField()[patch][face];
      const scalar least = std::min(resisted(here[face], a / v_here[face], held_there[face]),
                                    resisted(there[face], a / v_there[face], held_here[face]));
      limit(limited[face], least, c.eps_f.boundaryField()[patch][face],
            c.response.boundaryField()[patch][face]);
    }
  }
  return drag;
}

/// Beside the edge of a stiff bed the gradient of the pressure on the free side, grad p.S + mean(C/eps2) phi
/// but for what a step does not change, follows from the balance of the face with the stress of before, as if
/// the cell's neighbours were at rest. They are not: it takes the part of the change that viscosity can
/// answer to.
void slow_free_sides(Flow& flow, const scalarField& inertia) {
  PressureSystem& system = flow.pressure_system;
  const FaceDrag& c = *system.face_drag;
  const surfaceScalarField drag(c.resistance / c.response);
  surfaceScalarField found(fvc::snGrad(flow.p_rgh) * flow.mesh.magSf() + drag * flow.phi);
  if (system.free_side && flow.pimple.corrPISO() > 1) {
    const dimensionedScalar tiny("tiny", drag.dimensions(), Foam::VSMALL);
    const surfaceScalarField lag((drag - drag_that_answers(flow, inertia)) / (drag + tiny) *
                                 (*system.free_side - found));
    const scalarField eps(void_fraction(flow));
    gradient_at_kinks(flow) +=
        reconstructed(flow, c.eps_f * lag) / eps -
        flow.source->coefficient.field() / Foam::sqr(eps) * reconstructed(flow, lag / (drag + tiny));
    found += lag;
  }
  system.free_side = std::make_unique<surfaceScalarField>("freeSide", found);
}

/// mu' above, Pa s.
scalarField viscosity_for_pressure(const Flow& flow, const scalarField& resistance) {
  scalarField mu(viscosity_of_thinner_side(flow));
  if (!flow.porosity) return mu;
  const volScalarField& eps = flow.porosity->eps;
  const surfaceScalarField& e = flow.pressure_system.face_drag->eps_f;
  const tmp<volVectorField> slope = fvc::surfaceIntegrate(flow.mesh.Sf() * e);
  return mu / (1 + mu * Foam::magSqr(slope().primitiveField()) /
                       (eps.primitiveField() * tied(flow, resistance).primitiveField()));
}

/// mu' S above, Pa. S: half of the divergence with that of the neighbours; what changes sign from cell to
/// cell in all directions is known to the faces alone, which answer to it twice as much as a smooth one.
scalarField pressure_of_stress(const Flow& flow, const surfaceScalarField& gained,
                               const scalarField& resistance) {
  const tmp<volScalarField> divergence = fvc::div(gained / flow.pressure_system.face_drag->eps_f);
  const volScalarField spread(
      with_boundary("spread", flow.mesh, divergence().dimensions(), divergence().primitiveField()));
  return viscosity_for_pressure(flow, resistance) *
         (0.5 * (spread + fvc::average(fvc::interpolate(spread))))().primitiveField();
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
  if (!find_gradient_at_kinks(flow)) predicted_flux(flow);  // at the start: what it has there already
  const Foam::vectorField before(gradient_at_kinks(flow) - reconstructed(flow, push_of_pressure(flow)));
  solve_momentum(flow);
  if (flow.pimple.finalIter()) {
    note_boundary_stress(flow);
    note_sources(flow);
  }
  const Foam::vectorField left(residual(flow, before));

  const scalarField eps(void_fraction(flow));
  const scalarField own(own_inertia(flow));
  const scalarField inertia(own + flow.source->coefficient.field());  // A_0 + C
  const volScalarField resistance(with_boundary("resistance", flow.mesh, system.momentum->A()().dimensions(),
                                                scalarField(inertia / Foam::sqr(eps))));
  const surfaceScalarField of_inertia(1.0 / fvc::interpolate(resistance));  // m_0
  const surfaceScalarField mobility(FaceDrag(flow, tied(flow, own), system.force).mobility());
  const surfaceScalarField predicted(predicted_flux(flow));
  flow.phi = predicted;
  scalarField rate(flow.mesh.nCells(), 0.0);
  if (flow.porosity) rate = rate_to_serve(flow);
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
  slow_free_sides(flow, inertia);
  if (!last) flow.p_rgh.primitiveFieldRef() += pressure_of_stress(flow, gained, inertia);
  renew_boundary_pressure(flow);
  update_face_velocity(flow);
  make_relative(flow, flow.phi);
  if (last && flow.pimple.finalIter())  // until then that of the step before is returned
    open_momentum(flow) = -flow.time.deltaTValue() * (left + inertia / eps * (push - of_pressure));
}

}  // namespace demvof
