// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "coupler/base/vec3.hpp"
#include "coupler/grid/bulk_cells.hpp"

namespace demvof {

/// The bulk fluid where a particle is, at the start of a window.
struct FluidAtParticle {
  Vec3 velocity;             // u, m/s
  Vec3 pressure_gradient;    // Pa/m
  double density = 0;        // rho, kg/m3; 0: there is no fluid here
  double viscosity = 0;      // mu, Pa s
  Vec3 left_over_rate;       // left-over impulse per drag factor, m
  double void_fraction = 1;  // eps, -
  BulkFluidGradients gradients = {};
};

}  // namespace demvof
