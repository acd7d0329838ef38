// SPDX-License-Identifier: GPL-3.0-or-later
// Momentum matrix, and the predictor when PIMPLE asks for one.
//
//   d(eps rho u)/dt + div(eps rho u u) - div(eps mu (grad u + grad u^T)) - force - C (u_ref - u)
//       = eps (sigma kappa grad alpha - g.x grad rho - grad p_rgh)
//
// eps rho u.S is rho_phi of the alpha step: mass and momentum are carried alike.

#include "foam_side/flow.hpp"

namespace demvof {
namespace {

tmp<Foam::fvVectorMatrix> porous_inertia_and_stress(Flow& flow) {
  const volScalarField& eps = flow.porosity->eps;
  // Named rho, so that an interFoam case's scheme for the stress of rho*nuEff is found.
  const volScalarField fluid_density(Foam::IOobject("rho", flow.time.timeName(), flow.mesh,
                                                    Foam::IOobject::NO_READ, Foam::IOobject::NO_WRITE, false),
                                     eps * flow.rho);
  return Foam::fv::EulerDdtScheme<vector>(flow.mesh).fvmDdt(eps, flow.rho, flow.U) +
         fvm::div(flow.rho_phi, flow.U) + flow.turbulence->divDevRhoReff(fluid_density, flow.U);
}

tmp<Foam::fvVectorMatrix> inertia_and_stress(Flow& flow) {
  if (flow.porosity) return porous_inertia_and_stress(flow);
  return fvm::ddt(flow.rho, flow.U) + fvm::div(flow.rho_phi, flow.U) +
         flow.turbulence->divDevRhoReff(flow.rho, flow.U);
}

void add_particle_force(const ParticleSource& source, Foam::fvVectorMatrix& momentum) {
  const scalarField& volume = momentum.psi().mesh().V().field();
  momentum.diag() += volume * source.coefficient.field();
  momentum.source() +=
      volume * (source.force.field() + source.coefficient.field() * source.reference.field());
}

/// eps (face_force - grad p_rgh.S) as a force on the cells, N/m3.
tmp<volVectorField> driving_force(const Flow& flow) {
  tmp<volVectorField> force =
      fvc::reconstruct(flow.face_force() - fvc::snGrad(flow.p_rgh) * flow.mesh.magSf());
  if (flow.porosity) force.ref() *= flow.porosity->eps;
  return force;
}

/// Part of the face flux of the last step that its cell velocities do not know of, m3/s, as it acts on
/// the flux of this step: (eps) (eps rho/A)_f c (u_f - interpolated u).S/dt of the old time.
tmp<surfaceScalarField> flux_memory(const Flow& flow, const volScalarField& mobility,
                                    const surfaceScalarField* eps_f) {
  const volVectorField& U0 = flow.U.oldTime();
  tmp<surfaceScalarField> flux0;  // of the velocity between the particles
  if (flow.face_velocity)
    flux0 = flow.mesh.Sf() & flow.face_velocity->oldTime();
  else if (flow.porosity)
    flux0 = flow.phi.oldTime() / fvc::interpolate(flow.porosity->eps.oldTime());
  else
    flux0 = flow.phi.oldTime();
  const surfaceScalarField unknown(flux0() - fvc::dotInterpolate(flow.mesh.Sf(), U0));
  const auto scheme = Foam::fv::ddtScheme<vector>::New(flow.mesh, flow.mesh.ddtScheme("ddt(U)"));
  tmp<surfaceScalarField> memory = fvc::interpolate(flow.rho * mobility) / flow.time.deltaT() *
                                   scheme.ref().fvcDdtPhiCoeff(U0, flux0(), unknown) * unknown;
  if (eps_f) memory.ref() *= *eps_f;
  return memory;
}

}  // namespace

void predict_momentum(Flow& flow) {
  PressureSystem& system = flow.pressure_system;
  system.momentum.reset(inertia_and_stress(flow).ptr());
  if (flow.source) add_particle_force(*flow.source, *system.momentum);
  system.momentum->relax();
  if (flow.pimple.momentumPredictor()) Foam::solve(*system.momentum == driving_force(flow));

  system.inverse_diagonal = std::make_unique<volScalarField>("rAU", 1.0 / system.momentum->A());
  const volScalarField& rAU = *system.inverse_diagonal;
  if (flow.porosity) {
    const volScalarField mobility("mobility", flow.porosity->eps * rAU);
    system.eps_f = std::make_unique<surfaceScalarField>("eps_f", fvc::interpolate(flow.porosity->eps));
    system.mobility_f =
        std::make_unique<surfaceScalarField>("rAUf", *system.eps_f * fvc::interpolate(mobility));
    system.memory =
        std::make_unique<surfaceScalarField>("memory", flux_memory(flow, mobility, system.eps_f.get()));
  } else {
    system.mobility_f = std::make_unique<surfaceScalarField>("rAUf", fvc::interpolate(rAU));
    system.memory = std::make_unique<surfaceScalarField>("memory", flux_memory(flow, rAU, nullptr));
  }
}

}  // namespace demvof
