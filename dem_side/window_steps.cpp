// SPDX-License-Identifier: GPL-3.0-or-later
#include "dem_side/window_steps.hpp"

#include <fmt/format.h>

#include <cmath>

#include "coupler/base/errors.hpp"

namespace demvof {

namespace {

/// 0 when there is no whole number of steps.
double whole_steps(double time, double time_step) {
  const double steps = time / time_step, nearest = std::round(steps);
  return nearest >= 1 && std::abs(steps - nearest) <= 1e-9 * nearest ? nearest : 0;
}

/// The nearest times that are.
std::string fitting_times(double time, double time_step) {
  const double below = std::floor(time / time_step);
  return below >= 1 ? fmt::format("{:.9g} or {:.9g}", below * time_step, (below + 1) * time_step)
                    : fmt::format("{:.9g}", time_step);
}

}  // namespace

void require_whole_steps(double end_time, double time_step) {
  if (whole_steps(end_time, time_step) == 0)
    throw InputError(fmt::format(
        "coupling.end_time: {:.9g} s is not a whole number of DEM steps of {:.9g} s (the script's "
        "timestep); the nearest times that fit: {} s",
        end_time, time_step, fitting_times(end_time, time_step)));
}

int steps_per_window(double window, double time_step) {
  if (const double steps = whole_steps(window, time_step); steps > 0) return static_cast<int>(steps);
  throw InputError(fmt::format(
      "coupling.window: {:.9g} s is not a whole number of DEM steps of {:.9g} s (the script's timestep); "
      "the nearest windows that fit: {} s",
      window, time_step, fitting_times(window, time_step)));
}

}  // namespace demvof
