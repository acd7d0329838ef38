// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>

namespace demvof {

/// Solid fraction of liquid and gas in a bulk cell that the surface cuts, -, and what had to change fluids,
/// m3.
struct SolidInFluids {
  double liquid = 0, gas = 0, moved = 0;
};

/// What is wet in the liquid, what is dry in the gas: wet / liquid, dry / gas. The surface may have moved
/// since the particles saw it: what would fill its fluid beyond the limit (or the cell's own mean, where that
/// is more) is in the other one, so that the sum is kept; all of it, where its fluid has left the cell. All
/// volumes in m3; liquid, gas >= 0, and one of them > 0.
inline SolidInFluids solid_in_fluids(double wet, double dry, double liquid, double gas, double limit) {
  const double most = std::max(limit, (wet + dry) / (liquid + gas));
  const double too_wet = std::max(wet - most * liquid, 0.0), too_dry = std::max(dry - most * gas, 0.0);
  const auto fraction = [](double solid, double fluid) { return fluid > 0 ? solid / fluid : 0; };
  return {fraction(std::min(wet, most * liquid) + too_dry, liquid),
          fraction(std::min(dry, most * gas) + too_wet, gas), too_wet + too_dry};
}

}  // namespace demvof
