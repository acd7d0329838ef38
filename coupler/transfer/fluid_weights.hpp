// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <utility>
#include <vector>

#include "coupler/grid/bulk_cells.hpp"
#include "coupler/transfer/kernel_weights.hpp"

namespace demvof {

/// The weights of the particles in one of the fluids,
///
///   w_ick = w_ic s_ck n_ik,   n_ik = 1 / sum over c of w_ic s_ck      s_ck: share of the fluid in cell c, -
///
/// of which w_ic is stored once for all fluids. Rows are made and taken one particle at a time: those of all
/// particles together are larger than what the sums need.
class FluidWeights {
 public:
  /// all: must outlive this, or the next set(). share: per touched cell, -; empty: 1 in all of them.
  void set(const KernelWeights& all, std::vector<double> share = {}) {
    all_ = &all;
    share_ = std::move(share);
    factor_.clear();
    if (share_.empty()) return;
    factor_.reserve(all.particles());
    for (int particle = 0; particle < all.particles(); ++particle) {
      double sum = 0;
      for (int entry = all.first[particle]; entry < all.first[particle + 1]; ++entry)
        sum += all.weight[entry] * share_[all.slot[entry]];
      factor_.push_back(sum > 0 ? 1 / sum : 0);
    }
  }

  int particles() const { return all_ ? all_->particles() : 0; }
  /// False for a particle with no cell that has this fluid: no weights.
  bool reaches(int particle) const { return factor_.empty() || factor_[particle] > 0; }

  /// visit(slot of a touched cell, weight), for each weight of the particle that is not 0.
  template <class Visit>
  void for_each_cell(int particle, const Visit& visit) const {
    if (!reaches(particle)) return;
    const int last = all_->first[particle + 1];
    if (factor_.empty()) {
      for (int entry = all_->first[particle]; entry < last; ++entry)
        visit(all_->slot[entry], all_->weight[entry]);
      return;
    }
    const double factor = factor_[particle];
    for (int entry = all_->first[particle]; entry < last; ++entry)
      if (const double share = share_[all_->slot[entry]]; share > 0)
        visit(all_->slot[entry], factor * share * all_->weight[entry]);
  }

  /// Sum over particles of w row(particle), per touched cell; row is asked for those that reach the fluid.
  template <class Row, class RowOf>
  std::vector<Row> deposit(const RowOf& row_of) const {
    std::vector<Row> cells(all_ ? all_->cells.size() : 0, zero<Row>());
    for (int particle = 0; particle < particles(); ++particle) {
      if (!reaches(particle)) continue;
      const Row row = row_of(particle);
      for_each_cell(particle, [&](int slot, double weight) { add(weight, row, cells[slot]); });
    }
    return cells;
  }

  /// Sum over the particle's cells of w cells[c]: the transpose of deposit().
  template <class Row>
  Row sample(const std::vector<Row>& cells, int particle) const {
    Row sum = zero<Row>();
    for_each_cell(particle, [&](int slot, double weight) { add(weight, cells[slot], sum); });
    return sum;
  }

  /// Sum of w^2 of the particle, -.
  double squares(int particle) const {
    double sum = 0;
    for_each_cell(particle, [&](int, double weight) { sum += weight * weight; });
    return sum;
  }

 private:
  template <class Row>
  static void add(double weight, const Row& row, Row& sum) {
    const auto* from = reinterpret_cast<const double*>(&row);
    auto* to = reinterpret_cast<double*>(&sum);
    for (int m = 0; m < row_width<Row>(); ++m) to[m] += weight * from[m];
  }
  template <class Row>
  static Row zero() {  // members may start with another value
    Row row{};
    auto* numbers = reinterpret_cast<double*>(&row);
    for (int m = 0; m < row_width<Row>(); ++m) numbers[m] = 0;
    return row;
  }

  const KernelWeights* all_ = nullptr;
  std::vector<double> share_;   // s_ck per touched cell
  std::vector<double> factor_;  // n_ik per particle; 0: it reaches no such cell
};

}  // namespace demvof
