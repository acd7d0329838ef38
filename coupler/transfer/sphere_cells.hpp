// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Volume that a sphere has in common with each cell of a Cartesian grid, exactly.
//
// Of the unit ball the part beyond three planes, {x > a, y > b, z > c}, is known in closed form when the
// corner (a, b, c) lies inside the ball and a, b, c >= 0. By the divergence theorem
//
//   V = (S - a A_a - b A_b - c A_c) / 3
//
//   A_a = (rho_a^2 phi_a - b (w_ab - c) - c (w_ac - b)) / 2    area of the plane x = a inside
//   S   = gamma_ab + gamma_bc + gamma_ca - pi - a phi_a - b phi_b - c phi_c
//                                                              area of the sphere beyond (Gauss-Bonnet)
//   w_ab = sqrt(1 - a^2 - b^2),  rho_a^2 = 1 - a^2
//   phi_a = atan2(w_ab, b) - atan2(c, w_ac)                    angle of the arc on the plane x = a
//   gamma_ab = atan2(w_ab, a b)                                angle between two arcs where they meet
//
// Negative a, b, c follow by mirroring, and a cell from the parts beyond its eight corners. Those of a row of
// cells are differences of one list of numbers: the shares add up to 1 whatever round-off does to each.
// The problem is that of Strobl, Formella and Poeschel, J. Comput. Phys. 311 (2016) 158-172.

#include <array>
#include <vector>

#include "coupler/transfer/axis_kernel.hpp"

namespace demvof {

/// Volume of the part of the unit ball with x > a, y > b and z > c, -; -1 or less: no such plane.
double unit_ball_beyond(double a, double b, double c);

/// Shares of a sphere in the cells of the bulk grid: common volume over volume of the sphere. What lies
/// beyond a wall is mirrored back.
class SphereCells {
 public:
  explicit SphereCells(const BulkGrid& grid);

  /// position and radius in m; radius > 0. A centre beyond a wall counts as on it.
  void find(const Vec3& position, double radius);
  /// Of the sphere found last: its cells along each axis, and their shares, x fastest.
  const std::array<CellSpan, 3>& spans() const { return spans_; }
  const std::vector<double>& shares() const { return share_; }

 private:
  std::array<AxisCells, 3> cells_;
  std::array<std::vector<double>, 3>
      lower_;  // lower face of each cell before folding, in radii from the centre
  std::array<std::vector<int>, 3> target_;  // where in its span it goes
  std::array<CellSpan, 3> spans_{};
  std::array<std::vector<double>, 3> nearest_;  // square of a cell's distance from the centre, in radii
  std::vector<double> beyond_, share_;
};

}  // namespace demvof
