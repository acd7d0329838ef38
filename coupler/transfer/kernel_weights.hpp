// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "coupler/grid/bulk_grid.hpp"
#include "coupler/grid/cell_block.hpp"
#include "coupler/transfer/averaging_parameters.hpp"
#include "coupler/transfer/axis_kernel.hpp"
#include "coupler/transfer/row_sums.hpp"

namespace demvof {

/// The share w_ic of each particle i in each bulk cell c it reaches. The shares of one particle add
/// up to 1, also at walls, where the weight that would leave the grid goes back to the cells inside.
///
/// The cells of a particle fill a box. Of most kernels w_ic is a product of one share per axis, which is what
/// is stored; single weights are where it is none: of the volume kernel, and of particles beside walls of the
/// mesh (bulk_walls.hpp).
class KernelWeights {
 public:
  explicit KernelWeights(const BulkGrid& grid) : grid_(grid), block_(grid, {0, 0, 0}, {-1, -1, -1}) {}

  int particles() const { return static_cast<int>(boxes_.size()); }
  const std::vector<CellId>& cells() const { return cells_; }  // touched, sorted, without repeats

  /// The particle's weights in cells() as they follow each other, x fastest; runs: emptied and filled.
  void find_runs(int particle, std::vector<RowRun>& runs) const;
  /// visit(slot, weight), in that order.
  template <class Visit>
  void for_each_cell(int particle, const Visit& visit) const {
    std::vector<RowRun> runs;
    find_runs(particle, runs);
    for (const RowRun& run : runs)
      for (int a = 0; a < run.count; ++a) visit(run.first + a, run.share[a] * run.factor);
  }

  /// The particle's weights, in the order of for_each_cell, to be changed one by one. Addresses of earlier
  /// calls no longer hold.
  double* single(int particle);

  /// Takes new particles, that reach cells of the block; numbers: how many about. Storage is used again.
  void begin(CellBlock block, std::size_t particles, std::size_t numbers);
  /// Room for that many numbers of the next particle.
  double* room(std::size_t numbers) {
    if (used_ + numbers > numbers_.size()) numbers_.resize(used_ + numbers);
    return &numbers_[used_];
  }
  /// The next particle: of its numbers in the room the shares along x, y, z follow each other; or, if not
  /// product, the weights of its box.
  void add(const std::array<CellSpan, 3>& spans, bool product);
  void finish();

 private:
  struct Box {
    std::array<int, 3> first;
    std::array<std::uint16_t, 3> count;
    bool product;
    std::size_t numbers;  // where they begin
  };
  int wrapped(int index, int axis) const {
    return index < grid_.cells()[axis] ? index : index - grid_.cells()[axis];
  }
  void mark(const Box& box);

  BulkGrid grid_;
  CellBlock block_;
  std::vector<CellId> cells_;
  std::vector<Box> boxes_;
  std::vector<double> numbers_;
  std::size_t used_ = 0;
};

/// Weights of the given particles. kernel width as in AveragingParameters; positions beyond a wall count as
/// on the wall. radii: m, one per particle, of which only the volume kernel takes notice. The diffusion
/// kernel's weights are those before diffusion (diffusion.hpp). weights: what they were before is dropped.
void find_kernel_weights(const BulkGrid& grid, const AveragingParameters& averaging,
                         const std::vector<Vec3>& positions, const std::vector<double>& radii,
                         KernelWeights& weights);
inline KernelWeights kernel_weights(const BulkGrid& grid, const AveragingParameters& averaging,
                                    const std::vector<Vec3>& positions, const std::vector<double>& radii) {
  KernelWeights weights(grid);
  find_kernel_weights(grid, averaging, positions, radii, weights);
  return weights;
}

}  // namespace demvof
