// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "coupler/exchange/exchange_parameters.hpp"
#include "foam_side/flow.hpp"

namespace demvof {

/// Weight w of each fine cell, per volume, in the force that it takes from a bulk cell and in the velocity
/// that it tells (particles_to_fine.cpp, fluid_to_bulk.cpp): eps rho (every fine cell of a bulk cell gets the
/// same acceleration) or 1.
std::vector<double> sharing_weights(const Flow& flow, Sharing sharing);

}  // namespace demvof
