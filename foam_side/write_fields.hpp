// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>

#include "foam_side/flow.hpp"

namespace demvof {

/// Of the present time, of this rank.
std::filesystem::path time_folder(const Flow& flow);

/// The time folder of the fluid case, of this rank. Throws RunError when a field that belongs there is not,
/// or is cut: OpenFOAM itself looks only whether it could open the files. Collective.
void write_fields(Flow& flow);

}  // namespace demvof
