// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "foam_side/flow.hpp"

namespace demvof {

/// A vector of each cell that outlives the step: a registered field, so that a mesh change maps it.
/// nullptr before it is first asked for by kept().
const Foam::vectorField* find_kept(const Flow& flow, const char* name);

/// The same; made, with zeros, where it does not exist yet.
Foam::vectorField& kept(Flow& flow, const char* name, const Foam::dimensionSet& dimensions);

}  // namespace demvof
