// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "coupler/config/parameters.hpp"
#include "coupler/grid/bulk_grid.hpp"

namespace demvof {

/// Half width of the Gaussian kernel in standard deviations. The Gaussian is cut there and normalised;
/// its second moment is then 2.7 % below width^2.
constexpr double gaussian_cut = 3.0;

/// Shares of a particle in the cells of one direction; shares add up to 1.
struct AxisShares {
  std::vector<int> index;     // cell index along the axis, each once
  std::vector<double> share;  // -
};

/// An averaging kernel along one axis of the bulk grid; the kernels are products of three of these.
///
///   centre    share 1 in the cell of the particle
///   linear    hat function through the two nearest cell centres
///   gaussian  integral over the cell of exp(-(x - x_p)^2 / (2 width^2)), cut at gaussian_cut widths.
///             The cut moves with the particle, so that a cell is entered and left with share 0:
///             the shares are continuous in the particle's position, exactly.
///
/// What leaves through a wall is mirrored at the wall: an even spread of particles up to the wall
/// stays even. Periodic directions wrap.
class AxisKernel {
 public:
  AxisKernel(const BulkGrid& grid, const AveragingParameters& averaging, int axis);

  /// x: coordinate, m; beyond a wall it counts as on the wall.
  void shares(double x, AxisShares& shares) const;
  /// Cells first..last hold all that particles with coordinates in [x_min, x_max] can reach.
  void reach(double x_min, double x_max, int& first, int& last) const;

 private:
  double cells_from_lower(double x) const;
  int fold(int index) const;

  Kernel kernel_;
  double lower_, spacing_;
  int cells_;
  bool periodic_;
  double width_;  // of the Gaussian, in cells
  double reach_;  // farthest distance between particle and a touched cell, in cells
};

}  // namespace demvof
