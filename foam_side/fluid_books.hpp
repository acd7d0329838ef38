// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "coupler/base/vec3.hpp"
#include "foam_side/openfoam.hpp"

namespace demvof {

struct Flow;

/// What came to the fluid from outside; this rank's part. Impulses only in runs with particles. It stands in
/// the mesh's registry, where the stages of a step find it.
struct FluidBooks {
  double liquid_inflow = 0;  // through the boundary in the present step, m3/s
  double liquid_in = 0;      // m3
  Vec3 explicit_stress;      // mu (grad u)^T at the boundary, as the present step's equation has it, N
  Vec3 step_shear;           // at the boundary in the present step, without explicit_stress, N
  Vec3 step_carried;         // what else the present step's equation has there, N
  Vec3 step_sources;         // of fvOptions in the present step, N
  Vec3 step_corrections;     // what they gave by changing its velocity, N
  Vec3 weight;               // N s, as the rest
  Vec3 sources;              // of fvOptions
  Vec3 boundary_pressure;    // total pressure: on the fluid, and through it on the particles
  Vec3 boundary_shear;       // viscous
  Vec3 carried_in;           // momentum of what flows through the boundary
  Vec3 surface_tension;      // sum over the cells
};

/// Notes what of the liquid's flux in this step (m3/s) comes in through the boundary.
void note_liquid_flux(Flow& flow, const surfaceScalarField& flux);

/// Notes the part of the stress in the momentum equation of this step that does not wait for its velocity.
void note_explicit_stress(Flow& flow, const volScalarField& density);

/// Notes the step's momentum equation before fvOptions constrain it. With particles.
void note_free_equation(Flow& flow, const Foam::fvVectorMatrix& momentum);

/// Notes what the step's momentum equation has at the boundary with the present velocity.
void note_boundary_stress(Flow& flow);

/// Notes what fvOptions give the step's momentum equation with the present velocity, and what holds it where
/// they constrain it. With particles.
void note_sources(Flow& flow);

/// Lets fvOptions change the velocity, and notes what that takes. answer: force per change of the velocity,
/// kg/(m3 s).
void correct_by_sources(Flow& flow, const scalarField& answer);

/// Enters the step that has just been done.
void keep_books(Flow& flow);

/// What was entered since the last call, over all ranks. Collective.
FluidBooks take_books(Flow& flow);

}  // namespace demvof
