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

}  // namespace demvof
