// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "foam_side/run_record.hpp"

namespace demvof {

/// Plain VOF: steps and output times as in controlDict, like interFoam, to the case file's end time.
/// Collective.
RunStatus run_alone(Flow& flow, const CaseParameters& parameters, RunRecord& record);

}  // namespace demvof
