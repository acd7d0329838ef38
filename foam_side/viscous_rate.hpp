// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "foam_side/flow.hpp"

namespace demvof {

/// nu/dx2, largest of all faces, 1/s. Collective.
double viscous_rate(const Flow& flow);

/// nu dt/dx2 from which on, with particles, each pressure correction solves the momentum equation: three
/// without would leave a fifth of the stress open.
constexpr double most_of_corrections = 0.25;

}  // namespace demvof
