// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "foam_side/flow.hpp"

namespace demvof {

/// G of the last pressure correction, between particles: the gradient (of p_rgh and density, less surface
/// tension) that pushed each cell from its own side of its faces, Pa/m. A registered field, so that a mesh
/// change maps it.
Foam::vectorField& own_gradient(Flow& flow);
/// nullptr before the first correction, and without particles.
const Foam::vectorField* find_own_gradient(const Flow& flow);

/// What G has beyond the gradient across the faces, where void fraction or drag jump, Pa/m: for the next
/// prediction. Only where nu dt/dx2 > 1/4.
Foam::vectorField& gradient_at_kinks(Flow& flow);
const Foam::vectorField* find_gradient_at_kinks(const Flow& flow);

}  // namespace demvof
