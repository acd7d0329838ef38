// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "foam_side/openfoam.hpp"

namespace demvof {

struct Flow;

/// How the velocity of the fluid alone answered to a force in the last step, m3 s/kg; before the first one
/// the same everywhere. The flux on a mesh that has changed is fitted with it, as in interFoam.
tmp<surfaceScalarField> last_answer(const Flow& flow);

}  // namespace demvof
