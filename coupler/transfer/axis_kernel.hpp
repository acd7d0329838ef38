// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

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

/// An averaging kernel along one axis of the bulk grid; these kernels are products of three of them.
///
///   centre    share 1 in the cell of the particle
///   linear    hat function through the two nearest cell centres; what `diffusion` diffuses, too
///   gaussian  integral over the cell of exp(-(x - x_p)^2 / (2 width^2)), cut at gaussian_cut widths.
///             The cut moves with the particle, so that a cell is entered and left with share 0:
///             the shares are continuous in the particle's position, exactly.
class AxisKernel {
 public:
  AxisKernel(const BulkGrid& grid, const AveragingParameters& averaging, int axis);

  /// Shares of a particle in the cells that it reaches, each once; they add up to 1. share: with room for
  /// most_cells().
  CellSpan shares(double x, double* share) const;
  int most_cells() const { return most_cells_; }
  /// Farthest distance between a particle and a cell it touches, in cells.
  double half_width() const { return half_width_; }

 private:
  AxisCells cells_;
  Kernel kernel_;
  double width_, scale_;  // of the Gaussian, in cells; 1/(sqrt 2 width)
  double half_width_ = 0;
  int most_cells_;
};

}  // namespace demvof
