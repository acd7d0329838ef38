// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <nlohmann/json.hpp>
#include <vector>

#include "coupler/grid/bulk_grid.hpp"

namespace demvof {

/// What one of another number of ranks needs of the states that all ranks have left (restart.cpp).
/// begin, end: the bulk cells that it owns; first: it is rank 0, which gets what is summed over ranks.
/// fine_cells: for each of its fine cells the number in the mesh of all ranks; as "cell_numbers" in each
/// state. Throws nlohmann::json::exception, std::out_of_range when the states are not what was written.
nlohmann::json gathered_state(const std::vector<nlohmann::json>& of_ranks, CellId begin, CellId end,
                              bool first, const std::vector<int>& fine_cells);

}  // namespace demvof
