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
//   p = p* + psi + mu div((w - w*)/e)
//
// without which pressure travels by a cell or so per step (Timmermans et al., Int. J. Numer. Methods Fluids
// 22 (1996) 673). By itself that would not converge: fluid that moves as a whole through a jump of e brings a
// flux that is not continuous and no stress, a liquid pushes the gas beside it as if that were as thick. Kept
// so small that it does, it leaves beds to sink 2 to 4 times too fast for hundreds of steps. Few
// patterns do so; the best combination of the corrections so far (correction_history.hpp) goes without them.
// Corrections go on until what the potential brings, whose stress nothing balances yet, is less than
// open_enough of the velocity.
// Each side of a face has its own share of psi, -(A_0 + C)/eps2 (w - w*), and of p* what face_drag.hpp says.
// What holds a bed changes the pressure on the free side of its edge with it; there no more of the drag
// counts than what viscosity resists a push with (drag_that_answers).

#include <algorithm>
#include <cmath>
#include <vector>

#include "foam_side/cell_field.hpp"
#include "foam_side/extras.hpp"
#include "foam_side/flow.hpp"
#include "foam_side/fluid_books.hpp"
#include "foam_side/open_momentum.hpp"
#include "foam_side/pressure_gradient.hpp"
#include "foam_side/stress_of_other.hpp"
#include "foam_side/unsettled_corrections.hpp"

namespace demvof {
namespace {

/// What a correction may bring to the velocity and still be the last: root mean squares. With 0.01 a bed
/// sinks at the settled speed within 1 % from the first steps on.
constexpr double open_enough = 0.01;
/// Beyond the case's nCorrectors. A start from rest takes 7 to 16 where the mesh is even.
constexpr int most_corrections = 40;

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
  if (system.free_side && system.correction > 1) {
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

/// mu S above, Pa. S: half of the divergence with that of the neighbours; what changes sign from cell to
/// cell in all directions is known to the faces alone, which answer to it twice as much as a smooth one.
scalarField pressure_of_stress(const Flow& flow, const surfaceScalarField& gained) {
  const tmp<volScalarField> divergence = fvc::div(gained / flow.pressure_system.face_drag->eps_f);
  const volScalarField spread(
      with_boundary("spread", flow.mesh, divergence().dimensions(), divergence().primitiveField()));
  return dynamic_viscosity(flow) *
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

/// What a correction is given by the one before: pressure, its gradient at walls and at kinks, and the free
/// sides. visit: what to do with each of these values.
template <typename Visit>
void each_given(Flow& flow, const Visit& visit) {
  visit(flow.p_rgh.primitiveFieldRef());
  for (Foam::fvPatchScalarField& at : flow.p_rgh.boundaryFieldRef())
    if (auto* wall = dynamic_cast<Foam::fixedGradientFvPatchScalarField*>(&at)) visit(wall->gradient());
  for (int axis = 0; axis < 3; ++axis) {
    scalarField along(gradient_at_kinks(flow).component(axis));
    visit(along);
    gradient_at_kinks(flow).replace(axis, along);
  }
  if (!flow.pressure_system.free_side) return;  // before the first correction
  surfaceScalarField& free_side = *flow.pressure_system.free_side;
  visit(free_side.primitiveFieldRef());
  for (Foam::fvsPatchScalarField& at : free_side.boundaryFieldRef()) visit(at);
}

scalarField all_given(Flow& flow) {
  Foam::DynamicList<scalar> values;
  each_given(flow, [&values](const scalarField& part) { values.append(part); });
  return scalarField(values);
}

void give(Flow& flow, const scalarField& values) {
  label next = 0;
  each_given(flow, [&](scalarField& part) { forAll(part, i) part[i] = values[next++]; });
  renew_boundary_pressure(flow);
}

/// Changes of the velocity in each cell, such that the sum of squares counts volumes alike.
scalarField weighted(const Flow& flow, const Foam::vectorField& one, const Foam::vectorField& other) {
  Foam::DynamicList<scalar> values(6 * one.size());
  forAll(one, cell) {
    const scalar weight = std::sqrt(flow.mesh.V()[cell]);
    for (int axis = 0; axis < 3; ++axis) {
      values.append(weight * one[cell][axis]);
      values.append(weight * other[cell][axis]);
    }
  }
  return scalarField(values);
}

/// Gives the next correction the best combination of all so far. given, open: of the present one; the first
/// had no free sides of before, and took them from itself.
void combine(Flow& flow, scalarField given, scalarField open, bool next_is_last) {
  scalarField leaves(all_given(flow));
  const label known = given.size();
  given.setSize(leaves.size());
  for (label at = known; at < leaves.size(); ++at) given[at] = leaves[at];
  CorrectionHistory& history = flow.pressure_system.history;
  history.add({std::move(given), std::move(leaves), std::move(open)});
  give(flow, next_is_last ? history.again() : history.next());
}

/// Root mean square of a change over that of the velocity: of the volume or of the mass, the larger one. 0 in
/// a fluid at rest, where the change moves next to nothing in a step.
double part_of_velocity(const Flow& flow, const Foam::vectorField& change) {
  const auto part = [&](const scalarField& weight) {
    const double all = Foam::gSum(scalarField(weight * Foam::magSqr(flow.U.primitiveField())));
    return std::sqrt(Foam::gSum(scalarField(weight * Foam::magSqr(change))) / std::max(all, Foam::VSMALL));
  };
  const scalarField& volume = flow.mesh.V();
  const double moved = std::sqrt(Foam::gAverage(Foam::magSqr(change)())) * flow.time.deltaTValue() /
                       std::cbrt(Foam::gAverage(volume));
  if (moved < negligible_change) return 0;
  return std::max(part(volume), part(volume * flow.rho.primitiveField()));
}

}  // namespace

void project_velocity(Flow& flow) {
  PressureSystem& system = flow.pressure_system;
  ++system.correction;
  const int least = flow.pimple.nCorrPISO(), most = std::max(least, most_corrections);
  const bool may_be_last = system.correction >= least;
  for (Foam::fvPatchScalarField& at : flow.p_rgh.boundaryFieldRef())
    if (at.fixesValue() && !at.coupled()) at.evaluate();
  if (!find_gradient_at_kinks(flow)) predicted_flux(flow);  // at the start: what it has there already
  scalarField given(all_given(flow));
  const Foam::vectorField kinks_given(gradient_at_kinks(flow));
  const Foam::vectorField before(gradient_at_kinks(flow) - reconstructed(flow, push_of_pressure(flow)));
  solve_momentum(flow);
  if (flow.pimple.finalIter()) {
    note_boundary_stress(flow);
    note_sources(flow);
  }
  const Foam::vectorField left(residual(flow, before));

  const scalarField eps(void_fraction(flow));
  if (system.stress)  // stress_of_other.hpp
    stress_in_cells(flow) = (left - (*system.stress & flow.U)().primitiveField()) / eps;
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
  const tmp<volScalarField> potential =
      fit_flux(flow, flow.phi, mobility, &rate,
               flow.mesh.solver(flow.p_rgh.select(may_be_last && flow.pimple.finalIter())));

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
  const Foam::vectorField brought(push / eps);
  const double part = part_of_velocity(flow, brought);
  const bool last = may_be_last && (part < open_enough || system.correction >= most);
  system.settled = last;
  if (last && part >= open_enough) note_unsettled(flow, part);
  if (!last) flow.p_rgh.primitiveFieldRef() += pressure_of_stress(flow, gained);
  renew_boundary_pressure(flow);
  if (!last) {
    const Foam::vectorField by_kinks(eps * system.inverse_diagonal->primitiveField() /
                                     (1 + system.face_drag->stiffness) *
                                     (gradient_at_kinks(flow) - kinks_given));
    combine(flow, std::move(given), weighted(flow, brought, by_kinks), system.correction == most - 1);
  }
  update_face_velocity(flow);
  make_relative(flow, flow.phi);
  if (last && flow.pimple.finalIter())  // until then that of the step before is returned
    open_momentum(flow) = -flow.time.deltaTValue() * (left + inertia / eps * (push - of_pressure));
}

}  // namespace demvof
