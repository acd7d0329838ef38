// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "foam_side/flow.hpp"

namespace demvof {

/// What the pressure corrections of a step leave open of its momentum equation, N s/m3. The last one takes
/// the neighbours' part H from the velocity before it,
///
///   A u = H(u_before) + forces
///
/// and H of the new velocity is not what the cells have exchanged among each other: summed over all of them
/// dt (H(u) - H(u_before)) is momentum made from nothing. It belongs to the fluid (fluid_momentum) and is
/// returned as a force in the next step. Where viscosity carries momentum over several cells in a step, more
/// would come of that than was returned: there what the solver of the velocity leaves is all
/// (project_velocity.cpp). With particles. A registered field, so that a mesh change maps it.
Foam::vectorField& open_momentum(Flow& flow);
/// nullptr before the first step, and without particles.
const Foam::vectorField* find_open_momentum(const Flow& flow);

}  // namespace demvof
