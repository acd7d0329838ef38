// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace demvof {

/// Number of DEM steps in a window. Throws InputError, naming both values and the nearest windows
/// that fit, when the window is no whole number >= 1 of steps (relative 1e-9).
int steps_per_window(double window, double time_step);

/// Where windows have their own lengths. Throws InputError when the run does not end with a DEM step.
void require_whole_steps(double end_time, double time_step);

}  // namespace demvof
