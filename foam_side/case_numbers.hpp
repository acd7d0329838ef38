// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "foam_side/flow.hpp"

namespace demvof {

/// Numbers of controlDict and fvSolution with which OpenFOAM would spin, divide by zero or leave something
/// unsolved. Throws InputError with file, line, key, value and what is allowed. Before anything is made of
/// them.
void require_numbers_that_can_be(const Foam::Time& time, bool particles);

/// That fvSolution has a solver for all that will be solved. longest_step: that a step may have, s. Throws
/// InputError.
void require_solvers(const Flow& flow, double longest_step);

/// What to say of an fvSolution that has no PIMPLE, or has it under another name; empty otherwise.
std::string pimple_by_default(const Foam::fvMesh& mesh);

}  // namespace demvof
