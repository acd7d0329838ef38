// SPDX-License-Identifier: GPL-3.0-or-later
#include "coupler/grid/bulk_grid.hpp"

#include <cmath>
#include <stdexcept>
#include <string>

namespace demvof {

BulkGrid::BulkGrid(Vec3 lower, Vec3 upper, std::array<int, 3> cells, std::array<bool, 3> periodic)
    : lower_(lower), upper_(upper), cells_(cells), periodic_(periodic) {
  for (int axis = 0; axis < 3; ++axis) {
    const std::string direction(1, "xyz"[axis]);
    if (cells[axis] < 1)
      throw std::invalid_argument("bulk grid: " + std::to_string(cells[axis]) + " cells along " + direction +
                                  ", at least 1 is needed");
    const double length = upper[axis] - lower[axis];
    if (!(length > 0) || !std::isfinite(length))
      throw std::invalid_argument("bulk grid: the upper corner must lie above the lower corner along " +
                                  direction);
    spacing_[axis] = length / cells[axis];
  }
}

std::array<int, 3> BulkGrid::ijk(CellId cell) const {
  const CellId row = cell / cells_[0];
  return {static_cast<int>(cell % cells_[0]), static_cast<int>(row % cells_[1]),
          static_cast<int>(row / cells_[1])};
}

std::array<int, 3> BulkGrid::locate(const Vec3& point) const {
  std::array<int, 3> ijk;
  for (int axis = 0; axis < 3; ++axis) {
    const int n = cells_[axis];
    double s = (point[axis] - lower_[axis]) / spacing_[axis];
    if (periodic_[axis]) s -= n * std::floor(s / n);
    // In this order a point beyond the range of int, and one that is not a number, get a valid cell too.
    ijk[axis] = s >= n ? n - 1 : s > 0 ? static_cast<int>(s) : 0;
  }
  return ijk;
}

Vec3 BulkGrid::nearest_image(Vec3 point, const Vec3& place) const {
  for (int axis = 0; axis < 3; ++axis) {
    const double period = upper_[axis] - lower_[axis];
    if (periodic_[axis]) point[axis] += period * std::round((place[axis] - point[axis]) / period);
  }
  return point;
}

bool BulkGrid::contains(const Vec3& point) const {
  for (int axis = 0; axis < 3; ++axis)
    if (!(point[axis] >= lower_[axis] && point[axis] <= upper_[axis])) return false;
  return true;
}

Vec3 BulkGrid::cell_lower(const std::array<int, 3>& ijk) const {
  return {lower_.x + ijk[0] * spacing_.x, lower_.y + ijk[1] * spacing_.y, lower_.z + ijk[2] * spacing_.z};
}

Vec3 BulkGrid::cell_centre(const std::array<int, 3>& ijk) const {
  return cell_lower(ijk) + 0.5 * spacing_;
}

CellId BulkGrid::neighbour(const std::array<int, 3>& ijk, int axis, int step) const {
  const int n = cells_[axis];
  std::array<int, 3> moved = ijk;
  moved[axis] += step;
  if (periodic_[axis])
    moved[axis] = (moved[axis] % n + n) % n;
  else if (moved[axis] < 0 || moved[axis] >= n)
    return -1;
  return id(moved);
}

}  // namespace demvof
