// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>

#include "foam_side/open_momentum.hpp"
#include "foam_side/pressure_gradient.hpp"
#include "foam_side/stress_of_other.hpp"
#include "foam_side/window_means.hpp"

namespace demvof {

/// A vector in each fine cell that a run goes on with, beside the fields that OpenFOAM writes.
struct ContinuedField {
  const char* name;
  const Foam::vectorField* (*find)(const Flow&);  // nullptr: there is none
  Foam::vectorField& (*of)(Flow&);
};
inline constexpr std::array<ContinuedField, 7> continued_fields{
    {{"own_gradient", find_own_gradient, own_gradient},
     {"gradient_at_kinks", find_gradient_at_kinks, gradient_at_kinks},
     {"stress", find_stress_in_cells, stress_in_cells},
     {"open_momentum", find_open_momentum, open_momentum},
     {"mean_gradient", find_mean_gradient, mean_gradient},
     {"mean_stress", find_mean_stress, mean_stress},
     {"mean_acceleration", find_mean_acceleration, mean_acceleration}}};

}  // namespace demvof
