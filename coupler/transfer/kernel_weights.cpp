// SPDX-License-Identifier: GPL-3.0-or-later
#include "coupler/transfer/kernel_weights.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <cstddef>
#include <utility>

#include "coupler/grid/cell_block.hpp"
#include "coupler/transfer/axis_kernel.hpp"
#include "coupler/transfer/sphere_cells.hpp"

namespace demvof {
namespace {

/// half_widths: farthest reach of a particle along each axis, in cells.
CellBlock reachable_block(const BulkGrid& grid, const std::vector<Vec3>& positions,
                          const std::array<double, 3>& half_widths) {
  std::array<int, 3> first, last;
  for (int axis = 0; axis < 3; ++axis) {
    double x_min = positions.front()[axis], x_max = x_min;
    for (const Vec3& position : positions) {
      x_min = std::min(x_min, position[axis]);
      x_max = std::max(x_max, position[axis]);
    }
    AxisCells(grid, axis).reach(x_min, x_max, half_widths[axis], first[axis], last[axis]);
  }
  return CellBlock(grid, first, last);
}

/// Entries of one particle after another; places in the block stand for cells until all are known.
class Entries {
 public:
  Entries(KernelWeights& weights, CellBlock block) : weights_(weights), block_(std::move(block)) {}

  /// share(a, b, c): of the cell {x[a], y[b], z[c]}.
  template <class Share>
  void add(const std::vector<int>& x, const std::vector<int>& y, const std::vector<int>& z, Share&& share) {
    std::size_t entry = weights_.first.back();
    const std::size_t end = entry + x.size() * y.size() * z.size();
    if (end > weights_.slot.size()) {  // fills what it adds with zeros: seldom, and much at a time
      weights_.slot.resize(end + end / 2);
      weights_.weight.resize(end + end / 2);
    }
    for (std::size_t c = 0; c < z.size(); ++c)
      for (std::size_t b = 0; b < y.size(); ++b) {
        const std::size_t row = block_.place({0, y[b], z[c]});
        for (std::size_t a = 0; a < x.size(); ++a, ++entry) {
          weights_.slot[entry] = static_cast<int>(row + x[a]);
          weights_.weight[entry] = share(a, b, c);
          block_.mark(row + x[a]);
        }
      }
    weights_.first.push_back(static_cast<int>(entry));
  }
  void finish() {
    weights_.slot.resize(weights_.first.back());
    weights_.weight.resize(weights_.first.back());
    weights_.cells = block_.list_marked();
    for (int& slot : weights_.slot) slot = block_.slot(slot);
  }

 private:
  KernelWeights& weights_;
  CellBlock block_;
};

void add_spheres(const BulkGrid& grid, const std::vector<Vec3>& positions, const std::vector<double>& radii,
                 KernelWeights& weights) {
  const double largest = *std::max_element(radii.begin(), radii.end());
  const Vec3 h = grid.spacing();
  Entries entries(weights, reachable_block(grid, positions, {largest / h.x, largest / h.y, largest / h.z}));
  SphereCells sphere(grid);
  for (std::size_t i = 0; i < positions.size(); ++i) {
    sphere.find(positions[i], radii[i]);
    entries.add(sphere.index(0), sphere.index(1), sphere.index(2),
                [&](std::size_t a, std::size_t b, std::size_t c) { return sphere.share(a, b, c); });
  }
  entries.finish();
}

void add_products(const BulkGrid& grid, const AveragingParameters& averaging,
                  const std::vector<Vec3>& positions, KernelWeights& weights) {
  const std::array<AxisKernel, 3> kernels{AxisKernel(grid, averaging, 0), AxisKernel(grid, averaging, 1),
                                          AxisKernel(grid, averaging, 2)};
  Entries entries(
      weights, reachable_block(grid, positions,
                               {kernels[0].half_width(), kernels[1].half_width(), kernels[2].half_width()}));
  AxisShares x, y, z;
  for (const Vec3& position : positions) {
    kernels[0].shares(position.x, x);
    kernels[1].shares(position.y, y);
    kernels[2].shares(position.z, z);
    entries.add(x.index, y.index, z.index, [&](std::size_t a, std::size_t b, std::size_t c) {
      return x.share[a] * (y.share[b] * z.share[c]);
    });
  }
  entries.finish();
}

}  // namespace

KernelWeights kernel_weights(const BulkGrid& grid, const AveragingParameters& averaging,
                             const std::vector<Vec3>& positions, const std::vector<double>& radii,
                             KernelWeights storage) {
  assert(radii.size() == positions.size());
  KernelWeights weights = std::move(storage);
  weights.first.assign(1, 0);
  if (positions.empty()) return {{}, {0}, {}, {}};
  if (averaging.kernel == Kernel::volume)
    add_spheres(grid, positions, radii, weights);
  else
    add_products(grid, averaging, positions, weights);
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

}  // namespace demvof
