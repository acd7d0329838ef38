// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "coupler/config/parameters.hpp"
#include "coupler/grid/bulk_grid.hpp"
#include "foam_side/flow.hpp"
#include "foam_side/refinement.hpp"

namespace demvof {

/// How the fine mesh refines itself: as the case file says, or as the fluid case's own dynamicMeshDict does.
struct MeshRefinement {
  std::optional<RefinementParameters> parameters;
  bool by_case = false;
};

/// What is said of a fluid case, with or without particles, before it starts. Throws InputError or
/// Foam::error for what it cannot go on with. continues: an earlier run. gravity: of the case, m/s2.
/// Collective.
std::vector<std::string> fluid_advice(const Flow& flow, const MeshRefinement& refinement, bool paired,
                                      bool continues, const Vec3& gravity, double surface_tension,
                                      double step, int ranks);

/// The same of what the case and the particles say of each other. particles: dem_side's facts.
std::vector<std::string> pair_advice(const Flow& flow, const CaseParameters& parameters, const BulkGrid& grid,
                                     const nlohmann::json& particles, bool continues);

}  // namespace demvof
