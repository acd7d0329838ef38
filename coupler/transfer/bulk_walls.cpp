// SPDX-License-Identifier: GPL-3.0-or-later
#include "coupler/transfer/bulk_walls.hpp"

#include <algorithm>
#include <array>

namespace demvof {

namespace {

/// From one cell of the grid to others, turned back by walls.
class Walk {
 public:
  Walk(const BulkGrid& grid, const std::vector<CellId>& cells, const std::vector<BulkWalls>& walls)
      : grid_(grid), cells_(cells), walls_(walls) {}

  /// Where the way from a cell to another one ends.
  CellId end(std::array<int, 3> at, const std::array<int, 3>& goal) const {
    for (int axis = 0; axis < 3; ++axis) {
      int steps = offset(at[axis], goal[axis], axis), direction = 1;
      if (steps < 0) steps = -steps, direction = -1;
      for (; steps > 0; --steps) {
        if (blocked(at, axis, direction))
          direction = -direction;  // the mirror image of the cell behind the wall is the one before it
        else
          at = grid_.ijk(grid_.neighbour(at, axis, direction));
      }
    }
    return grid_.id(at);
  }

 private:
  /// In cells, the short way round in a periodic direction.
  int offset(int from, int to, int axis) const {
    const int n = grid_.cells()[axis];
    int steps = to - from;
    if (grid_.periodic()[axis] && 2 * std::abs(steps) > n) steps -= steps > 0 ? n : -n;
    return steps;
  }
  bool blocked(const std::array<int, 3>& from, int axis, int direction) const {
    const CellId to = grid_.neighbour(from, axis, direction);
    if (to < 0) return true;
    const CellId upper = direction > 0 ? to : grid_.id(from);
    const auto place = std::lower_bound(cells_.begin(), cells_.end(), upper);
    return place != cells_.end() && *place == upper && walls_[place - cells_.begin()].towards_lower(axis);
  }

  const BulkGrid& grid_;
  const std::vector<CellId>& cells_;
  const std::vector<BulkWalls>& walls_;
};

}  // namespace

void mirror_at_walls(const BulkGrid& grid, const std::vector<BulkWalls>& walls,
                     const std::vector<Vec3>& positions, KernelWeights& weights) {
  const Walk walk(grid, weights.cells, walls);
  const auto has_wall = [&](int slot) {
    const BulkWalls& here = walls[slot];
    return here.x > 0 || here.y > 0 || here.z > 0;
  };
  for (int particle = 0; particle < weights.particles(); ++particle) {
    const auto first = weights.slot.begin() + weights.first[particle];
    const auto last = weights.slot.begin() + weights.first[particle + 1];
    if (std::none_of(first, last, has_wall)) continue;
    const std::array<int, 3> own = grid.locate(positions[particle]);
    for (auto entry = first; entry != last; ++entry) {
      const CellId end = walk.end(own, grid.ijk(weights.cells[*entry]));
      if (end == weights.cells[*entry]) continue;
      auto target = std::find_if(first, last, [&](int slot) { return weights.cells[slot] == end; });
      if (target == last)  // mirrored farther than the kernel reaches on this side
        target = std::find_if(first, last, [&](int slot) { return weights.cells[slot] == grid.id(own); });
      if (target == last) continue;
      weights.weight[target - weights.slot.begin()] += weights.weight[entry - weights.slot.begin()];
      weights.weight[entry - weights.slot.begin()] = 0;
    }
  }
}

}  // namespace demvof
