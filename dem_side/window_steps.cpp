// SPDX-License-Identifier: GPL-3.0-or-later
#include "dem_side/window_steps.hpp"

#include <fmt/format.h>

#include <cmath>

#include "coupler/base/errors.hpp"

namespace demvof {

int steps_per_window(double window, double time_step) {
  const double steps = window / time_step;
  const double nearest = std::round(steps);
  if (nearest >= 1 && std::abs(steps - nearest) <= 1e-9 * nearest) return static_cast<int>(nearest);
  const double below = std::floor(steps);
  const std::string fitting =
      below >= 1 ? fmt::format("{:.9g} or {:.9g}", below * time_step, (below + 1) * time_step)
                 : fmt::format("{:.9g}", time_step);
  throw InputError(fmt::format(
      "coupling.window: {:.9g} s is not a whole number of DEM steps of {:.9g} s (the script's timestep); "
      "the nearest windows that fit: {} s",
      window, time_step, fitting));
}

}  // namespace demvof
