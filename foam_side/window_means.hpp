// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "foam_side/flow.hpp"

namespace demvof {

/// Means over the window, weighted with the length of the fluid's steps: of grad p - rho g, Pa/m, of the
/// stress (stress_of_other.hpp), N/m3, and of Du/Dt, m/s2. Registered fields, so that a mesh change maps
/// them.
Foam::vectorField& mean_gradient(Flow& flow);
Foam::vectorField& mean_stress(Flow& flow);
Foam::vectorField& mean_acceleration(Flow& flow);
/// nullptr before the first step, and where they are not asked for.
const Foam::vectorField* find_mean_gradient(const Flow& flow);
const Foam::vectorField* find_mean_stress(const Flow& flow);
const Foam::vectorField* find_mean_acceleration(const Flow& flow);

/// Adds the step just done; the first of a window begins anew. with_laplace_jump: pressure_gradient().
void add_to_window_means(Flow& flow, bool with_laplace_jump, bool with_acceleration);

}  // namespace demvof
