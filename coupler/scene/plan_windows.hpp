// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "coupler/base/errors.hpp"
#include "coupler/exchange/window_rule.hpp"
#include "coupler/link/window_plan.hpp"
#include "coupler/scene/scene.hpp"

namespace demvof {

/// DEM steps (s) that windows may have. Throws InputError when there is no whole number of them.
inline StepRange step_range(const AdaptiveWindow& window, double dem_step) {
  const StepRange range{std::max(1L, std::lround(std::ceil(window.shortest / dem_step * (1 - 1e-9)))),
                        std::lround(std::floor(window.longest / dem_step * (1 + 1e-9)))};
  if (range.longest < range.shortest)
    throw InputError(
        fmt::format("coupling.window: no whole number of DEM steps of {:.9g} s (the script's timestep) lies "
                    "between shortest, "
                    "{:.9g} s, and longest, {:.9g} s",
                    dem_step, window.shortest, window.longest));
  return range;
}

/// Where windows begin to be counted.
struct RunBegin {
  double time = 0;         // s
  bool continues = false;  // an earlier run
  long windows = 0;        // of that run
};

/// Windows that would have been done by the time (s) at which the fluid of a new run starts; 0 where they
/// have their own lengths. Throws InputError where windows from 0 on do not meet it.
inline long windows_until(double time, const CouplingParameters& coupling, double dem_step) {
  const bool own_lengths = coupling.adaptive_window.has_value();
  const double length = own_lengths ? dem_step : coupling.window, count = std::round(time / length);
  if (time < 0 || std::abs(time / length - count) > 1e-6)
    throw InputError(
        fmt::format("system/controlDict: startTime: {:.9g} s is not a whole number of {} of {:.9g} s from 0 "
                    "on: rename the "
                    "time's folder, to {:.9g} say",
                    time, own_lengths ? "DEM steps" : "windows (coupling.window)", length,
                    length * std::max(0.0, count)));
  if (coupling.end_time < time + 0.5 * length)
    throw InputError(fmt::format(
        "coupling.end_time: {:.9g} s; the fluid starts at {:.9g} s (its controlDict): give a later time",
        coupling.end_time, time));
  return own_lengths ? 0 : std::lround(count);
}

/// What passes between the programs, from what the scene has switched on. dem_step: s.
inline WindowPlan plan_windows(const CaseParameters& parameters, const Scene& scene, double dem_step,
                               const RunBegin& begin = {}) {
  ForceParameters forces = parameters.forces;
  forces.capillary = forces.capillary && scene.surface_tension;
  WindowPlan plan;
  plan.schedule = parameters.coupling.schedule;
  plan.fluids = scene.two_fluids ? 2 : 1;
  plan.gradients = need_gradients(forces);
  plan.mesh_moves = scene.mesh_moves;
  plan.interface = scene.interchange == PhaseInterchange::replacement;
  plan.window = parameters.coupling.window;
  if (plan.own_lengths())
    plan.steps = {dem_step, std::lround(parameters.coupling.end_time / dem_step),
                  std::lround(begin.time / dem_step)};
  else
    plan.windows = std::lround(parameters.coupling.end_time / plan.window);
  plan.windows_before =
      begin.continues ? begin.windows : windows_until(begin.time, parameters.coupling, dem_step);
  plan.continues = begin.continues;
  plan.output_interval = parameters.output.interval;
  return plan;
}

}  // namespace demvof
