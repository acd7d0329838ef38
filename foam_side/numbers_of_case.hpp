// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <nlohmann/json.hpp>
#include <optional>

#include "coupler/config/parameters.hpp"
#include "coupler/grid/bulk_grid.hpp"
#include "coupler/scene/resolved_numbers.hpp"
#include "foam_side/flow.hpp"

namespace demvof {

/// The first window's numbers; the flow has not moved, so its step is the one it starts with.
ResolvedNumbers resolved_numbers(const CaseParameters& parameters, const Flow& flow, double surface_tension,
                                 const std::optional<BulkGrid>& grid, const nlohmann::json& particles);

}  // namespace demvof
