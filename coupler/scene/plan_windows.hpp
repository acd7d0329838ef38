// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cmath>

#include "coupler/link/window_plan.hpp"
#include "coupler/scene/scene.hpp"

namespace demvof {

/// What passes between the programs, from what the scene has switched on. windows_before: done by the run
/// that this one continues.
inline WindowPlan plan_windows(const CaseParameters& parameters, const Scene& scene, long windows_before) {
  ForceParameters forces = parameters.forces;
  forces.capillary = forces.capillary && scene.surface_tension;
  WindowPlan plan;
  plan.schedule = parameters.coupling.schedule;
  plan.fluids = scene.two_fluids ? 2 : 1;
  plan.gradients = need_gradients(forces);
  plan.interface = scene.interchange == PhaseInterchange::replacement;
  plan.window = parameters.coupling.window;
  plan.windows = std::lround(parameters.coupling.end_time / plan.window);
  plan.windows_before = windows_before;
  plan.output_interval = parameters.output.interval;
  return plan;
}

}  // namespace demvof
