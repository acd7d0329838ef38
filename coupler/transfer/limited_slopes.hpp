// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <vector>

#include "coupler/grid/bulk_grid.hpp"
#include "coupler/grid/cell_block.hpp"

namespace demvof {

/// A linear profile in a bulk cell, from the means of the cells around it.
///
///   q(x) = q_c + phi g . (x - X_c)       X_c: centroid of the fluid domain in the cell
///
/// g     least-squares gradient over the face neighbours (weights 1/distance^2), which is exact for linear
///       fields and is the central difference on a full grid
/// phi   largest factor <= 1 for which q(x) stays, anywhere in the cell's box, between the smallest and the
///       largest mean among the cell and the 26 cells around it (Barth & Jespersen 1989, AIAA 89-0366). With
///       corner neighbours in the bounds an oblique linear field is not limited; with face neighbours alone
///       it would be.
///
/// The mean of the profile over the fluid domain is q_c. Cells without fluid count as absent.
class LimitedSlopes {
 public:
  /// cells: sorted cells with their slots in block; volume: fluid volume of each, m3; centroid: X_c, m.
  /// where: slots that need slopes.
  LimitedSlopes() = default;
  LimitedSlopes(const BulkGrid& grid, const std::vector<CellId>& cells, const CellBlock& block,
                const std::vector<double>& volume, const std::vector<Vec3>& centroid,
                const std::vector<int>& where);

  /// means: cells x width, a value of 0 where there is no fluid. Returns phi g: where x width.
  std::vector<Vec3> evaluate(const std::vector<double>& means, int width) const;
  /// g alone, not limited.
  std::vector<Vec3> gradients(const std::vector<double>& means, int width) const;

 private:
  struct Surroundings {
    int slot = 0;
    std::array<int, 6> face;       // slots, -1 for none
    std::array<Vec3, 6> gradient;  // g = sum of gradient * (q_face - q_c), 1/m
    std::array<int, 26> around;    // slots of the first `count` entries
    int count = 0;
    Vec3 to_lower, to_upper;  // from X_c to the corners of the cell's box, m
  };
  static Vec3 gradient(const Surroundings& cell, const std::vector<double>& means, int width, int m);
  static void fit_gradient(Surroundings& cell, const std::array<Vec3, 6>& distance);
  std::vector<Surroundings> cells_;
};

}  // namespace demvof
