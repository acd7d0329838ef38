// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "foam_side/flow.hpp"

namespace demvof {

/// Between the prediction of momentum and its pressure corrections.
void let_pressure_accelerate_walls(Flow& flow);

}  // namespace demvof
