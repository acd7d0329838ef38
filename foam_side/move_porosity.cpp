// SPDX-License-Identifier: GPL-3.0-or-later
// The void fraction on a mesh that moves through the bulk grid, which stays. The flux relative to the faces
// carries it:
//
//   (eps V)^{n+1} = (eps V)^n - dt sum(phi_r),   phi_r = phi - e u_f.S       e: void fraction at the face
//
// u_f.S dt is the volume that a face sweeps: a uniform eps in a uniform flow stays so to round-off. What the
// particles prescribe is known for the cells as they are at the end of the step, and the flux is made to fit
// once the mesh has moved:
//
//   sum(phi_r) = -((goal V)^{n+1} - (eps V)^n)/dt
//
// and so is the pressure of the step: unlike on a mesh at rest (porosity.cpp) it serves the step itself, as
// nobody knows where the faces will be in the next one.

#include "foam_side/flow.hpp"

namespace demvof {
namespace {

/// A closed box holds as much fluid after the motion as before. What interpolation and full cells
/// (particles_to_fine.cpp) have spoilt of that is spread evenly.
void keep_volume_of_closed_box(const Flow& flow, scalarField& goal) {
  if (!flow.p_rgh.needReference()) return;
  const scalarField& volume = flow.mesh.V().field();
  const double before = Foam::gSum(scalarField(flow.porosity->eps.oldTime() * volumes_before(flow)));
  const double after = Foam::gSum(scalarField(goal * volume)), all = Foam::gSum(volume);
  if (std::abs(after - before) > 1e-6 * all)  // as on a mesh at rest
    FatalErrorInFunction
        << "the mesh that moves, or particles, change the volume of fluid by " << after - before << " m3 of "
        << before
        << " in a box that no pressure boundary opens: give the case an opening; where there "
           "is more fluid now and no wall has given way, particles have left it: are any lost?"
        << Foam::exit(Foam::FatalError);
  goal += (before - after) / all;
}

}  // namespace

const scalarField& volumes_before(const Flow& flow) {
  return flow.mesh.moving() ? flow.mesh.V0().field() : flow.mesh.V().field();
}

tmp<scalarField> prescribed_growth(const Flow& flow) {
  const Porosity& porosity = *flow.porosity;
  const scalarField before(porosity.eps.oldTime().primitiveField() * volumes_before(flow));
  return (porosity.goal.field() - before / flow.mesh.V().field()) / flow.time.deltaTValue();
}

void renew_swept_fluid(Flow& flow) {
  Porosity& porosity = *flow.porosity;
  if (porosity.swept && flow.mesh.moving())
    *porosity.swept = face_void_fraction(porosity.eps) * flow.mesh.phi();
}

void move_porosity(Flow& flow, const scalarField& begin, const scalarField& end) {
  Porosity& porosity = *flow.porosity;
  porosity.eps.oldTime();  // kept here, before anything of this step changes eps
  porosity.rate.field() = (end - begin) / flow.time.deltaTValue();
  porosity.goal.field() = end;
  keep_volume_of_closed_box(flow, porosity.goal.field());
  porosity.eps.primitiveFieldRef() = porosity.goal.field();
  porosity.eps.correctBoundaryConditions();
  follow_solid(flow);
  flow.phi = flux_of(flow, flux_of_face_velocity(flow));
  porosity.swept = std::make_unique<surfaceScalarField>("sweptFluid", 0 * flow.phi);
  renew_swept_fluid(flow);
  make_relative(flow, flow.phi);
  const tmp<scalarField> wanted = prescribed_growth(flow);
  const tmp<volScalarField> divergence = fvc::div(flow.phi);
  const scalarField missed(divergence().primitiveField() + wanted());
  if (Foam::gMax(Foam::mag(missed)()) * flow.time.deltaTValue() > negligible_change)
    fit_flux(flow, flow.phi, projection_mobility(flow), &wanted(), solver_for_rest(flow, missed));
  flow.mixture.correct();
}

}  // namespace demvof
