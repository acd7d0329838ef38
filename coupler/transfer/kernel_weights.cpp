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
CellBlock reachable_block(const BulkGrid& grid, const Spheres& particles,
                          const std::array<double, 3>& half_widths) {
  std::array<int, 3> first, last;
  for (int axis = 0; axis < 3; ++axis) {
    double x_min = (*particles.begin())[axis], x_max = x_min;
    for (const Vec3& position : particles) {
      x_min = std::min(x_min, position[axis]);
      x_max = std::max(x_max, position[axis]);
    }
    AxisCells(grid, axis).reach(x_min, x_max, half_widths[axis], first[axis], last[axis]);
  }
  return CellBlock(grid, first, last);
}

void add_spheres(const BulkGrid& grid, const Spheres& particles, KernelWeights& weights) {
  const double largest = *std::max_element(particles.radius, particles.radius + particles.count);
  const Vec3 h = grid.spacing();
  weights.begin(reachable_block(grid, particles, {largest / h.x, largest / h.y, largest / h.z}),
                8 * static_cast<std::size_t>(particles.count));
  SphereCells sphere(grid);
  for (int i = 0; i < particles.count; ++i) {
    sphere.find(particles.position[i], particles.radius[i]);
    std::copy(sphere.shares().begin(), sphere.shares().end(), weights.room(sphere.shares().size()));
    weights.add(sphere.spans(), false);
  }
}

void add_products(const BulkGrid& grid, const AveragingParameters& averaging, const Spheres& particles,
                  KernelWeights& weights) {
  AxisKernels kernels(grid, averaging);
  const std::size_t most = kernels.most_shares();
  weights.begin(reachable_block(grid, particles, kernels.half_width()), most * particles.count);
  for (const Vec3& position : particles) weights.add(kernels.shares(position, weights.room(most)), true);
}

/// Products of the shares of so many particles along three axes, x fastest. Four at once: the last ones go
/// too far.
constexpr int beyond = 3;
[[gnu::always_inline]] inline void find_products(int particles, int nx, int ny, int nz, const double* share,
                                                 double* weight) {
  for (int i = 0; i < particles; ++i, share += nx + ny + nz)
    for (int c = 0; c < nz; ++c)
      for (int b = 0; b < ny; ++b, weight += nx) {
        const double factor = share[nx + b] * share[nx + ny + c];
        for (int a = 0; a < nx; a += 4) {
          Four x;
          load(x, share + a);
          store(weight + a, factor * x);
        }
      }
}
DEMVOF_WIDE void find_products_wide(int particles, int nx, int ny, int nz, const double* share,
                                    double* weight) {
  find_products(particles, nx, ny, nz, share, weight);
}

}  // namespace

void KernelWeights::begin(CellBlock block, std::size_t numbers) {
  block_ = std::move(block);
  cells_.clear();
  groups_.clear();
  used_ = 0;
  if (numbers > numbers_.capacity()) numbers_ = {};  // before there is a larger one
  numbers_.reserve(numbers);
}

void KernelWeights::add(const std::array<CellSpan, 3>& spans, bool product) {
  Group one{particles(), 1, {}, {}, product, used_};
  for (int axis = 0; axis < 3; ++axis) {
    assert(spans[axis].count <= std::numeric_limits<std::uint16_t>::max());
    one.cell[axis] = spans[axis].first;
    one.cells[axis] = static_cast<std::uint16_t>(spans[axis].count);
  }
  used_ += one.numbers_of_each();
  const bool same = !groups_.empty() && one.cell == groups_.back().cell && one.cells == groups_.back().cells;
  if (!same) mark(one);
  if (same && groups_.back().count < most_in_a_group)
    ++groups_.back().count;
  else
    groups_.push_back(one);
}

void KernelWeights::mark(const Group& group) {
  for (int c = 0; c < group.cells[2]; ++c)
    for (int b = 0; b < group.cells[1]; ++b)
      for (int a = 0; a < group.cells[0]; ++a)
        block_.mark(block_.place(
            {wrapped(group.cell[0] + a, 0), wrapped(group.cell[1] + b, 1), wrapped(group.cell[2] + c, 2)}));
}

void KernelWeights::finish() {
  cells_ = block_.list_marked();
}

const KernelWeights::Group& KernelWeights::group_of(int particle) const {
  for (std::size_t next = last_asked_; next < std::min(last_asked_ + 2, groups_.size()); ++next) {
    const Group& group = groups_[next];
    if (particle < group.first || particle >= group.first + group.count) continue;
    last_asked_ = next;
    return group;
  }
  const auto after = std::upper_bound(groups_.begin(), groups_.end(), particle,
                                      [](int i, const Group& group) { return i < group.first; });
  last_asked_ = static_cast<std::size_t>(after - 1 - groups_.begin());
  return groups_[last_asked_];
}

void KernelWeights::find_slots(const Group& group, std::vector<int>& slots) const {
  slots.resize(static_cast<std::size_t>(group.cell_count()));
  int* slot = slots.data();
  const int nx = group.cells[0], before_end = std::min(nx, grid_.cells()[0] - group.cell[0]);
  for (int c = 0; c < group.cells[2]; ++c)
    for (int b = 0; b < group.cells[1]; ++b) {
      // All of the box are touched: along x slots follow each other.
      const std::array<int, 3> row{group.cell[0], wrapped(group.cell[1] + b, 1),
                                   wrapped(group.cell[2] + c, 2)};
      const int first = block_.slot(block_.place(row));
      for (int a = 0; a < before_end; ++a) *slot++ = first + a;
      if (before_end == nx) continue;
      const int next = block_.slot(block_.place({0, row[1], row[2]}));
      for (int a = before_end; a < nx; ++a) *slot++ = next + a - before_end;
    }
}

WeightBlock KernelWeights::find(const Group& group, Found& room) const {
  find_slots(group, room.slots);
  const int cells = group.cell_count();
  if (!group.product) return {group.count, cells, room.slots.data(), &numbers_[group.numbers]};
  room.weights.resize(static_cast<std::size_t>(group.count) * cells + beyond);
  (have_wide ? find_products_wide : find_products)(group.count, group.cells[0], group.cells[1],
                                                   group.cells[2], &numbers_[group.numbers],
                                                   room.weights.data());
  return {group.count, cells, room.slots.data(), room.weights.data()};
}

double KernelWeights::squares(int particle) const {
  const Group& group = group_of(particle);
  const double* share = &numbers_[group.numbers + (particle - group.first) * group.numbers_of_each()];
  const auto sum_over = [&share](int count) {
    double sum = 0;
    for (const double* end = share + count; share != end; ++share) sum += *share * *share;
    return sum;
  };
  if (!group.product) return sum_over(group.cell_count());
  double product = 1;
  for (const int count : group.cells) product *= sum_over(count);
  return product;
}

double* KernelWeights::single(std::size_t group) {
  Group& here = groups_[group];
  if (here.product) {
    Found room;
    find(here, room);
    const std::size_t weights = here.count * static_cast<std::size_t>(here.cell_count());
    std::copy_n(room.weights.begin(), weights, this->room(weights));
    here.numbers = used_;
    here.product = false;
    used_ += weights;
  }
  return &numbers_[here.numbers];
}

void find_kernel_weights(const BulkGrid& grid, const AveragingParameters& averaging, const Spheres& particles,
                         KernelWeights& weights) {
  if (particles.count == 0)
    weights.begin(CellBlock(grid, {0, 0, 0}, {-1, -1, -1}), 0);
  else if (averaging.kernel == Kernel::volume)
    add_spheres(grid, particles, weights);
  else
    add_products(grid, averaging, particles, weights);
  weights.finish();
}

}  // namespace demvof
