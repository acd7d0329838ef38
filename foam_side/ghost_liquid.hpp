// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Phase interchange `volume_adding` (paper, eqs. 37-42): the particles' volume is filled with liquid that is
// not there ("ghost"), so that one incompressible mixture fills the domain:
//
//   alpha_3 = eps alpha + psi,  psi = 1 - eps       heavy fraction of the whole volume [42]
//   div(j) = 0                                      j: flux of fluid and particles together, the flow's phi
//   d(alpha_3)/dt + div(alpha (j - s) + s) = 0      s: flux of the particles' volume, div(s) = -d(psi)/dt
//   rho = rho_1 alpha_3 + rho_2 (1 - alpha_3)       in the momentum equation, where eps is 1
//
// The paper transports alpha_3 with its eq. 15, by j alone: then the ghost moves with the fluid, not with
// its particle, and alpha = (alpha_3 - psi)/(1 - psi) leaves [0, 1] as soon as the two differ. Here the
// ghost moves with its particle and the liquid with the rest, alpha (j - s); the sum is the equation
// above, and it keeps the liquid. The step is that of the porous alpha equation with j - s as its flux.

#include "foam_side/openfoam.hpp"

namespace demvof {

struct Flow;

struct GhostLiquid {
  explicit GhostLiquid(const Foam::fvMesh& mesh);

  volScalarField eps;       // 1 - psi, "voidFraction", -
  surfaceScalarField flux;  // s, constant in a window, m3/s
};

/// The particles at the start: a state. eps: one value per cell. Throws on a mesh that changes.
void set_initial_ghost(Flow& flow, const scalarField& eps);

/// The particles at the window's end: s from psi v (solid_flux_density, m/s, per cell) and a potential that
/// gives it the divergence of their change. Call after begin_window.
void set_ghost_target(Flow& flow, const scalarField& eps, const Foam::vectorField& solid_flux_density);

/// eps at the end of the step.
void carry_ghost(Flow& flow);

/// rho of the mixture with its ghost.
void add_ghost_density(Flow& flow);

}  // namespace demvof
