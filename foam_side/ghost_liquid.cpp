// SPDX-License-Identifier: GPL-3.0-or-later
#include "foam_side/ghost_liquid.hpp"

#include "foam_side/flow.hpp"

namespace demvof {

GhostLiquid::GhostLiquid(const Foam::fvMesh& mesh)
    : eps(Foam::IOobject("voidFraction", mesh.time().timeName(), mesh, Foam::IOobject::READ_IF_PRESENT,
                         Foam::IOobject::AUTO_WRITE),
          mesh, dimensionedScalar("one", Foam::dimless, 1), Foam::zeroGradientFvPatchScalarField::typeName),
      flux(Foam::IOobject("solidFlux", mesh.time().timeName(), mesh), mesh,
           dimensionedScalar(Foam::dimVolume / Foam::dimTime, Foam::Zero)) {}

void set_initial_ghost(Flow& flow, const scalarField& eps) {
  if (flow.mesh.dynamic())
    FatalErrorInFunction << "coupling.phase_interchange: volume_adding needs a mesh that does not change"
                         << Foam::exit(Foam::FatalError);
  flow.ghost->eps.primitiveFieldRef() = eps;
  flow.ghost->eps.correctBoundaryConditions();
  add_ghost_density(flow);
}

void set_ghost_target(Flow& flow, const scalarField& eps, const Foam::vectorField& solid_flux_density) {
  GhostLiquid& ghost = *flow.ghost;
  const double window = flow.clock.window_end - flow.time.value();
  const scalarField growth((eps - ghost.eps.primitiveField()) / window);  // d(eps)/dt = div(s)
  volVectorField density(Foam::IOobject("solidFluxDensity", flow.time.timeName(), flow.mesh,
                                        Foam::IOobject::NO_READ, Foam::IOobject::NO_WRITE, false),
                         flow.mesh, Foam::dimensionedVector(Foam::dimVelocity, Foam::Zero),
                         Foam::zeroGradientFvPatchVectorField::typeName);
  density.primitiveFieldRef() = solid_flux_density;
  density.correctBoundaryConditions();
  ghost.flux = fvc::flux(density);
  for (auto& patch : ghost.flux.boundaryFieldRef())
    if (!patch.coupled()) patch == 0;
  const surfaceScalarField anywhere_alike(
      Foam::IOobject("rAUf", flow.time.timeName(), flow.mesh, Foam::IOobject::NO_READ,
                     Foam::IOobject::NO_WRITE, false),
      flow.mesh, dimensionedScalar("one", Foam::dimTime / Foam::dimDensity, 1));
  const scalarField wanted(-growth);
  fit_flux(flow, ghost.flux, anywhere_alike, &wanted, flux_solver(flow, false));
}

void carry_ghost(Flow& flow) {
  volScalarField& eps = flow.ghost->eps;
  const tmp<volScalarField> divergence = fvc::div(flow.ghost->flux);
  eps.primitiveFieldRef() =
      eps.oldTime().primitiveField() + flow.time.deltaTValue() * divergence().primitiveField();
  eps.correctBoundaryConditions();
}

void add_ghost_density(Flow& flow) {
  const volScalarField heavy(flow.ghost->eps * flow.alpha + (1.0 - flow.ghost->eps));  // alpha_3
  flow.rho == heavy* flow.mixture.rho1() + (1.0 - heavy) * flow.mixture.rho2();
}

double density_of(const Flow& flow, int fluid) {
  return (fluid == 0 ? flow.mixture.rho1() : flow.mixture.rho2()).value();
}

double density_between_particles(const Flow& flow, label cell) {
  if (!flow.ghost) return flow.rho[cell];
  const double alpha = flow.alpha[cell];
  return alpha * flow.mixture.rho1().value() + (1 - alpha) * flow.mixture.rho2().value();
}

}  // namespace demvof
