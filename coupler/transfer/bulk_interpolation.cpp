// SPDX-License-Identifier: GPL-3.0-or-later
#include "coupler/transfer/bulk_interpolation.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace demvof {
namespace {

constexpr double same_point = 1e-9;  // of a bulk cell

using Index = std::array<int, 3>;

/// A value as a weighted sum of the means of a bulk cell and the 26 around it.
struct Node {
  std::array<double, 27> weight{};

  void add(double factor, const Index& step) {
    weight[(step[0] + 1) + 3 * (step[1] + 1) + 9 * (step[2] + 1)] += factor;
  }
  void add(double factor, const Node& other) {
    for (int i = 0; i < 27; ++i) weight[i] += factor * other.weight[i];
  }
};

Index moved(Index step, int axis, int by) {
  step[axis] += by;
  return step;
}

/// A bulk cell among its neighbours. Cells are named by their step from it, -1, 0 or 1 per axis.
class Surroundings {
 public:
  Surroundings(const CellBlock& block, const std::vector<double>& volume, const Index& cell,
               bool boundary_check)
      : boundary_check_(boundary_check) {
    for (int i = 0; i < 27; ++i) {
      const std::ptrdiff_t place = block.place_beside(cell, {i % 3 - 1, i / 3 % 3 - 1, i / 9 - 1});
      const int slot = place < 0 ? -1 : block.slot(place);
      slot_[i] = slot >= 0 && volume[slot] > 0 ? slot : -1;
    }
  }
  const std::array<int, 27>& slots() const { return slot_; }
  bool known(const Index& step) const {
    for (const int s : step)
      if (s < -1 || s > 1) return false;
    return slot_[(step[0] + 1) + 3 * (step[1] + 1) + 9 * (step[2] + 1)] >= 0;
  }

  /// In the middle of a face of a cell.
  Node face(const Index& cell, int axis, int sign) const {
    Node node;
    if (known(moved(cell, axis, sign))) {
      node.add(0.5, cell);
      node.add(0.5, moved(cell, axis, sign));
    } else if (boundary_check_ && known(moved(cell, axis, -sign))) {
      node.add(1.5, cell);
      node.add(-0.5, moved(cell, axis, -sign));
    } else
      node.add(1, cell);
    return node;
  }

  /// At a corner of the cell in the middle: the mean of what the cells that meet there make of it.
  Node corner(const Index& sign) const {
    Node sum;
    int count = 0;
    for (int i = 0; i < 8; ++i) {
      const Index cell{i & 1 ? sign[0] : 0, i & 2 ? sign[1] : 0, i & 4 ? sign[2] : 0};
      if (!known(cell)) continue;
      ++count;
      sum.add(1, cell);
      if (!boundary_check_) continue;
      for (int axis = 0; axis < 3; ++axis) {
        sum.add(1, face(cell, axis, cell[axis] == 0 ? sign[axis] : -sign[axis]));
        sum.add(-1, cell);
      }
    }
    Node mean;
    mean.add(1.0 / count, sum);
    return mean;
  }

 private:
  std::array<int, 27> slot_;
  bool boundary_check_;
};

/// xi: of the point in the cell, -1 to 1 per axis.
Node in_pyramid(const Surroundings& around, const Vec3& xi, bool face_node) {
  int axis = 0;
  for (int other = 1; other < 3; ++other)
    if (std::abs(xi[other]) > std::abs(xi[axis])) axis = other;
  const double height = std::abs(xi[axis]);  // 0 at the centre, 1 on the face
  Node node;
  node.add(1 - height, Index{0, 0, 0});
  if (height == 0) return node;

  const int sign = xi[axis] > 0 ? 1 : -1, b = (axis + 1) % 3, c = (axis + 2) % 3;
  const double eta = xi[b] / height, zeta = xi[c] / height;
  const double tent = face_node ? 1 - std::max(std::abs(eta), std::abs(zeta)) : 0;
  for (int i = 0; i < 4; ++i) {
    Index corner;
    corner[axis] = sign;
    corner[b] = i & 1 ? 1 : -1;
    corner[c] = i & 2 ? 1 : -1;
    const double bilinear = 0.25 * (1 + corner[b] * eta) * (1 + corner[c] * zeta);
    node.add(height * (bilinear - 0.25 * tent), around.corner(corner));
  }
  if (tent > 0) node.add(height * tent, around.face({0, 0, 0}, axis, sign));
  return node;
}

Node by_distance(const Surroundings& around, const Vec3& xi, const Vec3& spacing) {
  Node node;
  double sum = 0;
  const auto add = [&](const Index& step) {
    Vec3 distance;  // in cells of the first direction: only ratios count
    for (int axis = 0; axis < 3; ++axis)
      distance[axis] = (0.5 * xi[axis] - step[axis]) * (spacing[axis] / spacing[0]);
    const double weight = 1 / std::max(norm(distance), same_point);
    node.add(weight, step);
    sum += weight;
  };
  add({0, 0, 0});
  for (int face = 0; face < 6; ++face) {
    const Index step = moved({0, 0, 0}, face / 2, face % 2 ? 1 : -1);
    if (around.known(step)) add(step);
  }
  for (double& weight : node.weight) weight /= sum;
  return node;
}

}  // namespace

BulkInterpolation::BulkInterpolation(Mapping mapping, const BulkGrid& grid, const CellBlock& block,
                                     const std::vector<double>& volume, const std::vector<Vec3>& centre,
                                     const std::vector<Subcell>& subcells) {
  const bool boundary_check = mapping == Mapping::cell_point_face;
  std::size_t subcell = 0;
  for (std::size_t fine = 0; fine < centre.size(); ++fine) {
    first_.push_back(slot_.size());
    const Index cell = grid.locate(centre[fine]);
    const int home = block.slot(block.place(cell));
    std::size_t largest = subcell;
    bool at_home = false;
    for (; subcell < subcells.size() && subcells[subcell].fine == static_cast<int>(fine); ++subcell) {
      if (subcells[subcell].volume > subcells[largest].volume) largest = subcell;
      at_home |= subcells[subcell].slot == home;
    }
    if (!at_home) {  // the centre of a cell that is not convex
      slot_.push_back(subcells[largest].slot);
      weight_.push_back(1);
      continue;
    }
    const Surroundings around(block, volume, cell, boundary_check);
    Vec3 xi = centre[fine] - grid.cell_centre(cell);
    for (int axis = 0; axis < 3; ++axis)
      xi[axis] = std::clamp(2 * xi[axis] / grid.spacing()[axis], -1.0, 1.0);
    const Node node = mapping == Mapping::inverse_distance ? by_distance(around, xi, grid.spacing())
                                                           : in_pyramid(around, xi, boundary_check);
    for (int i = 0; i < 27; ++i) {
      if (node.weight[i] == 0) continue;
      slot_.push_back(around.slots()[i]);
      weight_.push_back(node.weight[i]);
    }
  }
  first_.push_back(slot_.size());
}

std::vector<double> BulkInterpolation::evaluate(const std::vector<double>& means, int width) const {
  const std::size_t cells = first_.size() - 1;
  std::vector<double> fine(cells * width, 0.0);
  for (std::size_t cell = 0; cell < cells; ++cell)
    for (std::size_t entry = first_[cell]; entry < first_[cell + 1]; ++entry) {
      const double* mean = &means[std::size_t(slot_[entry]) * width];
      for (int m = 0; m < width; ++m) fine[cell * width + m] += weight_[entry] * mean[m];
    }
  return fine;
}

}  // namespace demvof
