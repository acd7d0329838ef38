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

/// What the run that this one continues has done.
struct RunBefore {
  long windows = 0;
  double time = 0;  // s
};

/// What passes between the programs, from what the scene has switched on. dem_step: s.
inline WindowPlan plan_windows(const CaseParameters& parameters, const Scene& scene, double dem_step,
                               const RunBefore& before = {}) {
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
                  std::lround(before.time / dem_step)};
  else
    plan.windows = std::lround(parameters.coupling.end_time / plan.window);
  plan.windows_before = before.windows;
  plan.output_interval = parameters.output.interval;
  return plan;
}

}  // namespace demvof
