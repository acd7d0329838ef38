// SPDX-License-Identifier: GPL-3.0-or-later
// Faces that move. phi is known in space from the pressure, and has to be known relative
// to the faces to carry alpha:
//
//   phi = (u - u_f).S,   u_f.S dt = volume that the face sweeps in a step
//
// The swept volumes add up to the change of V, so that alpha = 1 stays 1. With Crank-Nicolson u_f is that at
// the end of the step (fvc::meshPhi), as u is. On the moved mesh the flux is the face velocity's, made
// continuous by a potential as in interFoam, if PIMPLE's correctPhi says so. With a void fraction:
// move_porosity.cpp.

#include <algorithm>
#include <cmath>

#include "foam_side/extras.hpp"
#include "foam_side/last_answer.hpp"
#include "wallFvPatch.H"

namespace demvof {
namespace {

bool is_due(const Flow& flow) {
  const MeshMotion motion = extras(flow).motion;
  return motion == MeshMotion::each_corrector || (motion == MeshMotion::each_step && flow.pimple.firstIter());
}

void renew_geometry(Flow& flow) {
  renew_gravity_potential(flow);
  flow.reconstruct = std::make_unique<Reconstruction>(flow.mesh);
  flow.face_force.clear();
  extras(flow).rotating.update();
  if (flow.mesh.topoChanging()) extras(flow).compression.reset();
}

/// Of patches which may have moved.
void renew_given_velocity(Flow& flow) {
  auto& U = flow.U.boundaryFieldRef();
  forAll(U, patch) if (U[patch].fixesValue()) U[patch].initEvaluate();
  forAll(U, patch) if (U[patch].fixesValue()) U[patch].evaluate();
}

bool move_points(Flow& flow) {
  flow.mesh.update();
  if (!flow.mesh.changing()) return false;
  renew_geometry(flow);
  return true;
}

/// A wall that the mesh takes along without knowing of it would let fluid through.
void require_walls_that_go_along(const Flow& flow) {
  constexpr scalar nothing = 1e-8;  // of a face's size, in a step: round-off, where the motion turns back
  const surfaceScalarField& swept = flow.mesh.phi();
  scalar most = 0;
  for (const scalar flux : swept) most = std::max(most, std::abs(flux));
  Foam::reduce(most, Foam::maxOp<scalar>());
  forAll(flow.mesh.boundary(), patch) {
    const Foam::fvPatchVectorField& U = flow.U.boundaryField()[patch];
    const bool open = flow.p_rgh.boundaryField()[patch].fixesValue();  // whatever the mesh calls it
    if (open || !Foam::isA<Foam::wallFvPatch>(U.patch())) continue;
    scalar through = 0;
    forAll(U, face) {
      const scalar area = U.patch().magSf()[face];
      const scalar passing = std::abs((U[face] & U.patch().Sf()[face]) - swept.boundaryField()[patch][face]);
      if (passing * flow.time.deltaTValue() > nothing * std::sqrt(area) * area)
        through = std::max(through, passing);
    }
    if (Foam::returnReduce(through, Foam::maxOp<scalar>()) <= 1e-3 * most) continue;
    FatalErrorInFunction << "U: wall " << U.patch().name()
                         << " moves with the mesh (constant/dynamicMeshDict), "
                         << "and its velocity is that of type " << U.type()
                         << ", which does not know it: movingWallVelocity does"
                         << Foam::exit(Foam::FatalError);
  }
}

void fit_flux_to_moved_mesh(Flow& flow) {
  renew_given_velocity(flow);
  flow.phi = flux_of_face_velocity(flow);
  fit_flux(flow, last_answer(flow), nullptr);
  make_relative(flow, flow.phi);
  flow.mixture.correct();
}

}  // namespace

tmp<surfaceScalarField> flux_of_face_velocity(const Flow& flow) {
  tmp<surfaceScalarField> flux = flow.mesh.Sf() & *flow.face_velocity;
  forAll(flow.U.boundaryField(), patch) {
    const Foam::fvPatchVectorField& U = flow.U.boundaryField()[patch];
    if (U.fixesValue()) flux.ref().boundaryFieldRef()[patch] == (U & U.patch().Sf());
  }
  return flux;
}

void move_mesh(Flow& flow) {
  if (!is_due(flow)) return;
  if (!flow.pimple.firstIter()) update_total_pressure(flow);
  if (move_points(flow) && flow.pimple.dict().lookupOrDefault("correctPhi", true))
    fit_flux_to_moved_mesh(flow);
}

void move_under_particles(Flow& flow) {
  const bool moved = move_points(flow);
  if (flow.mesh.topoChanging())
    FatalErrorInFunction << "constant/dynamicMeshDict: " << flow.mesh.type()
                         << ": with particles points may move, but not come and go"
                         << Foam::exit(Foam::FatalError);
  if (!moved) return;
  renew_given_velocity(flow);
  require_walls_that_go_along(flow);
  if (!flow.porosity) fit_flux_to_moved_mesh(flow);
}

void make_relative(const Flow& flow, surfaceScalarField& flux) {
  if (!flow.porosity)
    fvc::makeRelative(flux, flow.U);
  else if (flow.porosity->swept)
    flux -= *flow.porosity->swept;
}

void make_absolute(const Flow& flow, surfaceScalarField& flux) {
  if (!flow.porosity)
    fvc::makeAbsolute(flux, flow.U);
  else if (flow.porosity->swept)
    flux += *flow.porosity->swept;
}

}  // namespace demvof
