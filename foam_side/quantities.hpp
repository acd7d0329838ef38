// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <map>
#include <string>

#include "foam_side/flow.hpp"

namespace demvof {

using Quantities = std::map<std::string, double>;

/// The fluid's part of known_quantities (coupler/config/quantities.hpp), over all ranks.
/// Collective over the fluid side.
Quantities fluid_quantities(const Flow& flow);

/// Integral of eps alpha, over all ranks, m3. Collective.
double liquid_volume(const Flow& flow);

/// The corner of the mesh's box from which potential energies count, m.
vector lowest_corner(const Flow& flow);

/// Integral of eps rho u, over all ranks, N s. Collective.
Vec3 fluid_momentum(const Flow& flow);

/// True when particles displace fluid in cells that hold interface.
bool solid_at_interface(const Flow& flow);

}  // namespace demvof
