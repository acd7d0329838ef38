// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "dem_side/forces.hpp"

namespace demvof {

/// What dem_side states of its script and particles in the handshake, as JSON. unseen_surfaces: those of the
/// script that no wall of the fluid goes along with. Throws InputError when one of them does not move.
/// Collective.
std::string handshake_facts(const Dem& dem, const FluidForces& forces, double largest_solid_fraction,
                            const std::vector<std::string>& unseen_surfaces, int ranks);

}  // namespace demvof
