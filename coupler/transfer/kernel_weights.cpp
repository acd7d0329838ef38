// SPDX-License-Identifier: GPL-3.0-or-later
#include "coupler/transfer/kernel_weights.hpp"

#include <algorithm>
#include <cassert>
#include <cstddef>
#include <limits>
#include <utility>

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

void add_spheres(const BulkGrid& grid, const std::vector<Vec3>& positions, const std::vector<double>& radii,
                 KernelWeights& weights) {
  const double largest = *std::max_element(radii.begin(), radii.end());
  const Vec3 h = grid.spacing();
  weights.begin(reachable_block(grid, positions, {largest / h.x, largest / h.y, largest / h.z}),
                positions.size(), 8 * positions.size());
  SphereCells sphere(grid);
  for (std::size_t i = 0; i < positions.size(); ++i) {
    sphere.find(positions[i], radii[i]);
    std::copy(sphere.shares().begin(), sphere.shares().end(), weights.room(sphere.shares().size()));
    weights.add(sphere.spans(), false);
  }
}

void add_products(const BulkGrid& grid, const AveragingParameters& averaging,
                  const std::vector<Vec3>& positions, KernelWeights& weights) {
  const std::array<AxisKernel, 3> kernels{AxisKernel(grid, averaging, 0), AxisKernel(grid, averaging, 1),
                                          AxisKernel(grid, averaging, 2)};
  std::size_t most = 0;
  for (const AxisKernel& kernel : kernels) most += kernel.most_cells();
  weights.begin(reachable_block(grid, positions,
                                {kernels[0].half_width(), kernels[1].half_width(), kernels[2].half_width()}),
                positions.size(), most * positions.size());
  for (const Vec3& position : positions) {
    double* share = weights.room(most);
    std::array<CellSpan, 3> spans;
    for (int axis = 0; axis < 3; ++axis) {
      spans[axis] = kernels[axis].shares(position[axis], share);
      share += spans[axis].count;
    }
    weights.add(spans, true);
  }
}

}  // namespace

void KernelWeights::begin(CellBlock block, std::size_t particles, std::size_t numbers) {
  block_ = std::move(block);
  cells_.clear();
  boxes_.clear();
  boxes_.reserve(particles);
  used_ = 0;
  if (numbers > numbers_.capacity()) numbers_ = {};  // before there is a larger one
  numbers_.reserve(numbers);
}

void KernelWeights::add(const std::array<CellSpan, 3>& spans, bool product) {
  Box box{{}, {}, product, used_};
  for (int axis = 0; axis < 3; ++axis) {
    assert(spans[axis].count <= std::numeric_limits<std::uint16_t>::max());
    box.first[axis] = spans[axis].first;
    box.count[axis] = static_cast<std::uint16_t>(spans[axis].count);
  }
  const std::size_t x = box.count[0], y = box.count[1], z = box.count[2];
  used_ += product ? x + y + z : x * y * z;
  if (boxes_.empty() || box.first != boxes_.back().first || box.count != boxes_.back().count) mark(box);
  boxes_.push_back(box);
}

void KernelWeights::mark(const Box& box) {
  for (int c = 0; c < box.count[2]; ++c)
    for (int b = 0; b < box.count[1]; ++b)
      for (int a = 0; a < box.count[0]; ++a)
        block_.mark(block_.place(
            {wrapped(box.first[0] + a, 0), wrapped(box.first[1] + b, 1), wrapped(box.first[2] + c, 2)}));
}

void KernelWeights::find_runs(int particle, std::vector<RowRun>& runs) const {
  const Box& box = boxes_[particle];
  const auto [x_first, y_first, z_first] = box.first;
  const auto [x_cells, y_cells, z_cells] = grid_.cells();
  const int nx = box.count[0], ny = box.count[1], nz = box.count[2];
  const int before_end = std::min(nx, x_cells - x_first);  // the others follow from 0 on
  const std::ptrdiff_t y_step = block_.y_step(), z_step = block_.z_step();
  const double* const share = &numbers_[box.numbers];
  runs.resize((before_end < nx ? 2 : 1) * std::size_t(ny) * nz);
  RowRun* run = runs.data();
  auto plane = static_cast<std::ptrdiff_t>(block_.place(box.first));
  for (int c = 0; c < nz; ++c, plane += z_step) {
    if (z_first + c == z_cells) plane -= z_cells * z_step;
    std::ptrdiff_t row = plane;
    for (int b = 0; b < ny; ++b, row += y_step) {
      if (y_first + b == y_cells) row -= y_cells * y_step;
      const double factor = box.product ? share[nx + b] * share[nx + ny + c] : 1;
      const double* x = box.product ? share : share + nx * (b + ny * c);
      *run++ = {block_.slot(row), before_end, x, factor};
      if (before_end < nx) *run++ = {block_.slot(row - x_first), nx - before_end, x + before_end, factor};
    }
  }
}

void KernelWeights::finish() {
  cells_ = block_.list_marked();
}

double* KernelWeights::single(int particle) {
  if (boxes_[particle].product) {
    Box box = boxes_[particle];
    box.numbers = used_;
    box.product = false;
    double* weight = room(std::size_t(box.count[0]) * box.count[1] * box.count[2]);
    for_each_cell(particle, [&](int, double w) {
      *weight++ = w;
      ++used_;
    });
    boxes_[particle] = box;
  }
  return &numbers_[boxes_[particle].numbers];
}

void find_kernel_weights(const BulkGrid& grid, const AveragingParameters& averaging,
                         const std::vector<Vec3>& positions, const std::vector<double>& radii,
                         KernelWeights& weights) {
  assert(radii.size() == positions.size());
  if (positions.empty())
    weights.begin(CellBlock(grid, {0, 0, 0}, {-1, -1, -1}), 0, 0);
  else if (averaging.kernel == Kernel::volume)
    add_spheres(grid, positions, radii, weights);
  else
    add_products(grid, averaging, positions, weights);
  weights.finish();
}

}  // namespace demvof
