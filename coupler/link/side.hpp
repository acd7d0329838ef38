// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace demvof {

enum class Side { fluid, particles };
const char* side_name(Side side);     // "fluid", "particles"
const char* program_name(Side side);  // "foam_side", "dem_side"
inline Side partner_of(Side side) {
  return side == Side::fluid ? Side::particles : Side::fluid;
}

}  // namespace demvof
