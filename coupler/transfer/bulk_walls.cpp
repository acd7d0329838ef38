// SPDX-License-Identifier: GPL-3.0-or-later
#include "coupler/transfer/bulk_walls.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <utility>

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

void mirror_at_walls(const BulkGrid& grid, const std::vector<BulkWalls>& walls, const Vec3* positions,
                     KernelWeights& weights) {
  const std::vector<CellId>& cells = weights.cells();
  const Walk walk(grid, cells, walls);
  std::vector<int> slots;
  const auto has_wall = [&walls](int slot) {
    return walls[slot].x > 0 || walls[slot].y > 0 || walls[slot].z > 0;
  };
  for (std::size_t n = 0; n < weights.groups().size(); ++n) {
    const KernelWeights::Group group = weights.groups()[n];
    weights.find_slots(group, slots);
    if (std::none_of(slots.begin(), slots.end(), has_wall)) continue;
    const auto none = static_cast<std::ptrdiff_t>(slots.size());
    const auto entry_of = [&](CellId cell) {
      return std::find_if(slots.begin(), slots.end(), [&](int slot) { return cells[slot] == cell; }) -
             slots.begin();
    };
    double* weight = weights.single(n);
    for (int i = 0; i < group.count; ++i, weight += none) {
      const std::array<int, 3> own = grid.locate(positions[group.first + i]);
      for (std::ptrdiff_t entry = 0; entry < none; ++entry) {
        const CellId end = walk.end(own, grid.ijk(cells[slots[entry]]));
        if (end == cells[slots[entry]]) continue;
        std::ptrdiff_t target = entry_of(end);
        if (target == none) target = entry_of(grid.id(own));  // mirrored farther than the kernel reaches here
        if (target == none) continue;
        weight[target] += std::exchange(weight[entry], 0.0);
      }
    }
  }
}

}  // namespace demvof
