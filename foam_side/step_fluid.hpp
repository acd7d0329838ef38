// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "foam_side/bridge.hpp"
#include "foam_side/flow.hpp"

namespace demvof {

/// One time step of the fluid, with the void fraction and the sources of its particles (bridge; nullptr:
/// none are there, or not yet); false when there is none left in the window or the run.
bool step_fluid(Flow& flow, Bridge* bridge);

}  // namespace demvof
