// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "coupler/config/parameters.hpp"
#include "coupler/grid/bulk_grid.hpp"
#include "foam_side/flow.hpp"

namespace demvof {

/// What the particles as dem_side states them and the fluid's mesh say of each other before the first step: a
/// sentence for each thing that a run would go through with, and that nobody can have meant: particles
/// outside the mesh, or faster than the windows, walls of the script where the fluid has none. Judged are the
/// box of the mesh and, of more than a thousand particles, some.
/// Throws InputError when no particle is in the fluid, or can come there. Collective over the fluid side.
std::vector<std::string> first_look(const CaseParameters& parameters, const Flow& flow, const BulkGrid& grid,
                                    const nlohmann::json& particles);

}  // namespace demvof
