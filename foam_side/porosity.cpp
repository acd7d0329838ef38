// SPDX-License-Identifier: GPL-3.0-or-later
// The void fraction through a window, and the flux that fits it.
//
//   goal(t) = goal(start) + rate (t - start),  rate = (target - goal(start)) / window
// Where the surface cuts bulk cells the goal also follows the surface, step by step: what is wet stays in the
// liquid, what is dry in the gas (particles_to_fine.cpp), and the rate is that of the coming step.
//
//   eps^{n+1} = eps^n - dt div(phi)            carried by the same flux as alpha (advect_interface)
//   div(phi) = -(rate + (goal - eps)/dt)       what continuity asks for
//
// The flux of a step is used by the alpha equation of the next one. When the rate changes, the flux of
// the last step no longer fits: a potential correction, phi - M grad(psi).S with
// div(M grad psi) = div(phi) + rate, anticipates what the pressure of the coming step will do. It serves
// the alpha equation alone: momentum starts from the flux before it (velocity_flux), and the impulse comes
// from the pressure, where particles and walls feel it too.

#include <fmt/format.h>

#include "coupler/base/errors.hpp"
#include "foam_side/flow.hpp"
#include "noSlipFvPatchVectorField.H"
#include "transformFvPatchFields.H"
#include "wallFvPatch.H"

namespace demvof {
namespace {

/// A box without a pressure boundary is full of incompressible fluid and particles: more fluid than before is
/// the room of particles that are gone.
void refuse_change_of_closed_volume(const Flow& flow) {
  if (!flow.p_rgh.needReference()) return;
  const scalarField& rate = flow.porosity->rate.field();
  const scalarField& volume = flow.mesh.V().field();
  const double net = Foam::gSum(scalarField(rate * volume));
  const double total = Foam::gSum(scalarField(Foam::mag(rate) * volume));
  const double round_off = 1e-13 * Foam::gSum(volume) / (flow.clock.window_end - flow.time.value());
  if (net > 1e-6 * total + round_off)
    throw RunError(fmt::format(
        "particles of {:.4g} m3 have left the fluid, in a box that no pressure boundary opens. If they "
        "should not "
        "(lost through a wall, or flown out of the box; the last files of folder particles): a smaller "
        "timestep "
        "in the script, stiffer contacts, walls where the box ends. If they should: give the case an opening",
        net * (flow.clock.window_end - flow.time.value())));
  if (net < -1e-6 * total - round_off)
    FatalErrorInFunction << "particles change the fluid volume by " << net
                         << " m3/s in a box that no pressure boundary opens: give the case an opening"
                         << Foam::exit(Foam::FatalError);
}

/// Fluid passes the patch, and the case says how much: velocity or flow of the fluid alone, outside the bed.
bool flow_is_given(const volVectorField& U, const volScalarField& p_rgh, label patch) {
  const Foam::fvPatchVectorField& velocity = U.boundaryField()[patch];
  if (velocity.coupled() || !velocity.fixesValue() || p_rgh.boundaryField()[patch].fixesValue()) return false;
  if (Foam::isA<Foam::wallFvPatch>(velocity.patch()) || Foam::isA<Foam::noSlipFvPatchVectorField>(velocity) ||
      Foam::isA<Foam::transformFvPatchVectorField>(velocity))
    return false;
  const bool constant = velocity.type() == Foam::fixedValueFvPatchVectorField::typeName;
  return !constant || Foam::gMax(Foam::mag(velocity & velocity.patch().nf())()) > 0;
}

/// What is given at a patch is the flow there, bed or not; elsewhere the bed goes on as it is inside.
Foam::wordList boundary_types(const Foam::fvMesh& mesh) {
  const auto& U = mesh.lookupObject<volVectorField>("U");
  const auto& p_rgh = mesh.lookupObject<volScalarField>("p_rgh");
  Foam::wordList types(U.boundaryField().size(), Foam::zeroGradientFvPatchScalarField::typeName);
  forAll(types, patch) if (flow_is_given(U, p_rgh, patch)) types[patch] =
      Foam::fixedValueFvPatchScalarField::typeName;
  return types;
}

}  // namespace

Porosity::Porosity(const Foam::fvMesh& mesh)
    : eps(Foam::IOobject("voidFraction", mesh.time().timeName(), mesh, Foam::IOobject::READ_IF_PRESENT,
                         Foam::IOobject::AUTO_WRITE),
          mesh, dimensionedScalar("one", Foam::dimless, 1), boundary_types(mesh)),
      goal("voidFractionGoal", eps()),
      rate(Foam::IOobject("voidFractionRate", mesh.time().timeName(), mesh), mesh,
           dimensionedScalar(Foam::dimless / Foam::dimTime, Foam::Zero)),
      solid_velocity(Foam::IOobject("solidVelocity", mesh.time().timeName(), mesh), mesh,
                     Foam::dimensionedVector(Foam::dimVelocity, Foam::Zero)),
      along(Foam::IOobject("alongSolid", mesh.time().timeName(), mesh), mesh,
            dimensionedScalar(Foam::dimVolume / Foam::dimTime, Foam::Zero)),
      carried("carriedBySolid", along) {
  along.setOriented();
  carried.setOriented();
}

void set_initial_porosity(Flow& flow, const scalarField& eps) {
  Porosity& porosity = *flow.porosity;
  porosity.goal.field() = eps;
  porosity.rate.field() = 0;
  porosity.eps.primitiveFieldRef() = eps;
  porosity.eps.correctBoundaryConditions();
  const bool moving = follow_solid(flow, true);
  flow.phi = flux_of(flow, fvc::flux(flow.U));
  const tmp<volScalarField> making_way = fvc::div(porosity.along - porosity.carried);
  fit_flux(flow, projection_mobility(flow), moving ? &making_way().primitiveField() : nullptr);
}

void set_porosity_target(Flow& flow, const scalarField& eps) {
  Porosity& porosity = *flow.porosity;
  porosity.rate.field() = (eps - porosity.goal.field()) / (flow.clock.window_end - flow.time.value());
  if (flow.scene.mesh_moves) return;  // each step fits its own (move_porosity.cpp)
  refuse_change_of_closed_volume(flow);
  if (follow_solid(flow))
    flow.phi = flow.velocity_flux ? flux_of(flow, *flow.velocity_flux)
                                  : flux_of(flow, flow.mesh.Sf() & *flow.face_velocity);
  const tmp<scalarField> wanted = wanted_porosity_rate(flow);
  const tmp<volScalarField> divergence = fvc::div(flow.phi);
  const scalarField missed(divergence().primitiveField() + wanted());
  if (Foam::gMax(Foam::mag(missed)()) * flow.time.deltaTValue() > negligible_change)
    fit_flux(flow, flow.phi, projection_mobility(flow), &wanted(), solver_for_rest(flow, missed));
}

void renew_porosity(Flow& flow, const scalarField& begin, const scalarField& end) {
  const Clock& clock = flow.clock;
  const double now = flow.time.value() - flow.time.deltaTValue();  // the step has not changed eps yet
  const double part = (now - clock.window_begin) / (clock.window_end - clock.window_begin);
  Porosity& porosity = *flow.porosity;
  const scalarField goal((1 - part) * begin + part * end);
  porosity.eps.primitiveFieldRef() += goal - porosity.goal.field();  // keeps what eps lags behind
  porosity.eps.correctBoundaryConditions();
  porosity.goal.field() = goal;
  porosity.rate.field() = (end - begin) / (clock.window_end - clock.window_begin);
}

void follow_surface(Flow& flow, const scalarField& eps) {
  Porosity& porosity = *flow.porosity;
  porosity.rate.field() = (eps - porosity.goal.field()) / flow.time.deltaTValue();
}

void update_porosity(Flow& flow) {
  if (!flow.porosity || flow.scene.mesh_moves) return;
  flow.porosity->eps.oldTime();  // kept here, before anything of this step changes eps
  flow.porosity->goal.field() += flow.porosity->rate.field() * flow.time.deltaTValue();
}

tmp<scalarField> wanted_porosity_rate(const Flow& flow) {
  const Porosity& porosity = *flow.porosity;
  return porosity.rate.field() +
         (porosity.goal.field() - porosity.eps.primitiveField()) / flow.time.deltaTValue();
}

tmp<surfaceScalarField> face_void_fraction(const volScalarField& eps) {
  return 1.0 / fvc::interpolate(1.0 / eps);
}

}  // namespace demvof
