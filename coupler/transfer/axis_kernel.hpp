// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <vector>

#include "coupler/grid/bulk_grid.hpp"
#include "coupler/transfer/averaging_parameters.hpp"

namespace demvof {

/// Half width of the Gaussian kernel in standard deviations. The Gaussian is cut there and normalised;
/// its second moment is then 2.7 % below width^2.
constexpr double gaussian_cut = 3.0;

/// Cells that follow each other along an axis; in a periodic direction 0 follows the last one.
struct CellSpan {
  int first, count;
};

/// The cells of the bulk grid along one axis; lengths are in cells, counted from the lower end.
///
/// What leaves through a wall is mirrored at the wall: an even spread of particles up to the wall
/// stays even. Periodic directions wrap.
class AxisCells {
 public:
  AxisCells(const BulkGrid& grid, int axis);

  /// x: coordinate, m; beyond a wall it counts as on the wall.
  double place(double x) const;
  /// The cell inside the grid that stands for a cell index beyond its ends.
  int fold(int index) const;
  bool inside(int index) const { return index >= 0 && index < count_; }
  /// The cells inside the grid that stand for cells first..last.
  CellSpan fold(int first, int last) const;
  /// Place in such a span of the cell that stands for an index.
  int place_in(const CellSpan& span, int index) const {
    const int place = fold(index) - span.first;
    return place < 0 ? place + count_ : place;
  }
  /// Cells first..last hold all that particles with coordinates in [x_min, x_max] reach with the half width.
  void reach(double x_min, double x_max, double half_width, int& first, int& last) const;
  double spacing() const { return spacing_; }  // m

 private:
  double lower_, spacing_;
  int count_;
  bool periodic_;
};

/// An averaging kernel as the product of one along each axis of the bulk grid.
///
///   centre    share 1 in the cell of the particle
///   linear    hat function through the two nearest cell centres; what `diffusion` diffuses, too
///   gaussian  integral over the cell of exp(-(x - x_p)^2 / (2 width^2)), cut at gaussian_cut widths.
///             The cut moves with the particle, so that a cell is entered and left with share 0:
///             the shares are continuous in the particle's position, exactly.
class AxisKernels {
 public:
  AxisKernels(const BulkGrid& grid, const AveragingParameters& averaging);

  /// Shares of a particle in the cells that it reaches along x, y, z, one axis after the other, each cell
  /// once; those of an axis add up to 1. share: with room for most_shares().
  std::array<CellSpan, 3> shares(const Vec3& position, double* share);
  int most_shares() const { return 3 * most_cells_; }
  /// Farthest distance between a particle and a cell it touches, in cells.
  const std::array<double, 3>& half_width() const { return half_width_; }

 private:
  std::array<AxisCells, 3> cells_;
  Kernel kernel_;
  std::array<double, 4> scale_{};  // of the Gaussian, 1/(sqrt 2 width), width in cells
  std::array<double, 3> half_width_{};
  int most_cells_ = 0;            // along an axis
  std::vector<double> unfolded_;  // shares of all axes in each cell in turn, before walls and periods
};

}  // namespace demvof
