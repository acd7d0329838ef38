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
#include "coupler/transfer/spheres.hpp"

namespace demvof {

/// The share w_ic of each particle i in each bulk cell c it reaches. The shares of one particle add
/// up to 1, also at walls, where the weight that would leave the grid goes back to the cells inside.
///
/// The cells of a particle fill a box. Of most kernels w_ic is a product of one share per axis, which is what
/// is stored; single weights are where it is none: of the volume kernel, and of particles beside walls of the
/// mesh (bulk_walls.hpp). Particles that follow each other and have the same box are a group: what is to be
/// found of the cells is found once for all of them.
class KernelWeights {
 public:
  explicit KernelWeights(const BulkGrid& grid) : grid_(grid), block_(grid, {0, 0, 0}, {-1, -1, -1}) {}

  struct Group {
    int first, count;  // particles
    std::array<int, 3> cell;
    std::array<std::uint16_t, 3> cells;  // along each axis
    bool product;
    std::size_t numbers;  // where those of the first particle begin

    int cell_count() const { return cells[0] * cells[1] * cells[2]; }
    std::size_t numbers_of_each() const {
      return product ? cells[0] + cells[1] + cells[2] : static_cast<std::size_t>(cell_count());
    }
  };
  static constexpr int most_in_a_group = 16;

  int particles() const { return groups_.empty() ? 0 : groups_.back().first + groups_.back().count; }
  const std::vector<Group>& groups() const { return groups_; }
  /// That of a particle; quick for particles in turn.
  const Group& group_of(int particle) const;
  const std::vector<CellId>& cells() const { return cells_; }  // touched, sorted, without repeats

  /// Room for the weights of a group.
  struct Found {
    std::vector<int> slots;
    std::vector<double> weights;
  };
  /// Slots in cells() of a group's cells, x fastest.
  void find_slots(const Group& group, std::vector<int>& slots) const;
  /// Slots and weights, valid until room is used again.
  WeightBlock find(const Group& group, Found& room) const;
  /// visit(slot, weight), in that order.
  template <class Visit>
  void for_each_cell(int particle, const Visit& visit) const {
    Group one = group_of(particle);
    one.numbers += (particle - one.first) * one.numbers_of_each();
    one.count = 1;
    Found room;
    const WeightBlock block = find(one, room);
    for (int cell = 0; cell < block.cells; ++cell) visit(block.slot[cell], block.weight[cell]);
  }
  /// Sum of w^2 of the particle, -.
  double squares(int particle) const;

  /// The weights of a group's particles, as in WeightBlock, to be changed one by one. Addresses of earlier
  /// calls no longer hold.
  double* single(std::size_t group);

  /// Takes new particles, that reach cells of the block; numbers: how many about. Storage is used again.
  void begin(CellBlock block, std::size_t numbers);
  /// Room for that many numbers of the next particle.
  double* room(std::size_t numbers) {
    constexpr std::size_t beyond = 3;  // what is read by fours goes too far
    if (used_ + numbers + beyond > numbers_.size()) numbers_.resize(used_ + numbers + beyond);
    return &numbers_[used_];
  }
  /// The next particle: of its numbers in the room the shares along x, y, z follow each other; or, if not
  /// product, the weights of its box.
  void add(const std::array<CellSpan, 3>& spans, bool product);
  void finish();

 private:
  int wrapped(int index, int axis) const {
    return index < grid_.cells()[axis] ? index : index - grid_.cells()[axis];
  }
  void mark(const Group& group);

  BulkGrid grid_;
  CellBlock block_;
  std::vector<CellId> cells_;
  std::vector<Group> groups_;
  std::vector<double> numbers_;
  std::size_t used_ = 0;
  mutable std::size_t last_asked_ = 0;  // group
};

/// Weights of the given particles. kernel width as in AveragingParameters; positions beyond a wall count as
/// on the wall. Of radii only the volume kernel takes notice. The diffusion
/// kernel's weights are those before diffusion (diffusion.hpp). weights: what they were before is dropped.
void find_kernel_weights(const BulkGrid& grid, const AveragingParameters& averaging, const Spheres& particles,
                         KernelWeights& weights);
inline KernelWeights kernel_weights(const BulkGrid& grid, const AveragingParameters& averaging,
                                    const std::vector<Vec3>& positions, const std::vector<double>& radii) {
  KernelWeights weights(grid);
  find_kernel_weights(grid, averaging, {positions, radii}, weights);
  return weights;
}

}  // namespace demvof
