// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

#include "coupler/grid/bulk_cells.hpp"
#include "coupler/transfer/kernel_weights.hpp"
#include "coupler/transfer/row_sums.hpp"

namespace demvof {

/// A record in whole eights, all of them 0 to begin with, whatever members start with.
template <class Record>
struct alignas(8 * sizeof(double)) InEights {
  InEights() { std::fill_n(reinterpret_cast<double*>(this), row_width<InEights>(), 0.0); }
  Record row;
};

/// The weights of the particles in one of the fluids,
///
///   w_ick = w_ic s_ck n_ik,   n_ik = 1 / sum over c of w_ic s_ck      s_ck: share of the fluid in cell c, -
///
/// of which w_ic is stored once for all fluids. n_ik goes with the particle's rows and s_ck with the cells',
/// so that what is left is w_ic: a product of three where the kernel is one.
class FluidWeights {
 public:
  /// all: must outlive this, or the next set(). share: per touched cell, -; empty: 1 in all of them.
  void set(const KernelWeights& all, std::vector<double> share = {}) {
    all_ = &all;
    share_ = std::move(share);
    kinds_.clear();
    factor_.clear();
    for (const KernelWeights::Group& group : all.groups()) {
      kinds_.push_back(kind_of(group));
      if (kinds_.back() < 0) continue;
      const WeightBlock block = all.find(group, found_);
      const double* weight = block.weight;
      for (int i = 0; i < group.count; ++i, weight += block.cells) {
        double sum = 0;
        for (int cell = 0; cell < block.cells; ++cell) sum += weight[cell] * share_[block.slot[cell]];
        factor_.push_back(sum > 0 ? 1 / sum : 0);
      }
    }
  }

  int particles() const { return all_ ? all_->particles() : 0; }
  /// False for a particle with no cell that has this fluid: no weights.
  bool reaches(int particle) const {
    const KernelWeights::Group& group = all_->group_of(particle);
    return factor(group, kind(group), particle) > 0;
  }

  /// visit(slot of a touched cell, weight), for each weight of the particle that is not 0.
  template <class Visit>
  void for_each_cell(int particle, const Visit& visit) const {
    const KernelWeights::Group& group = all_->group_of(particle);
    const double of_particle = factor(group, kind(group), particle);
    if (!(of_particle > 0)) return;
    all_->for_each_cell(particle, [&](int slot, double weight) {
      if (kind(group) == in_all)
        visit(slot, weight);
      else if (share_[slot] > 0)
        visit(slot, of_particle * share_[slot] * weight);
    });
  }
  /// Sum over particles of w row(particle), per touched cell; row is asked for those that reach the fluid.
  template <class Row, class RowOf>
  std::vector<Row> deposit(const RowOf& row_of) const {
    std::vector<InEights<Row>> cells(all_ ? all_->cells().size() : 0), rows;
    for (const KernelWeights::Group& group : groups()) {
      const Kind kind = this->kind(group);
      if (kind == in_none) continue;
      rows.assign(group.count, {});
      bool any = false;
      for (int i = 0; i < group.count; ++i) {
        const double factor = this->factor(group, kind, group.first + i);
        if (!(factor > 0)) continue;
        rows[i].row = row_of(group.first + i);
        any |= !is_zero(rows[i].row);
        if (kind != in_all) scale(factor, rows[i].row);
      }
      if (any)
        spread_rows<row_width<InEights<Row>>()>(all_->find(group, found_), numbers(rows[0]),
                                                numbers(cells[0]));
    }
    std::vector<Row> sums;
    sums.reserve(cells.size());
    for (std::size_t cell = 0; cell < cells.size(); ++cell) {
      sums.push_back(cells[cell].row);
      if (!share_.empty()) scale(share_[cell], sums.back());
    }
    return sums;
  }

  /// Sums over a particle's cells of w cells[c]: the transpose of deposit(). Found for a group when one of it
  /// is asked for.
  template <class Row>
  class Samples {
   public:
    /// cells: what they offer; they count with their shares of the fluid.
    Samples(const FluidWeights& weights, const std::vector<Row>& cells) : weights_(weights) {
      cells_.resize(cells.size());
      for (std::size_t cell = 0; cell < cells.size(); ++cell) {
        cells_[cell].row = cells[cell];
        if (!weights.share_.empty()) scale(weights.share_[cell], cells_[cell].row);
      }
    }
    const Row& operator()(int particle) {
      if (particle < first_ || particle >= first_ + static_cast<int>(rows_.size()))
        find(weights_.all_->group_of(particle));
      return rows_[particle - first_].row;
    }

   private:
    void find(const KernelWeights::Group& group) {
      const Kind kind = weights_.kind(group);
      first_ = group.first;
      rows_.assign(group.count, {});
      if (kind == in_none) return;
      gather_rows<row_width<InEights<Row>>()>(weights_.all_->find(group, weights_.found_), numbers(cells_[0]),
                                              numbers(rows_[0]));
      for (int i = 0; kind != in_all && i < group.count; ++i)
        scale(weights_.factor(group, kind, first_ + i), rows_[i].row);
    }

    const FluidWeights& weights_;
    std::vector<InEights<Row>> cells_, rows_;  // rows_: of the group
    int first_ = 0;
  };
  /// Until the next set().
  template <class Row>
  Samples<Row> samples(const std::vector<Row>& cells) const {
    return Samples<Row>(*this, cells);
  }

  /// Sum of w^2 of the particle, -.
  double squares(int particle) const {
    if (kind(all_->group_of(particle)) == in_all) return all_->squares(particle);
    double sum = 0;
    for_each_cell(particle, [&](int, double weight) { sum += weight * weight; });
    return sum;
  }

 private:
  /// What a group's cells have of the fluid: all is its own, nothing, or some of them some; then the factors
  /// of its particles begin there.
  using Kind = std::ptrdiff_t;
  static constexpr Kind in_all = -1, in_none = -2;

  Kind kind_of(const KernelWeights::Group& group) {
    if (share_.empty()) return in_all;
    all_->find_slots(group, found_.slots);
    double least = 1, most = 0;
    for (const int slot : found_.slots) {
      least = std::min(least, share_[slot]);
      most = std::max(most, share_[slot]);
    }
    return least == 1 ? in_all : most > 0 ? static_cast<Kind>(factor_.size()) : in_none;
  }
  const std::vector<KernelWeights::Group>& groups() const { return all_ ? all_->groups() : none_; }
  Kind kind(const KernelWeights::Group& group) const { return kinds_[&group - groups().data()]; }
  double factor(const KernelWeights::Group& group, Kind kind, int particle) const {
    return kind == in_all ? 1 : kind == in_none ? 0 : factor_[kind + particle - group.first];
  }

  // Records are plain rows of doubles.
  template <class Row>
  static double* numbers(Row& row) {
    return reinterpret_cast<double*>(&row);
  }
  template <class Row>
  static const double* numbers(const Row& row) {
    return reinterpret_cast<const double*>(&row);
  }
  template <class Row>
  static void scale(double factor, Row& row) {
    for (int m = 0; m < row_width<Row>(); ++m) numbers(row)[m] *= factor;
  }
  template <class Row>
  static bool is_zero(const Row& row) {
    return std::all_of(numbers(row), numbers(row) + row_width<Row>(),
                       [](double number) { return number == 0; });
  }

  inline static const std::vector<KernelWeights::Group> none_;
  const KernelWeights* all_ = nullptr;
  std::vector<double> share_;           // s_ck per touched cell
  std::vector<Kind> kinds_;             // of the groups
  std::vector<double> factor_;          // n_ik of the particles of some of them; 0: it reaches no such cell
  mutable KernelWeights::Found found_;  // of one group
};

}  // namespace demvof
