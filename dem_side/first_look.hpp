// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "dem_side/dem.hpp"

namespace demvof {

/// What foam_side, which knows the fluid's mesh, judges the start by: some of the particles, the fastest of
/// them, and where the script's walls are (foam_side/first_look.hpp). Collective; complete on rank 0.
nlohmann::json first_look(const Dem& dem);

}  // namespace demvof
