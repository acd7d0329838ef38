// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <nlohmann/json.hpp>
#include <vector>

#include "coupler/grid/bulk_grid.hpp"

namespace demvof {

/// What a rank needs of the states of all ranks when other ranks owned the bulk cells then (restart.cpp).
/// owns: whether a bulk cell is its own now; first: it is rank 0, which gets what is summed over ranks.
/// "flow" stays that of rank 0. Throws nlohmann::json::exception, as the next, when the states are not what
/// was written.
nlohmann::json gathered_state(const std::vector<nlohmann::json>& of_ranks,
                              const std::function<bool(CellId)>& owns, bool first);

/// And of "flow" when the mesh was divided otherwise. fine_cells: for each of its fine cells the number in
/// the mesh of all ranks; as "cell_numbers" in each state. Throws std::out_of_range.
nlohmann::json gathered_flow(const std::vector<nlohmann::json>& of_ranks, const std::vector<int>& fine_cells);

}  // namespace demvof
