// SPDX-License-Identifier: GPL-3.0-or-later
// Time step from the Courant numbers of controlDict (maxCo, maxAlphaCo, maxDeltaT).
//
//   Co = dt/2 sum_faces |phi| / (eps V)
//
// Without windows interFoam's rule, so that both take the same steps. In a window the steps are equal
// parts of what is left, no longer than the limit; the limit shrinks at once and grows by 1.2 a step.

#include <algorithm>
#include <cmath>

#include "foam_side/flow.hpp"

namespace demvof {
namespace {

constexpr double largest_growth = 1.2;  // of the time step, from step to step

struct CourantRates {
  double anywhere = 0, interface = 0;  // Courant number per second, 1/s
};

CourantRates courant_rates(const Flow& flow) {
  const tmp<volScalarField> throughput = fvc::surfaceSum(Foam::mag(flow.phi));
  scalarField rate(throughput().primitiveField() / flow.mesh.V().field());
  if (flow.porosity) rate /= flow.porosity->eps.primitiveField();
  CourantRates worst;
  forAll(rate, cell) {
    worst.anywhere = std::max(worst.anywhere, rate[cell]);
    const bool interface = flow.alpha[cell] >= 0.01 && flow.alpha[cell] <= 0.99;
    if (interface) worst.interface = std::max(worst.interface, rate[cell]);
  }
  Foam::reduce(worst.anywhere, Foam::maxOp<scalar>());
  Foam::reduce(worst.interface, Foam::maxOp<scalar>());
  return {0.5 * worst.anywhere, 0.5 * worst.interface};
}

struct Limits {
  explicit Limits(const Foam::dictionary& control)
      : adjust(control.lookupOrDefault("adjustTimeStep", false)),
        courant(control.lookupOrDefault<scalar>("maxCo", 1)),
        interface_courant(control.get<scalar>("maxAlphaCo")),
        step(control.lookupOrDefault<scalar>("maxDeltaT", Foam::GREAT)) {}
  bool adjust;
  double courant, interface_courant;
  double step;  // s
};

/// Courant numbers of a step dt from the present flux, recorded in the clock.
void record_courant(Clock& clock, const CourantRates& rates, double dt) {
  clock.courant = rates.anywhere * dt;
  clock.interface_courant = rates.interface * dt;
  clock.largest_courant = std::max(clock.largest_courant, clock.courant);
}

/// How many times longer the step could be.
double room(const Limits& limits, double courant, double interface_courant) {
  return std::min(limits.courant / (courant + Foam::SMALL),
                  limits.interface_courant / (interface_courant + Foam::SMALL));
}

void choose_step_like_interfoam(Flow& flow, const Limits& limits, const CourantRates& rates) {
  const double dt = flow.time.deltaTValue();
  if (!limits.adjust) return;
  const double factor = room(limits, rates.anywhere * dt, rates.interface * dt);
  flow.time.setDeltaT(std::min(std::min({factor, 1.0 + 0.1 * factor, largest_growth}) * dt, limits.step));
}

void choose_step_of_window(Flow& flow, const Limits& limits, const CourantRates& rates) {
  Clock& clock = flow.clock;
  if (limits.adjust)
    clock.limit =
        std::min({largest_growth * clock.limit, room(limits, rates.anywhere, rates.interface), limits.step});
  const double left = clock.window_end - flow.time.value();
  const double parts = std::max(1.0, std::ceil(left / clock.limit * (1 - 1e-9)));
  flow.time.setDeltaT(left / parts, false);
  clock.window_done = parts == 1;
}

}  // namespace

void begin_window(Flow& flow, double t_end) {
  flow.clock.windowed = true;
  flow.clock.window_done = false;
  flow.clock.window_end = t_end;
  if (flow.source)
    flow.source->implicit_impulse =
        Foam::dimensionedVector(flow.source->implicit_impulse.dimensions(), Foam::Zero);
}

bool advance_clock(Flow& flow) {
  const bool running = flow.time.run();  // also runs the function objects of controlDict
  if (flow.clock.windowed ? flow.clock.window_done : !running) return false;

  const Limits limits(flow.time.controlDict());
  const CourantRates rates = courant_rates(flow);
  if (flow.clock.windowed)
    choose_step_of_window(flow, limits, rates);
  else
    choose_step_like_interfoam(flow, limits, rates);
  record_courant(flow.clock, rates, flow.time.deltaTValue());

  ++flow.time;
  ++flow.clock.steps;
  Foam::Info << "\nTime = " << flow.time.timeName() << "  step " << flow.time.deltaTValue() << " s  Courant "
             << flow.clock.courant << ", at the interface " << flow.clock.interface_courant << Foam::endl;
  return true;
}

bool outer_corrector(Flow& flow) {
  return flow.pimple.loop();
}

}  // namespace demvof
