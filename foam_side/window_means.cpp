// SPDX-License-Identifier: GPL-3.0-or-later
// What the particles are told of order 2 in the window (coupler/exchange/continuation.hpp) is not what the
// last of the fluid's steps did, but
//
//   sum of dt (grad p - rho g)/dt_w + rho g,   sum of dt Du/Dt/dt_w
//
// over the window's steps. The weight is the present one: a surface that comes by in the window does not
// leave half of the liquid's weight in the gradient that is told with the whole of its density.

#include "foam_side/window_means.hpp"

#include "foam_side/fluid_gradients.hpp"
#include "foam_side/kept_field.hpp"
#include "foam_side/pressure_gradient.hpp"
#include "foam_side/stress_of_other.hpp"

namespace demvof {

namespace {

const char* const gradient_name = "meanPressureGradient";
const char* const stress_name = "meanStressInCells";
const char* const acceleration_name = "meanAcceleration";

}  // namespace

Foam::vectorField& mean_gradient(Flow& flow) {
  return kept(flow, gradient_name, Foam::dimPressure / Foam::dimLength);
}
Foam::vectorField& mean_acceleration(Flow& flow) {
  return kept(flow, acceleration_name, Foam::dimAcceleration);
}
Foam::vectorField& mean_stress(Flow& flow) {
  return kept(flow, stress_name, Foam::dimForce / Foam::dimVolume);
}
const Foam::vectorField* find_mean_stress(const Flow& flow) {
  return find_kept(flow, stress_name);
}
const Foam::vectorField* find_mean_gradient(const Flow& flow) {
  return find_kept(flow, gradient_name);
}
const Foam::vectorField* find_mean_acceleration(const Flow& flow) {
  return find_kept(flow, acceleration_name);
}

void add_to_window_means(Flow& flow, bool with_laplace_jump, bool with_acceleration) {
  const double window = flow.clock.window_end - flow.clock.window_begin, step = flow.time.deltaTValue();
  const bool first = flow.time.value() - step - flow.clock.window_begin < 1e-6 * window;
  const auto add = [&](Foam::vectorField& mean, const Foam::vectorField& value) {
    if (first) mean = Foam::Zero;
    mean += step / window * value;
  };
  add(mean_gradient(flow),
      pressure_gradient(flow, with_laplace_jump) - flow.rho.primitiveField() * flow.g.value());
  if (const Foam::vectorField* stress = find_stress_in_cells(flow)) add(mean_stress(flow), *stress);
  if (with_acceleration) add(mean_acceleration(flow), fluid_acceleration(flow));
}

}  // namespace demvof
