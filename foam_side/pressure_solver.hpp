// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "foam_side/flow.hpp"

namespace demvof {

/// What to say when fvSolution's solver of p_rgh is slow for so large a mesh; empty when it is not.
/// Collective.
std::string slow_pressure_solver(const Flow& flow);

}  // namespace demvof
