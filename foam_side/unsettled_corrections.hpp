// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "foam_side/flow.hpp"

namespace demvof {

/// Momentum predictions of a thick liquid (project_velocity.cpp) whose corrections were given up while they
/// still changed the velocity, over the run.
struct UnsettledCorrections {
  double predictions = 0;  // how many
  double most = 0;         // what the last correction of one changed, over the velocity (root mean squares)
};

/// most: what the last correction changed.
void note_unsettled(const Flow& flow, double most);
UnsettledCorrections unsettled_corrections(const Flow& flow);

}  // namespace demvof
