// SPDX-License-Identifier: GPL-3.0-or-later
// Time step from the Courant numbers of controlDict (maxCo, maxAlphaCo, maxDeltaT; step_limits.hpp).
//
// Without windows interFoam's rule, so that both take the same steps. In a window the steps are equal
// parts of what is left, no longer than the limit; the limit shrinks at once and grows by 1.2 a step.

#include <algorithm>
#include <cmath>

#include "foam_side/flow.hpp"
#include "foam_side/step_limits.hpp"

namespace demvof {
namespace {

constexpr double largest_growth = 1.2;  // of the time step, from step to step

/// Courant numbers of a step dt from the present flux, recorded in the clock.
void record_courant(Clock& clock, const CourantRates& rates, double dt) {
  clock.courant = rates.anywhere * dt;
  clock.interface_courant = rates.interface * dt;
  clock.largest_courant = std::max(clock.largest_courant, clock.courant);
}

void choose_step_like_interfoam(Flow& flow, const StepLimits& limits, const CourantRates& rates) {
  const double dt = flow.time.deltaTValue();
  if (!limits.adjust) return;
  const double factor = limits.room({rates.anywhere * dt, rates.interface * dt});
  flow.time.setDeltaT(std::min(std::min({factor, 1.0 + 0.1 * factor, largest_growth}) * dt, limits.step));
}

void choose_step_of_window(Flow& flow, const StepLimits& limits, const CourantRates& rates) {
  Clock& clock = flow.clock;
  if (limits.adjust) clock.limit = std::min({largest_growth * clock.limit, limits.room(rates), limits.step});
  const double left = clock.window_end - flow.time.value();
  const double parts = std::max(1.0, std::ceil(left / clock.limit * (1 - 1e-9)));
  flow.time.setDeltaT(left / parts, false);
  clock.window_done = parts == 1;
}

}  // namespace

void begin_window(Flow& flow, double t_end) {
  flow.clock.windowed = true;
  flow.clock.window_done = false;
  flow.clock.window_begin = flow.time.value();
  flow.clock.window_end = t_end;
  if (flow.source)
    flow.source->implicit_impulse =
        Foam::dimensionedVector(flow.source->implicit_impulse.dimensions(), Foam::Zero);
}

bool advance_clock(Flow& flow) {
  const bool running = flow.time.run();  // also runs the function objects of controlDict
  if (flow.clock.windowed ? flow.clock.window_done : !running) return false;

  const StepLimits limits(flow.time.controlDict());
  const CourantRates rates = courant_rates(flow);
  if (flow.clock.windowed)
    choose_step_of_window(flow, limits, rates);
  else
    choose_step_like_interfoam(flow, limits, rates);
  record_courant(flow.clock, rates, flow.time.deltaTValue());

  const double now = flow.time.value();
  ++flow.time;
  ++flow.clock.steps;
  if (!flow.clock.windowed) set_gravity(flow, flow.gravity.mean(now, flow.time.value()));
  Foam::Info << "\nTime = " << flow.time.timeName() << "  step " << flow.time.deltaTValue() << " s  Courant "
             << flow.clock.courant << ", at the interface " << flow.clock.interface_courant << Foam::endl;
  return true;
}

}  // namespace demvof
