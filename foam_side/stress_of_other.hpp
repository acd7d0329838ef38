// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "foam_side/flow.hpp"

namespace demvof {

// In the fluid's equation the gas beside a thick liquid is as thick: a face between them has the mean of both
// viscosities, and so has a cell that holds both. What moves there meets the liquid's stress, mu u/dx2, and
// the pressure's gradient balances it, in cells where a sphere that is dry has nothing but the gas's drag to
// hold it. Told that gradient, a bead of 3 mm over 1000 m2/s is thrown by what its own fall of a window has
// displaced, each window farther. So particles in the thinner fluid are told
//
//   grad p - c,   c = (1 - mu_k/mu) div(m tau)/eps
//
// mu_k/mu: of the sums over the cell's faces, with fluid k's own viscosity and with the equation's; at
// most 1. c is 0 in the thicker fluid and where there is only one. The fluid's equation has m of the stress;
// what it has not is what particles are not told either (smeared_weight in the books).
//
// div(m tau) is that of the velocity which the last correction solved for, with what its solver left: a
// difference of large numbers otherwise. It is known where corrections solve the stress
// (project_velocity.cpp). Below nu dt/dx2 = 1/4, where they do not, c is left out.

/// div(m tau)/eps of the last correction, N/m3.
Foam::vectorField& stress_in_cells(Flow& flow);
const Foam::vectorField* find_stress_in_cells(const Flow& flow);

/// 1 - mu_k/mu of each cell, -.
scalarField others_stress_share(const Flow& flow, int k);

/// c of fluid k, N/m3, of a stress in the cells.
Foam::vectorField stress_of_other(const Flow& flow, int k, const Foam::vectorField* stress);

}  // namespace demvof
