// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>

#include "coupler/base/vec3.hpp"

namespace demvof {

/// Number of a bulk cell: i + nx (j + ny k), x fastest.
using CellId = std::int64_t;

/// The coarse Cartesian grid on which particles and fluid meet (paper, section 2: the coarse mesh).
class BulkGrid {
 public:
  /// lower, upper: corners of the box, m (lower < upper in every direction).
  /// cells: number of cells per direction, each >= 1. periodic: directions that wrap around.
  /// Throws std::invalid_argument on a box or cell count that makes no grid.
  BulkGrid(Vec3 lower, Vec3 upper, std::array<int, 3> cells, std::array<bool, 3> periodic = {});

  const Vec3& lower() const { return lower_; }
  const Vec3& upper() const { return upper_; }
  const std::array<int, 3>& cells() const { return cells_; }
  const std::array<bool, 3>& periodic() const { return periodic_; }
  /// Edge lengths of a cell, m.
  const Vec3& spacing() const { return spacing_; }
  /// Volume of a cell, m3.
  double cell_volume() const { return spacing_.x * spacing_.y * spacing_.z; }
  CellId cell_count() const { return CellId{cells_[0]} * cells_[1] * cells_[2]; }

  CellId id(const std::array<int, 3>& ijk) const {
    return ijk[0] + CellId{cells_[0]} * (ijk[1] + CellId{cells_[1]} * ijk[2]);
  }
  std::array<int, 3> ijk(CellId cell) const;
  /// Index of the cell that holds the point; points outside go to the nearest cell
  /// (periodic directions wrap).
  std::array<int, 3> locate(const Vec3& point) const;
  bool contains(const Vec3& point) const;
  /// The point, moved by whole periods to where it is nearest to the place.
  Vec3 nearest_image(Vec3 point, const Vec3& place) const;
  Vec3 cell_lower(const std::array<int, 3>& ijk) const;
  Vec3 cell_centre(const std::array<int, 3>& ijk) const;
  /// The neighbour of ijk moved by step along axis, or -1 beyond a wall (periodic directions wrap).
  CellId neighbour(const std::array<int, 3>& ijk, int axis, int step) const;

 private:
  Vec3 lower_, upper_, spacing_;
  std::array<int, 3> cells_;
  std::array<bool, 3> periodic_;
};

}  // namespace demvof
