// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>

#include "foam_side/correction_history.hpp"
#include "foam_side/face_drag.hpp"
#include "foam_side/openfoam.hpp"

namespace demvof {

/// What one momentum prediction leaves for its pressure corrections.
struct PressureSystem {
  std::unique_ptr<Foam::fvVectorMatrix> momentum;  // inertia and stress; no particle force
  std::unique_ptr<Foam::fvVectorMatrix> stress;    // what of it is -div(m tau); where viscous
  std::unique_ptr<Foam::fvVectorMatrix> sources;   // what of it fvOptions give; none: nullptr
  Foam::vectorField force;  // of the particles, with what the last step left open, N/m3
  std::unique_ptr<volScalarField> inverse_diagonal;  // 1/A, m3 s/kg
  std::unique_ptr<surfaceScalarField> memory;        // flux carried over from the last step, m3/s
  std::unique_ptr<FaceDrag> face_drag;               // only with particles
  std::unique_ptr<surfaceScalarField> mobility;      // flux per pressure gradient, m3 s/kg
  std::unique_ptr<surfaceScalarField> free_side;     // project_velocity.cpp, of the correction before, N/m
  // project_velocity.cpp, of the present prediction:
  CorrectionHistory history;
  int correction = 0;    // from 1
  bool settled = false;  // this was the last one
  bool viscous = false;  // nu dt/dx2 > 1/4, with particles: project_velocity
};

/// How faces and cells answer to forces; A: diagonal of the momentum matrix per volume, without drag,
/// kg/(m3 s). All but momentum and memory. Returns the answer of the cells, eps/A, m3 s/kg.
tmp<volScalarField> set_response(Flow& flow, const volScalarField& A);

/// mean(H/A).S and memory, less what goes along with the particles, m3/s; h: H/A.
tmp<surfaceScalarField> transported_flux(const Flow& flow, const volVectorField& h);

/// Flux of all forces but the gradient of p_rgh, m3/s. What leaves a box without a pressure boundary is made
/// to fit what enters it. transported: transported_flux.
tmp<surfaceScalarField> flux_without_pressure(Flow& flow, const surfaceScalarField& transported);

/// H/A of the present velocity, at the boundary what the flux there has to be, m/s.
tmp<volVectorField> neighbours_velocity(const Flow& flow);

/// Push of the pressure on each cell as seen from its own side of its faces (face_drag.hpp), with what
/// particles push, m/s. transported: (mean(h) - v).S; flux: of the fluid, in space.
Foam::vectorField own_push(const Flow& flow, const surfaceScalarField& transported,
                           const surfaceScalarField& flux);

/// The rate that the flux being solved has to serve: it moves alpha again in this step if an outer
/// corrector follows, otherwise in the next one.
tmp<scalarField> rate_to_serve(const Flow& flow);

/// The velocity of the faces that goes with flux and velocity. phi is still that in space.
void update_face_velocity(Flow& flow);

/// m of the stress div(m mu (grad u + grad u^T)), predict_momentum.cpp. With porosity.
tmp<volScalarField> stress_share(const Flow& flow);

/// The predictor: all forces, those of the particles implicit in U.
void solve_momentum(Flow& flow);

/// In place of correct_pressure where nu dt/dx2 > 1/4 (project_velocity.cpp).
void project_velocity(Flow& flow);

}  // namespace demvof
