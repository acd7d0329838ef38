// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "coupler/closures/force_parameters.hpp"
#include "foam_side/flow.hpp"

namespace demvof {

/// Derivatives of the fluid's fields that forces on particles need, one value per cell.
struct FluidGradients {
  Foam::vectorField stress_force;   // the named ones of div tau and sigma kappa grad alpha, N/m3
  Foam::vectorField viscous_force;  // what of it is div tau, N/m3
  Foam::vectorField acceleration;   // Du/Dt of the last time step, m/s2; 0 before the first one
  Foam::vectorField vorticity;      // curl u, 1/s
};

/// Only what a named force asks for is computed, the rest is 0. Call between time steps: flow only lends
/// its velocity to OpenFOAM's stress operator, which takes it as changeable.
FluidGradients fluid_gradients(Flow& flow, const ForceParameters& forces);

/// Du/Dt of the last time step alone, m/s2.
Foam::vectorField fluid_acceleration(const Flow& flow);

}  // namespace demvof
