// SPDX-License-Identifier: GPL-3.0-or-later
#include "coupler/transfer/kernel_weights.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <utility>

#include "coupler/grid/cell_block.hpp"
#include "coupler/transfer/axis_kernel.hpp"

namespace demvof {
namespace {

CellBlock reachable_block(const BulkGrid& grid, const std::array<AxisKernel, 3>& kernels,
                          const std::vector<Vec3>& positions) {
  std::array<int, 3> first, last;
  for (int axis = 0; axis < 3; ++axis) {
    double x_min = positions.front()[axis], x_max = x_min;
    for (const Vec3& position : positions) {
      x_min = std::min(x_min, position[axis]);
      x_max = std::max(x_max, position[axis]);
    }
    kernels[axis].reach(x_min, x_max, first[axis], last[axis]);
  }
  return CellBlock(grid, first, last);
}

}  // namespace

KernelWeights kernel_weights(const BulkGrid& grid, const AveragingParameters& averaging,
                             const std::vector<Vec3>& positions, KernelWeights storage) {
  KernelWeights weights = std::move(storage);
  weights.cells.clear();
  weights.slot.clear();
  weights.weight.clear();
  weights.first.assign(1, 0);
  if (positions.empty()) return weights;

  const std::array<AxisKernel, 3> kernels{AxisKernel(grid, averaging, 0), AxisKernel(grid, averaging, 1),
                                          AxisKernel(grid, averaging, 2)};
  CellBlock block = reachable_block(grid, kernels, positions);
  AxisShares x, y, z;
  for (const Vec3& position : positions) {
    kernels[0].shares(position.x, x);
    kernels[1].shares(position.y, y);
    kernels[2].shares(position.z, z);
    std::size_t entry = weights.slot.size();
    const std::size_t entries = x.index.size() * y.index.size() * z.index.size();
    weights.slot.resize(entry + entries);
    weights.weight.resize(entry + entries);
    for (std::size_t c = 0; c < z.index.size(); ++c)
      for (std::size_t b = 0; b < y.index.size(); ++b) {
        const std::size_t row = block.place({0, y.index[b], z.index[c]});
        const double share = y.share[b] * z.share[c];
        for (std::size_t a = 0; a < x.index.size(); ++a, ++entry) {
          weights.slot[entry] = static_cast<int>(row + x.index[a]);  // a place in the block, for now
          weights.weight[entry] = share * x.share[a];
          block.mark(row + x.index[a]);
        }
      }
    weights.first.push_back(static_cast<int>(entry));
  }
  weights.cells = block.list_marked();
  for (int& slot : weights.slot) slot = block.slot(slot);
  return weights;
}

void count_open_shares(const std::vector<double>& share, KernelWeights& weights) {
  for (int particle = 0; particle < weights.particles(); ++particle) {
    const int first = weights.first[particle], last = weights.first[particle + 1];
    double sum = 0;
    for (int entry = first; entry < last; ++entry) sum += weights.weight[entry] * share[weights.slot[entry]];
    if (!(sum > 0)) continue;
    for (int entry = first; entry < last; ++entry) weights.weight[entry] *= share[weights.slot[entry]] / sum;
  }
}

void deposit(const KernelWeights& weights, const double* rows, int width, double* cell_rows) {
  std::fill_n(cell_rows, weights.cells.size() * width, 0.0);
  for (int particle = 0; particle < weights.particles(); ++particle) {
    const double* row = rows + std::size_t(particle) * width;
    for (int entry = weights.first[particle]; entry < weights.first[particle + 1]; ++entry) {
      double* cell_row = cell_rows + std::size_t(weights.slot[entry]) * width;
      for (int m = 0; m < width; ++m) cell_row[m] += weights.weight[entry] * row[m];
    }
  }
}

void sample(const KernelWeights& weights, const double* cell_rows, int width, double* rows) {
  std::fill_n(rows, std::size_t(weights.particles()) * width, 0.0);
  for (int particle = 0; particle < weights.particles(); ++particle) {
    double* row = rows + std::size_t(particle) * width;
    for (int entry = weights.first[particle]; entry < weights.first[particle + 1]; ++entry) {
      const double* cell_row = cell_rows + std::size_t(weights.slot[entry]) * width;
      for (int m = 0; m < width; ++m) row[m] += weights.weight[entry] * cell_row[m];
    }
  }
}

}  // namespace demvof
