// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "foam_side/openfoam.hpp"

namespace demvof {

struct Flow;

/// Flux of liquid through every face, mean over the coming alpha step (of the length of time's
/// deltaT), m3/s: the isoAdvector scheme. In cells 0 < alpha < 1 the interface is the plane-like cut of
/// an iso-surface that leaves alpha of the cell on the wet side; it moves with the velocity u between
/// the particles, and a face lets pass (phi: flux of the fluid, m3/s)
///
///   F = phi <wet share of the face during the step>,   phi = eps_f u.S
///
/// elsewhere phi alpha of the upwind cell. Second order for a sharp interface; bounded only as far as
/// the cut is exact: advance_alpha limits it.
/// Source: Roenby, Bredmose & Jasak, R. Soc. Open Sci. 3 (2016) 160405; OpenFOAM's cuts of cells and faces.
tmp<surfaceScalarField> geometric_flux(const Flow& flow, const surfaceScalarField& phi);

/// The whole alpha step as interIsoFoam does it, without particles, also on a mesh that moves: what a cell
/// has too much goes on to those behind it, and what is left of that is cut off. velocity: in space, m/s.
/// Returns the flux of liquid, m3/s.
tmp<surfaceScalarField> advance_by_cuts(Flow& flow, const surfaceScalarField& phi,
                                        const volVectorField& velocity);

}  // namespace demvof
