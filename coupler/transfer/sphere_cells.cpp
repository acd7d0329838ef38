// SPDX-License-Identifier: GPL-3.0-or-later
#include "coupler/transfer/sphere_cells.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstddef>

#include "coupler/base/sphere.hpp"

namespace demvof {
namespace {

/// For 0 <= a, b, c and a^2 + b^2 + c^2 < 1.
double beyond_inner_corner(double a, double b, double c) {
  const double w_ab = std::sqrt(1 - a * a - b * b);
  const double w_bc = std::sqrt(1 - b * b - c * c);
  const double w_ca = std::sqrt(1 - c * c - a * a);
  const double phi_a = std::atan2(w_ab, b) - std::atan2(c, w_ca);
  const double phi_b = std::atan2(w_bc, c) - std::atan2(a, w_ab);
  const double phi_c = std::atan2(w_ca, a) - std::atan2(b, w_bc);
  const double gammas = std::atan2(w_ab, a * b) + std::atan2(w_bc, b * c) + std::atan2(w_ca, c * a);
  const double area_a = 0.5 * ((1 - a * a) * phi_a - b * (w_ab - c) - c * (w_ca - b));
  const double area_b = 0.5 * ((1 - b * b) * phi_b - c * (w_bc - a) - a * (w_ab - c));
  const double area_c = 0.5 * ((1 - c * c) * phi_c - a * (w_ca - b) - b * (w_bc - a));
  const double sphere = gammas - pi - a * phi_a - b * phi_b - c * phi_c;
  return (sphere - a * area_a - b * area_b - c * area_c) / 3;
}

double beyond_one(double a) {
  if (a >= 1) return 0;
  return a > -1 ? pi / 3 * (1 - a) * (1 - a) * (2 + a) : 4 * pi / 3;
}

double beyond_two(double a, double b) {
  if (a < 0) return beyond_one(b) - beyond_two(-a, b);
  if (b < 0) return beyond_one(a) - beyond_two(a, -b);
  return a * a + b * b < 1 ? 2 * beyond_inner_corner(a, b, 0) : 0;
}

}  // namespace

double unit_ball_beyond(double a, double b, double c) {
  if (a <= -1 && b <= -1) return beyond_one(c);
  if (b <= -1 && c <= -1) return beyond_one(a);
  if (c <= -1 && a <= -1) return beyond_one(b);
  if (a < 0) return beyond_two(b, c) - unit_ball_beyond(-a, b, c);
  if (b < 0) return beyond_two(c, a) - unit_ball_beyond(a, -b, c);
  if (c < 0) return beyond_two(a, b) - unit_ball_beyond(a, b, -c);
  return a * a + b * b + c * c < 1 ? beyond_inner_corner(a, b, c) : 0;
}

SphereCells::SphereCells(const BulkGrid& grid)
    : cells_{AxisCells(grid, 0), AxisCells(grid, 1), AxisCells(grid, 2)} {}

void SphereCells::find(const Vec3& position, double radius) {
  assert(radius > 0);
  for (int axis = 0; axis < 3; ++axis) {
    const AxisCells& cells = cells_[axis];
    lower_[axis].clear();
    target_[axis].clear();
    const double s = cells.place(position[axis]), r = radius / cells.spacing();
    const int first = static_cast<int>(std::floor(s - r));
    int last = first;
    while (last + 1 < s + r) ++last;
    spans_[axis] = cells.fold(first, last);
    for (int cell = first; cell <= last; ++cell) {
      lower_[axis].push_back(cell == first ? -1.0 : (cell - s) / r);
      target_[axis].push_back(cells.place_in(spans_[axis], cell));
    }
  }

  const std::size_t nx = lower_[0].size(), ny = lower_[1].size(), nz = lower_[2].size();
  beyond_.resize(nx * ny * nz);
  std::size_t place = 0;
  for (const double c : lower_[2])
    for (const double b : lower_[1])
      for (const double a : lower_[0]) beyond_[place++] = unit_ball_beyond(a, b, c) / (4 * pi / 3);
  // Beyond a lower face and not beyond the next one: in place along each axis.
  for (std::size_t p = 0; p < beyond_.size(); ++p)
    if (p % nx + 1 < nx) beyond_[p] -= beyond_[p + 1];
  for (std::size_t p = 0; p < beyond_.size(); ++p)
    if (p / nx % ny + 1 < ny) beyond_[p] -= beyond_[p + nx];
  for (std::size_t p = 0; p + nx * ny < beyond_.size(); ++p) beyond_[p] -= beyond_[p + nx * ny];

  // Nearest coordinate of each cell to the centre, squared: what the ball does not reach gets exactly 0.
  for (int axis = 0; axis < 3; ++axis) {
    const std::vector<double>& lower = lower_[axis];
    nearest_[axis].resize(lower.size());
    for (std::size_t i = 0; i < lower.size(); ++i) {
      const double upper = i + 1 < lower.size() ? lower[i + 1] : 1;
      const double x = std::max({lower[i], -upper, 0.0});
      nearest_[axis][i] = x * x;
    }
  }
  const std::size_t tx = spans_[0].count, ty = spans_[1].count;
  share_.assign(tx * ty * spans_[2].count, 0.0);
  place = 0;
  for (std::size_t k = 0; k < nz; ++k)
    for (std::size_t j = 0; j < ny; ++j)
      for (std::size_t i = 0; i < nx; ++i, ++place)
        if (nearest_[0][i] + nearest_[1][j] + nearest_[2][k] < 1)  // below 0 by round-off at most
          share_[target_[0][i] + tx * (target_[1][j] + ty * target_[2][k])] += std::max(beyond_[place], 0.0);
}

}  // namespace demvof
