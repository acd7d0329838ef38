// SPDX-License-Identifier: GPL-3.0-or-later
// Momentum matrix, and the predictor when PIMPLE asks for one.
//
//   d(eps rho u)/dt + div(eps rho u u) - div(m mu (grad u + grad u^T))
//       = eps (sigma kappa grad alpha - g.x grad rho - grad p_rgh) + force + C (u_ref - u)
//
// m = eps, and with forces.suspension_viscosity mu_r(1 - eps): the stress of the suspension as a whole, for
// which u stands for its mean velocity.
//
// The matrix kept for the pressure corrections holds the left side alone: the force of the particles
// meets the pressure at the faces (face_drag.hpp).
// Without the predictor the pressure corrections alone have to spread the momentum that viscosity carries
// from cell to cell, which they do not once nu dt/dx2 is above 1: then the predictor is on whatever PIMPLE
// says, and with particles from 1/4 on project_velocity.cpp takes over. eps rho u.S is rho_phi of the alpha
// step: mass and momentum are carried alike.

#include "coupler/closures/suspension_viscosity.hpp"
#include "foam_side/extras.hpp"
#include "foam_side/flow.hpp"
#include "foam_side/fluid_books.hpp"
#include "foam_side/open_momentum.hpp"
#include "foam_side/pressure_gradient.hpp"
#include "foam_side/stress_of_other.hpp"
#include "foam_side/viscous_rate.hpp"

namespace demvof {

tmp<volScalarField> stress_share(const Flow& flow) {
  const volScalarField& eps = flow.porosity->eps;
  const SuspensionViscosity law = flow.scene.suspension_viscosity;
  if (law == SuspensionViscosity::none) return eps;
  tmp<volScalarField> share(1.0 * eps);
  const auto replace = [law](scalarField& values) {
    for (scalar& value : values) value = relative_viscosity(law, 1 - value);
  };
  replace(share.ref().primitiveFieldRef());
  for (auto& patch : share.ref().boundaryFieldRef()) replace(patch);
  return share;
}

namespace {

tmp<Foam::fvVectorMatrix> porous_inertia_and_stress(Flow& flow) {
  const volScalarField& eps = flow.porosity->eps;
  // Named rho, so that an interFoam case's scheme for the stress of rho*nuEff is found.
  const volScalarField stress_density(
      Foam::IOobject("rho", flow.time.timeName(), flow.mesh, Foam::IOobject::NO_READ,
                     Foam::IOobject::NO_WRITE, false),
      stress_share(flow) * flow.rho);
  const tmp<Foam::fvVectorMatrix> stress = flow.turbulence->divDevRhoReff(stress_density, flow.U);
  flow.pressure_system.stress.reset(flow.pressure_system.viscous ? new Foam::fvVectorMatrix(stress())
                                                                 : nullptr);
  tmp<Foam::fvVectorMatrix> momentum =
      Foam::fv::EulerDdtScheme<vector>(flow.mesh).fvmDdt(eps, flow.rho, flow.U) +
      fvm::div(flow.rho_phi, flow.U) + stress;
  // After the matrix, which brings the boundary's velocity to the present time.
  if (flow.pimple.finalIter()) note_explicit_stress(flow, stress_density);
  return momentum;
}

tmp<Foam::fvVectorMatrix> inertia_and_stress(Flow& flow) {
  if (flow.porosity) return porous_inertia_and_stress(flow);
  tmp<Foam::fvVectorMatrix> momentum = fvm::ddt(flow.rho, flow.U) + fvm::div(flow.rho_phi, flow.U) +
                                       flow.turbulence->divDevRhoReff(flow.rho, flow.U);
  if (flow.source && flow.pimple.finalIter()) note_explicit_stress(flow, flow.rho);
  if (extras(flow).rotating.active()) momentum.ref() += extras(flow).rotating.DDt(flow.rho, flow.U);
  return momentum;
}

/// Sources of fvOptions: what a volume of fluid gets.
void add_sources(Flow& flow, Foam::fvVectorMatrix& momentum) {
  if (!extras(flow).sources_of_momentum) return;
  tmp<Foam::fvVectorMatrix> sources = extras(flow).sources(flow.rho, flow.U);
  if (flow.porosity) sources.ref() *= flow.porosity->eps.internalField();
  momentum -= sources();
  flow.pressure_system.sources.reset(sources.ptr());
}

/// Lets fvOptions fix values, and see how the velocity answers to a force on the fluid: eps/(A + C); where
/// each correction solves the stress with it, eps/(A_0 + C).
void constrain(Flow& flow, Foam::fvVectorMatrix& momentum) {
  if (!extras(flow).sources_of_momentum) return;
  if (flow.source) note_free_equation(flow, momentum);
  extras(flow).sources.constrain(momentum);
  if (!flow.source) return;
  Foam::fvVectorMatrix answering(momentum);
  const scalarField& volume = flow.mesh.V();
  if (flow.pressure_system.viscous) {
    answering = Foam::fvVectorMatrix(flow.U, momentum.dimensions());
    answering.diag() = volume * flow.rho.primitiveField() / flow.time.deltaTValue();
    if (flow.porosity) answering.diag() *= flow.porosity->eps.primitiveField();
  }
  answering.diag() += volume * flow.source->coefficient.field();
  if (flow.porosity) answering.diag() /= flow.porosity->eps.primitiveField();
  extras(flow).sources.constrain(answering);
}

/// Part of the face velocity of the last step that its cell velocities do not know of, m3/s:
/// (eps rho/A)_f c (u_f - mean(u)).S/dt of the old time, with the weight c of OpenFOAM's ddt scheme. In a
/// zone that rotates there is none.
tmp<surfaceScalarField> flux_memory(const Flow& flow, const volScalarField& response) {
  if (!flow.porosity) {
    const tmp<surfaceScalarField> change =
        flow.face_velocity ? fvc::ddtCorr(flow.U, *flow.face_velocity) : fvc::ddtCorr(flow.U, flow.phi);
    return extras(flow).rotating.zeroFilter(fvc::interpolate(flow.rho * response) * change);
  }
  const volVectorField& U0 = flow.U.oldTime();
  tmp<surfaceScalarField> flux0;  // of the velocity between the particles
  if (flow.face_velocity)
    flux0 = flow.mesh.Sf() & flow.face_velocity->oldTime();
  else
    flux0 = flow.velocity_flux->oldTime();
  const surfaceScalarField unknown(flux0() - fvc::dotInterpolate(flow.mesh.Sf(), U0));
  const auto scheme = Foam::fv::ddtScheme<vector>::New(flow.mesh, flow.mesh.ddtScheme("ddt(U)"));
  return fvc::interpolate(flow.rho * response) / flow.time.deltaT() *
         scheme.ref().fvcDdtPhiCoeff(U0, flux0(), unknown) * unknown;
}

/// Relaxation (diagonal A from A_0) ties the cell velocity to its last iterate, and the face's with it:
/// (1 - A_0/A)_f (u_f - mean(u)).S of the last iterate, m3/s. Without this term the fixed point of the
/// outer correctors would depend on the relaxation factor (Majumdar, Numer. Heat Transfer 13 (1988) 125).
tmp<surfaceScalarField> relaxation_memory(const Flow& flow, const volScalarField& unrelaxed,
                                          const volScalarField& A) {
  tmp<surfaceScalarField> flux = flow.porosity ? velocity_flux_of(flow, flow.phi) : 1.0 * flow.phi;
  fvc::makeAbsolute(flux.ref(), flow.U);
  return fvc::interpolate(1.0 - unrelaxed / A) * (flux - fvc::flux(flow.U));
}

/// Relaxes the momentum matrix if the case asks for it; returns what that adds to the flux, if anything. By
/// 1, as many cases ask, makes the diagonal dominant and no more; the flux hears nothing of it, as in
/// interFoam.
tmp<surfaceScalarField> relax_momentum(Flow& flow, Foam::fvVectorMatrix& momentum) {
  const Foam::word name = flow.U.select(flow.pimple.finalIter());
  if (!flow.mesh.relaxEquation(name)) return {};
  const volScalarField unrelaxed(momentum.A());
  momentum.relax();
  if (flow.mesh.equationRelaxationFactor(name) == 1) return {};
  return relaxation_memory(flow, unrelaxed, momentum.A());
}

/// Whether to solve the equation before the pressure corrections.
bool predicts(Flow& flow) {
  if (!flow.source && flow.pimple.momentumPredictor()) return true;
  const double number = viscous_rate(flow) * flow.time.deltaTValue();
  const bool viscous = flow.source && number > most_of_corrections;
  flow.pressure_system.viscous = viscous;
  if (!viscous && find_gradient_at_kinks(flow)) gradient_at_kinks(flow) = Foam::Zero;
  if (!viscous && find_stress_in_cells(flow)) stress_in_cells(flow) = Foam::Zero;
  static bool said = false;
  if (!said && (flow.pressure_system.viscous || (number > 1 && !flow.pimple.momentumPredictor()))) {
    Foam::Info << (flow.source ? "Momentum solved in each pressure correction where nu dt/dx2 > 0.25"
                               : "Momentum predictor switched on where nu dt/dx2 > 1")
               << " (here " << number << "): without that they do not converge" << Foam::endl;
    said = true;
  }
  if (flow.pressure_system.viscous) return false;  // each correction does
  return flow.pimple.momentumPredictor() || number > 1;
}

}  // namespace

// Not by fvc::reconstruct, whose result shares the memory of its operand behind restrict pointers: compilers
// then form z from a y that is already the result's.
void solve_momentum(Flow& flow) {
  const surfaceScalarField at_faces(flow.face_force() - fvc::snGrad(flow.p_rgh) * flow.mesh.magSf());
  volVectorField::Internal force(Foam::IOobject("force", flow.time.timeName(), flow.mesh), flow.mesh,
                                 Foam::dimForce / Foam::dimVolume,
                                 (*flow.reconstruct)([&](const auto& at, label) { return at(at_faces); }));
  if (flow.pressure_system.viscous) force.field() -= gradient_at_kinks(flow);
  if (flow.porosity) force.field() *= flow.porosity->eps.primitiveField();
  Foam::fvVectorMatrix equation(*flow.pressure_system.momentum == force);
  if (flow.source) {
    const ParticleSource& source = *flow.source;
    const scalarField& volume = flow.mesh.V().field();
    equation.diag() += volume * source.coefficient.field();
    equation.source() +=
        volume * (flow.pressure_system.force + source.coefficient.field() * source.reference.field());
  }
  equation.solve();
}

void predict_momentum(Flow& flow) {
  PressureSystem& system = flow.pressure_system;
  extras(flow).rotating.correctBoundaryVelocity(flow.U);
  system.free_side.reset();
  system.history = {};
  system.correction = 0;
  system.settled = false;
  const bool with_predictor = predicts(flow);
  system.momentum.reset(inertia_and_stress(flow).ptr());
  add_sources(flow, *system.momentum);
  if (flow.source) system.force = flow.source->force.field() + open_momentum(flow) / flow.time.deltaTValue();
  const tmp<surfaceScalarField> lag = relax_momentum(flow, *system.momentum);
  constrain(flow, *system.momentum);
  if (with_predictor) {
    solve_momentum(flow);
    if (extras(flow).sources_of_momentum) extras(flow).sources.correct(flow.U);
  }

  const tmp<volScalarField> response = set_response(flow, system.momentum->A());
  system.memory = std::make_unique<surfaceScalarField>("memory", flux_memory(flow, response()));
  if (lag.valid()) *system.memory += lag;
}

}  // namespace demvof
