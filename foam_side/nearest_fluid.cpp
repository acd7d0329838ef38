// SPDX-License-Identifier: GPL-3.0-or-later
#include "foam_side/nearest_fluid.hpp"

#include <algorithm>
#include <cmath>

#include "foam_side/openfoam.hpp"
#include "foam_side/rows_of_all_ranks.hpp"

namespace demvof {

std::vector<ForceOnCell> to_nearest_fluid(const BulkGrid& grid, const std::vector<ForceOnCell>& alone,
                                          const std::vector<CellId>& with_fluid) {
  if (!Foam::returnReduce(!alone.empty(), Foam::orOp<bool>())) return {};
  const auto centre = [&grid](CellId cell) { return grid.cell_centre(grid.ijk(cell)); };
  std::vector<ForceOnCell> taken;
  for (ForceOnCell force : on_every_rank(alone)) {
    const Vec3 from = centre(static_cast<CellId>(force.cell));
    double nearest = HUGE_VAL;
    for (const CellId cell : with_fluid)
      if (const double way = norm(grid.nearest_image(centre(cell), from) - from); way < nearest) {
        nearest = way;
        force.cell = static_cast<double>(cell);
      }
    const double least = Foam::returnReduce(nearest, Foam::minOp<double>());
    if (least == HUGE_VAL) continue;
    force.cell = Foam::returnReduce(nearest == least ? force.cell : HUGE_VAL, Foam::minOp<double>());
    taken.push_back(force);
  }
  return taken;
}

}  // namespace demvof
