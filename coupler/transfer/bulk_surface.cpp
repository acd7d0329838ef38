// SPDX-License-Identifier: GPL-3.0-or-later
#include "coupler/transfer/bulk_surface.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "coupler/base/sphere.hpp"

namespace demvof {
namespace {

/// A bulk cell near a sphere.
struct NearCell {
  BulkSurface surface;
  Vec3 centre;         // in the sphere's own period, m
  double overlap = 0;  // with the box of two radii around the sphere, m3
};

/// The bulk cells within two radii of a sphere, along each axis with indices that may lie beyond a period or
/// a wall.
class Neighbourhood {
 public:
  Neighbourhood(const BulkGrid& grid, const Vec3& position, double radius,
                const std::function<BulkSurface(CellId)>& cell_of)
      : spacing_(grid.spacing()), lower_(grid.lower()) {
    for (int axis = 0; axis < 3; ++axis) {
      first_[axis] = index(position[axis] - 2 * radius, axis);
      size_[axis] = index(position[axis] + 2 * radius, axis) - first_[axis] + 1;
    }
    for (int k = 0; k < size_[2]; ++k)
      for (int j = 0; j < size_[1]; ++j)
        for (int i = 0; i < size_[0]; ++i) {
          std::array<int, 3> ijk{first_[0] + i, first_[1] + j, first_[2] + k};
          NearCell cell;
          cell.overlap = 1;
          for (int axis = 0; axis < 3; ++axis) {
            const double low = lower_[axis] + ijk[axis] * spacing_[axis];
            cell.overlap *= std::min(low + spacing_[axis], position[axis] + 2 * radius) -
                            std::max(low, position[axis] - 2 * radius);
            const int n = grid.cells()[axis];
            // Beyond a wall the surface goes on as in the cell beside it.
            const int inside =
                grid.periodic()[axis] ? ((ijk[axis] % n) + n) % n : std::clamp(ijk[axis], 0, n - 1);
            const int seen_from = grid.periodic()[axis] ? ijk[axis] : inside;
            cell.centre[axis] = lower_[axis] + (seen_from + 0.5) * spacing_[axis];
            ijk[axis] = inside;
          }
          cell.surface = cell_of(grid.id(ijk));
          cells_.push_back(cell);
        }
  }

  const std::vector<NearCell>& cells() const { return cells_; }
  int index(double coordinate, int axis) const {
    return static_cast<int>(std::floor((coordinate - lower_[axis]) / spacing_[axis]));
  }
  double face(int index, int axis) const { return lower_[axis] + index * spacing_[axis]; }
  const NearCell& at(std::array<int, 3> ijk) const {
    for (int axis = 0; axis < 3; ++axis) ijk[axis] = std::clamp(ijk[axis] - first_[axis], 0, size_[axis] - 1);
    return cells_[ijk[0] + size_[0] * (ijk[1] + size_[1] * ijk[2])];
  }

 private:
  Vec3 spacing_, lower_;
  std::array<int, 3> first_{}, size_{};
  std::vector<NearCell> cells_;
};

/// Length of the part of a line along an axis, from low to high, that is below the cell's plane. at: a point
/// of it.
double wet_length(const NearCell& cell, Vec3 at, int axis, double low, double high) {
  if (!is_cut(cell.surface)) return cell.surface.liquid_fraction > 0.5 ? high - low : 0;
  const Vec3 from_centre = at - cell.centre;
  const double slope = cell.surface.normal[axis];
  const double rest = cell.surface.offset - dot(cell.surface.normal, from_centre) + slope * from_centre[axis];
  // liquid where slope (z - z_c) < rest
  if (std::abs(slope) < 1e-12) return rest > 0 ? high - low : 0;
  const double crossing = cell.centre[axis] + rest / slope;
  return slope > 0 ? std::clamp(crossing - low, 0.0, high - low)
                   : std::clamp(high - crossing, 0.0, high - low);
}

struct GaussPoint {
  double place, weight;
};
// Gauss-Legendre on [0, 1]; Abramowitz and Stegun, table 25.4, n = 12.
const std::array<GaussPoint, 12>& gauss_points() {
  static const std::array<GaussPoint, 12> points = [] {
    constexpr std::array<GaussPoint, 6> half{{{0.125233408511469, 0.249147045813403},
                                              {0.367831498998180, 0.233492536538355},
                                              {0.587317954286617, 0.203167426723066},
                                              {0.769902674194305, 0.160078328543346},
                                              {0.904117256370475, 0.106939325995318},
                                              {0.981560634246719, 0.047175336386512}}};
    std::array<GaussPoint, 12> all{};
    for (std::size_t i = 0; i < 6; ++i) {
      all[2 * i] = {0.5 + 0.5 * half[i].place, 0.5 * half[i].weight};
      all[2 * i + 1] = {0.5 - 0.5 * half[i].place, 0.5 * half[i].weight};
    }
    return all;
  }();
  return points;
}

/// A line through the unit sphere along an axis, with its place on the other two.
struct Column {
  double across[2], half_length, weight;  // weight: times the length, proportional to half_length
};
constexpr int angles = 16;
const std::array<Column, 12 * angles>& columns() {
  static const std::array<Column, 12 * angles> columns = [] {
    std::array<Column, 12 * angles> all{};
    auto* next = all.begin();
    for (const GaussPoint& s : gauss_points())
      for (int m = 0; m < angles; ++m) {
        const double r = std::sqrt(1 - s.place * s.place), angle = 2 * pi * (m + 0.5) / angles;
        *next++ = {{r * std::cos(angle), r * std::sin(angle)}, s.place, s.weight * s.place};
      }
    return all;
  }();
  return columns;
}

double wetted_share(const Neighbourhood& near, const Vec3& position, double radius, int axis) {
  const int across[] = {(axis + 1) % 3, (axis + 2) % 3};
  double wet = 0, whole = 0;
  for (const Column& column : columns()) {
    std::array<double, 3> point{position.x, position.y, position.z};
    point[across[0]] += radius * column.across[0];
    point[across[1]] += radius * column.across[1];
    const double bottom = point[axis] - radius * column.half_length;
    const double top = point[axis] + radius * column.half_length;
    std::array<int, 3> ijk{};
    for (const int other : across) ijk[other] = near.index(point[other], other);
    const Vec3 at{point[0], point[1], point[2]};
    for (int i = near.index(bottom, axis); near.face(i, axis) < top; ++i) {
      const double low = std::max(bottom, near.face(i, axis)), high = std::min(top, near.face(i + 1, axis));
      if (high <= low) continue;
      ijk[axis] = i;
      wet += column.weight * wet_length(near.at(ijk), at, axis, low, high);
    }
    whole += column.weight * (top - bottom);
  }
  return wet / whole;
}

/// Edges of a box as the normal sees them, the longest first; the plane does not feel those that are nearly
/// 0.
struct Extents {
  Extents(const Vec3& normal, const Vec3& edges)
      : m{std::abs(normal.x) * edges.x, std::abs(normal.y) * edges.y, std::abs(normal.z) * edges.z} {
    std::sort(m.begin(), m.end(), std::greater<>());
    while (count < 3 && m[count] > 1e-4 * m[0]) ++count;
    for (int i = 0; i < count; ++i) sum += m[i];
  }
  std::array<double, 3> m;
  int count = 0;
  double sum = 0;
};

/// Share below the plane at d above the lowest corner: the sum over the corners of (-1)^k (d - corner)^n /
/// (n! m..).
double share_below(const Extents& box, double d) {
  if (d <= 0) return 0;
  if (d >= box.sum) return 1;
  double sum = 0, scale = 1;
  for (int i = 0; i < box.count; ++i) scale *= (i + 1) * box.m[i];
  for (int corner = 0; corner < 1 << box.count; ++corner) {
    double height = d;
    int sign = 1;
    for (int i = 0; i < box.count; ++i)
      if (corner >> i & 1) {
        height -= box.m[i];
        sign = -sign;
      }
    if (height > 0) sum += sign * std::pow(height, box.count);
  }
  return std::clamp(sum / scale, 0.0, 1.0);
}

}  // namespace

double share_of_box_below(const Vec3& normal, double offset, const Vec3& edges) {
  const Extents box(normal, edges);
  return share_below(box, offset + 0.5 * box.sum);
}

double plane_offset(const Vec3& normal, const Vec3& edges, double share) {
  const Extents box(normal, edges);
  double low = 0, high = box.sum;
  for (int halving = 0; halving < 60; ++halving) {
    const double middle = 0.5 * (low + high);
    (share_below(box, middle) < share ? low : high) = middle;
  }
  return 0.5 * (low + high) - 0.5 * box.sum;
}

// Planes farther below the centre than this, radii, leave a sphere exactly dry.
constexpr double clearly_above = 1 + 1e-9;

SeenSurface see_surface(const BulkGrid& grid, const Vec3& position, double radius,
                        const std::function<BulkSurface(CellId)>& cell_of) {
  const Neighbourhood near(grid, position, radius, cell_of);
  bool liquid = false, gas = false;
  Vec3 normal, steepness;  // of the planes; of the liquid fraction, where the surface lies on faces
  double overlap = 0, height = 0;
  bool reaches_liquid = false;
  for (const NearCell& cell : near.cells()) {
    steepness += (0.5 - cell.surface.liquid_fraction) * cell.overlap * (cell.centre - position);
    if (is_cut(cell.surface)) {
      liquid = gas = true;
      overlap += cell.overlap;
      normal += cell.overlap * cell.surface.normal;
      const double below = cell.surface.offset - dot(cell.surface.normal, position - cell.centre);
      height += cell.overlap * below;
      reaches_liquid |= below > -clearly_above * radius;
    } else {
      reaches_liquid |= cell.surface.liquid_fraction > 0.5;
      (cell.surface.liquid_fraction > 0.5 ? liquid : gas) = true;
    }
  }
  SeenSurface seen;
  if (!liquid || !gas) {
    seen.wetted = liquid ? 1 : 0;
    return seen;
  }
  if (norm(normal) < 1e-6 * overlap || overlap == 0) normal = steepness;
  if (norm(normal) == 0) normal = {0, 0, 1};
  seen.normal = normal / norm(normal);
  const Vec3 size{std::abs(normal.x), std::abs(normal.y), std::abs(normal.z)};
  const int axis = size.x > size.y ? (size.x > size.z ? 0 : 2) : (size.y > size.z ? 1 : 2);
  seen.wetted = reaches_liquid ? wetted_share(near, position, radius, axis) : 0;
  seen.distance = radius * plane_height(seen.wetted);
  if (overlap == 0) return seen;
  // Not touched yet: how far it is.
  if (seen.wetted <= 0) seen.distance = std::min(-radius, height / overlap);
  if (seen.wetted >= 1) seen.distance = std::max(radius, height / overlap);
  return seen;
}

}  // namespace demvof
