// SPDX-License-Identifier: GPL-3.0-or-later
// Corrects a flux by a potential, so that it has a given divergence, with the least impulse:
//
//   phi - M grad(psi).S,   div(M grad psi) = div(phi) + rate
//
// M: mobility of the faces, flux per pressure gradient.

#include <cmath>

#include "foam_side/flow.hpp"

namespace demvof {

tmp<surfaceScalarField> projection_mobility(const Flow& flow) {
  const volScalarField specific_volume("specificVolume", 1.0 / flow.rho);
  if (!flow.source) return flow.time.deltaT() * fvc::interpolate(specific_volume);
  volScalarField inertia("A", flow.rho / flow.time.deltaT());
  if (flow.porosity) inertia *= flow.porosity->eps;
  return FaceDrag(flow, inertia, flow.source->force.field()).mobility();
}

// A void fraction follows the flux it gets and asks for the rest in its next step; nothing does that for
// alpha.
const Foam::dictionary& flux_solver(const Flow& flow, bool to_the_end) {
  return flow.mesh.solver(to_the_end ? "pcorrFinal" : "pcorr");
}

Foam::dictionary solver_for_rest(const Flow& flow, const scalarField& missed) {
  const scalarField& volume = flow.mesh.V().field();
  Foam::dictionary solver(flux_solver(flow, false));
  const double all = Foam::gSumMag(scalarField(flow.porosity->rate.field() * volume));
  const double rest = Foam::gSumMag(scalarField(missed * volume));
  if (rest > 0 && all > 0)
    solver.set("tolerance", solver.lookupOrDefault<scalar>("tolerance", 1e-6) * all / rest);
  return solver;
}

void fit_flux(Flow& flow, const surfaceScalarField& mobility, const scalarField* wanted_rate) {
  // No corrector (nNonOrthogonalCorrectors -1): the flow is a given one, whose case has no solver for this.
  if (flow.pimple.nNonOrthCorr() < 0) return;
  fit_flux(flow, flow.phi, mobility, wanted_rate, flux_solver(flow, wanted_rate == nullptr));
}

void adjust_outflow(Flow& flow, surfaceScalarField& flux, volScalarField& pressure) {
  forAll(flux.boundaryField(), patch) {
    Foam::fvsPatchScalarField& through = flux.boundaryFieldRef()[patch];
    if (through.coupled()) continue;
    const scalarField along(Foam::mag(flow.U.boundaryField()[patch]) *
                            flow.mesh.magSf().boundaryField()[patch]);
    forAll(through, face) if (std::abs(through[face]) < 1e-14 * along[face]) through[face] = 0;
  }
  Foam::adjustPhi(flux, flow.U, pressure);
}

tmp<volScalarField> fit_flux(Flow& flow, surfaceScalarField& flux, const surfaceScalarField& mobility,
                             const scalarField* wanted_rate, const Foam::dictionary& solver) {
  Foam::wordList types(flow.p_rgh.boundaryField().size(), Foam::zeroGradientFvPatchScalarField::typeName);
  forAll(types, patch) {
    if (flow.p_rgh.boundaryField()[patch].fixesValue())
      types[patch] = Foam::fixedValueFvPatchScalarField::typeName;
  }
  tmp<volScalarField> found =
      tmp<volScalarField>::New(Foam::IOobject("pcorr", flow.time.timeName(), flow.mesh), flow.mesh,
                               dimensionedScalar(flow.p_rgh.dimensions(), Foam::Zero), types);
  volScalarField& potential = found.ref();
  flow.mesh.setFluxRequired(potential.name());
  if (potential.needReference()) {  // what the walls displace where they move is not to be made up for
    if (!flow.porosity) make_relative(flow, flux);
    adjust_outflow(flow, flux, potential);
    if (!flow.porosity) make_absolute(flow, flux);
  }

  while (flow.pimple.correctNonOrthogonal()) {
    Foam::fvScalarMatrix equation(fvm::laplacian(mobility, potential) == fvc::div(flux));
    if (wanted_rate) equation.source() += flow.mesh.V().field() * *wanted_rate;
    equation.setReference(Foam::Pstream::master() ? 0 : -1, 0);  // one cell in all, not one of each rank
    equation.solve(solver);
    if (flow.pimple.finalNonOrthogonalIter()) flux -= equation.flux();
  }
  return found;
}

}  // namespace demvof
