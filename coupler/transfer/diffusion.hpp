// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Smoothing of bulk values by diffusion (Sun and Xiao, Int. J. Multiphase Flow 77 (2015) 142-154):
//
//   d phi/d tau = laplacian phi,   from tau = 0 to b^2/4,   no flux through walls
//
// which in free space is the convolution with a Gaussian, exp(-r^2/b^2) / (pi b^2)^(3/2), whatever the grid.
// b: bandwidth, m; standard deviation b / sqrt 2 along each axis.
//
// Discrete: n implicit Euler steps of tau/n along each axis in turn; the three operators commute on a
// Cartesian grid. With r = tau/(n h^2), h the cell width, a step is exactly two running sums,
//
//   (1 + 2 r) z_i - r (z_i-1 + z_i+1) = x_i
//   y_i = x_i + lambda y_i-1,   z_i = (1 - lambda)^2 y_i + lambda z_i+1,   lambda / (1 - lambda)^2 = r
//
// begun with the mirrored (wall) or the repeated (periodic) row; a wall inside a row makes two of it. Nothing
// is ever subtracted: no value gets negative, small values far away keep their digits, and sums are kept to
// round-off. The operator is symmetric, so that smoothing what is sampled is the transpose of smoothing what
// was deposited. Cost: that of a few passes over the bulk grid, for any bandwidth and any number of
// particles.

#include <mpi.h>

#include <memory>
#include <vector>

#include "coupler/grid/bulk_cells.hpp"
#include "coupler/grid/touched_cells.hpp"
#include "coupler/transfer/bulk_walls.hpp"

namespace demvof {

/// n. The shape of the kernel along an axis is Gaussian up to an excess kurtosis of 3/n.
constexpr int diffusion_steps = 4;

/// One implicit step on one row of cells, in place. Each cell holds width values.
class RowDiffusion {
 public:
  /// strength: r > 0, -.
  RowDiffusion(int cells, double strength, bool periodic);
  void step(double* row, int width) const;

 private:
  int cells_;
  bool periodic_;
  double lambda_, one_minus_lambda_;
  double lambda_row_;  // lambda^cells
  double beyond_;      // 1 / (1 - lambda^(cells in a period))
};

/// Diffusion on the bulk grid, spread over the ranks by rows of cells. Construction and every call are
/// collective.
class Diffusion {
 public:
  /// bandwidth: b > 0, m.
  Diffusion(MPI_Comm world, const BulkGrid& grid, const BulkPartition& partition, double bandwidth);

  /// Cells of this rank that the fluid mesh does not fill, with the fluid's share a in their volume; all
  /// others count in full. What is spread then goes to a cell in proportion to its share:
  ///   a G (x / (G^T a))   deposited x,  G the diffusion;   (G^T a y) / (G^T a)   its transpose, for what is
  ///   sampled
  /// whose sum over the cells is that of x. G^T is G unless there are walls: then the axes do not commute.
  /// Where the fluid is so far away that G^T a is nothing, nothing is deposited and nothing sampled.
  void set_open_shares(const CellValues<double>& share);

  /// Faces that nothing goes through, on cells of this rank. Before set_open_shares.
  void set_walls(const CellValues<BulkWalls>& walls);

  /// What was deposited. values: on any subset of this rank's cells, the others hold 0. Returned: on all of
  /// them.
  template <class T>
  CellValues<T> spread(CellValues<T> values) const {
    scale(values, [this](std::size_t own) { return per_reached_[own]; });
    values = diffused(std::move(values), false);
    scale(values, [this](std::size_t own) { return open_[own]; });
    return values;
  }
  /// What is to be sampled: the transpose.
  template <class T>
  CellValues<T> gather(CellValues<T> values) const {
    scale(values, [this](std::size_t own) { return open_[own]; });
    values = diffused(std::move(values), walls_);
    scale(values, [this](std::size_t own) { return per_reached_[own]; });
    return values;
  }

 private:
  struct Axis {
    RowDiffusion row;
    std::vector<int> place;  // of each cell of each of this rank's lines in the touched cells, line by line
    int cells;               // per line
    bool periodic;
    double strength;         // of the row's steps
    int along;               // x, y, z: 0, 1, 2
    std::vector<char> wall;  // below each of these cells; empty: none
    std::unique_ptr<TouchedCells> touched;
  };
  static void diffuse_row(const Axis& axis, const char* wall, std::vector<double>& row, int width);
  static void diffuse(const Axis& axis, double* values, int width);
  template <class T>
  CellValues<T> diffused(CellValues<T> values, bool backwards) const {
    for (std::size_t i = 0; i < axes_.size(); ++i) {
      const Axis& axis = axes_[backwards ? axes_.size() - 1 - i : i];  // with walls they do not commute
      std::vector<T> lines = axis.touched->fetch_from_owners(values, T{});
      diffuse(axis, reinterpret_cast<double*>(lines.data()), row_width<T>());
      values = axis.touched->sum_to_owners(lines);
    }
    return values;
  }
  /// Multiplies each value by factor(number of the cell on this rank).
  template <class T, class Factor>
  void scale(CellValues<T>& values, Factor&& factor) const {
    if (open_.empty()) return;
    for (std::size_t i = 0; i < values.cells.size(); ++i) {
      const double by = factor(static_cast<std::size_t>(partition_.place(values.cells[i])));
      double* row = reinterpret_cast<double*>(&values.values[i]);
      for (int m = 0; m < row_width<T>(); ++m) row[m] *= by;
    }
  }

  MPI_Comm world_;
  BulkPartition partition_;
  bool walls_ = false;  // on all ranks
  std::vector<Axis> axes_;
  std::vector<double> open_, per_reached_;  // a and 1 / (G^T a) of each cell of this rank; empty: all open
};

}  // namespace demvof
