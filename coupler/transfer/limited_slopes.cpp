// SPDX-License-Identifier: GPL-3.0-or-later
#include "coupler/transfer/limited_slopes.hpp"

#include <algorithm>

namespace demvof {
namespace {

// A limited slope stays this far (relative) from its bound, so that round-off does not carry it across.
constexpr double round_off = 1e-12;

Vec3 scaled(const Vec3& a, const Vec3& factor) {
  return {a.x * factor.x, a.y * factor.y, a.z * factor.z};
}

/// Largest value of slope . d for d in the box from lower to upper.
double largest_rise(const Vec3& slope, const Vec3& lower, const Vec3& upper) {
  double rise = 0;
  for (int axis = 0; axis < 3; ++axis) rise += std::max(slope[axis] * lower[axis], slope[axis] * upper[axis]);
  return rise;
}

}  // namespace

LimitedSlopes::LimitedSlopes(const BulkGrid& grid, const std::vector<CellId>& cells, const CellBlock& block,
                             const std::vector<double>& volume, const std::vector<Vec3>& centroid,
                             const std::vector<int>& where) {
  const Vec3 h = grid.spacing(), per_cell{1 / h.x, 1 / h.y, 1 / h.z};
  const auto offset = [&](int slot) {  // of the centroid from the cell's centre, in cells
    return scaled(centroid[slot] - grid.cell_centre(grid.ijk(cells[slot])), per_cell);
  };
  cells_.reserve(where.size());
  for (const int slot : where) {
    Surroundings cell;
    cell.slot = slot;
    cell.face.fill(-1);
    const std::array<int, 3> ijk = grid.ijk(cells[slot]);
    cell.to_lower = grid.cell_lower(ijk) - centroid[slot];
    cell.to_upper = cell.to_lower + h;
    const Vec3 own = offset(slot);
    std::array<Vec3, 6> distance;  // between centroids, in cells
    for (int k = -1; k <= 1; ++k)
      for (int j = -1; j <= 1; ++j)
        for (int i = -1; i <= 1; ++i) {
          const int distance_in_faces = std::abs(i) + std::abs(j) + std::abs(k);
          if (distance_in_faces == 0) continue;
          const std::ptrdiff_t place = block.place_beside(ijk, {i, j, k});
          const int other = place < 0 ? -1 : block.slot(place);
          if (other < 0 || volume[other] <= 0) continue;
          cell.around[cell.count++] = other;
          if (distance_in_faces > 1) continue;
          const int face = i != 0 ? (i + 1) / 2 : j != 0 ? 2 + (j + 1) / 2 : 4 + (k + 1) / 2;
          cell.face[face] = other;
          distance[face] = offset(other) - own + Vec3{double(i), double(j), double(k)};
        }
    fit_gradient(cell, distance);
    for (Vec3& gradient : cell.gradient) gradient = scaled(gradient, per_cell);
    cells_.push_back(cell);
  }
}

void LimitedSlopes::fit_gradient(Surroundings& cell, const std::array<Vec3, 6>& distance) {
  // Normal equations A g = sum w d (q - q_c). An axis without neighbours gets no slope; the small term on
  // the diagonal keeps thin cells at the mesh boundary, with nearly parallel distances, from dividing by 0.
  Vec3 a[3];
  for (int face = 0; face < 6; ++face) {
    cell.gradient[face] = {};
    if (cell.face[face] < 0) continue;
    const Vec3& d = distance[face];
    const double weight = 1 / dot(d, d);
    for (int axis = 0; axis < 3; ++axis) a[axis] += weight * d[axis] * d;
  }
  std::array<bool, 3> known;
  for (int axis = 0; axis < 3; ++axis) known[axis] = cell.face[2 * axis] >= 0 || cell.face[2 * axis + 1] >= 0;
  for (int axis = 0; axis < 3; ++axis) {
    for (int other = 0; other < 3; ++other)
      if (other != axis && !(known[axis] && known[other])) a[axis][other] = 0;
    a[axis][axis] = known[axis] ? a[axis][axis] + 1e-13 : 1.0;
  }
  const Vec3 cofactor[3] = {cross(a[1], a[2]), cross(a[2], a[0]), cross(a[0], a[1])};
  const double determinant = dot(a[0], cofactor[0]);
  for (int face = 0; face < 6; ++face) {
    if (cell.face[face] < 0) continue;
    Vec3 d = distance[face];
    const double weight = 1 / dot(d, d) / determinant;
    for (int axis = 0; axis < 3; ++axis)
      if (!known[axis]) d[axis] = 0;
    for (int axis = 0; axis < 3; ++axis) cell.gradient[face][axis] = weight * dot(cofactor[axis], d);
  }
}

Vec3 LimitedSlopes::gradient(const Surroundings& cell, const std::vector<double>& means, int width, int m) {
  const double mean = means[std::size_t(cell.slot) * width + m];
  Vec3 slope;
  for (int face = 0; face < 6; ++face)
    if (cell.face[face] >= 0)
      slope += cell.gradient[face] * (means[std::size_t(cell.face[face]) * width + m] - mean);
  return slope;
}

std::vector<Vec3> LimitedSlopes::gradients(const std::vector<double>& means, int width) const {
  std::vector<Vec3> slopes;
  for (const Surroundings& cell : cells_)
    for (int m = 0; m < width; ++m) slopes.push_back(gradient(cell, means, width, m));
  return slopes;
}

std::vector<Vec3> LimitedSlopes::evaluate(const std::vector<double>& means, int width) const {
  std::vector<Vec3> slopes(cells_.size() * width);
  std::vector<double> lowest(width), highest(width);
  for (std::size_t c = 0; c < cells_.size(); ++c) {
    const Surroundings& cell = cells_[c];
    const double* mean = &means[std::size_t(cell.slot) * width];
    std::copy_n(mean, width, lowest.begin());
    std::copy_n(mean, width, highest.begin());
    for (int n = 0; n < cell.count; ++n) {
      const double* other = &means[std::size_t(cell.around[n]) * width];
      for (int m = 0; m < width; ++m) {
        lowest[m] = std::min(lowest[m], other[m]);
        highest[m] = std::max(highest[m], other[m]);
      }
    }
    for (int m = 0; m < width; ++m) {
      Vec3& slope = slopes[c * width + m];
      if (lowest[m] == mean[m] || highest[m] == mean[m]) continue;  // an extremum, or even: stays flat
      slope = gradient(cell, means, width, m);
      const double rise = largest_rise(slope, cell.to_lower, cell.to_upper);
      const double fall = largest_rise(-slope, cell.to_lower, cell.to_upper);
      const double room_above = highest[m] - mean[m], room_below = mean[m] - lowest[m];
      const double excess = std::max(rise / room_above, fall / room_below);
      if (excess > 1) slope *= (1 - round_off) / excess;
    }
  }
  return slopes;
}

}  // namespace demvof
