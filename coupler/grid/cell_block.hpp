// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "coupler/grid/bulk_grid.hpp"

namespace demvof {

/// A dense block of the bulk grid in which cells are marked, then listed, then looked up: the quick way
/// from cell indices to places in a sorted list of cells. It spans what one rank reaches.
class CellBlock {
 public:
  /// Spans the cells with indices first..last in each direction (inside the grid, both included).
  CellBlock(const BulkGrid& grid, const std::array<int, 3>& first, const std::array<int, 3>& last)
      : grid_(grid), first_(first) {
    for (int axis = 0; axis < 3; ++axis) size_[axis] = last[axis] - first[axis] + 1;
    slot_.assign(std::size_t(size_[0]) * size_[1] * size_[2], -1);
  }

  /// Place of a cell in the block; the cell must lie in it. Along x places follow each other.
  std::size_t place(const std::array<int, 3>& ijk) const {
    return (ijk[0] - first_[0]) +
           std::size_t(size_[0]) * ((ijk[1] - first_[1]) + std::size_t(size_[1]) * (ijk[2] - first_[2]));
  }
  /// From a place to that of the next cell along y or z.
  std::ptrdiff_t y_step() const { return size_[0]; }
  std::ptrdiff_t z_step() const { return std::ptrdiff_t(size_[0]) * size_[1]; }
  /// Place of the cell moved by step (-1, 0 or 1 per axis), which must lie in the block; -1 beyond a wall of
  /// the grid (periodic directions wrap).
  std::ptrdiff_t place_beside(std::array<int, 3> ijk, const std::array<int, 3>& step) const {
    for (int axis = 0; axis < 3; ++axis) {
      const int n = grid_.cells()[axis];
      ijk[axis] += step[axis];
      if (grid_.periodic()[axis])
        ijk[axis] = (ijk[axis] + n) % n;
      else if (ijk[axis] < 0 || ijk[axis] >= n)
        return -1;
    }
    return static_cast<std::ptrdiff_t>(place(ijk));
  }
  void mark(std::size_t place) { slot_[place] = 0; }
  /// All marked cells, sorted by number. From here on slot() gives a marked cell's index in this list.
  std::vector<CellId> list_marked() {
    std::vector<CellId> cells;
    std::size_t place = 0;
    for (int k = 0; k < size_[2]; ++k)
      for (int j = 0; j < size_[1]; ++j)
        for (int i = 0; i < size_[0]; ++i, ++place) {
          if (slot_[place] < 0) continue;
          slot_[place] = static_cast<int>(cells.size());
          cells.push_back(grid_.id({first_[0] + i, first_[1] + j, first_[2] + k}));
        }
    return cells;
  }
  /// Index of a cell in the list, -1 for a cell that was not marked.
  int slot(std::size_t place) const { return slot_[place]; }

 private:
  BulkGrid grid_;
  std::array<int, 3> first_, size_;
  std::vector<int> slot_;
};

}  // namespace demvof
