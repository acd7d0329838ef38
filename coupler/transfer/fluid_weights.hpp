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
    factor_.clear();
    if (share_.empty()) return;
    factor_.reserve(all.particles());
    for (int particle = 0; particle < all.particles(); ++particle) {
      const double sum = kernel_mean(share_, particle);
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
    all_->for_each_cell(particle, [&](int slot, double weight) {
      if (factor_.empty())
        visit(slot, weight);
      else if (share_[slot] > 0)
        visit(slot, factor_[particle] * share_[slot] * weight);
    });
  }

  /// Sum over particles of w row(particle), per touched cell; row is asked for those that reach the fluid.
  template <class Row, class RowOf>
  std::vector<Row> deposit(const RowOf& row_of) const {
    std::vector<Row> cells(all_ ? all_->cells().size() : 0, zero<Row>());
    for (int particle = 0; particle < particles(); ++particle) {
      if (!reaches(particle)) continue;
      Row row = row_of(particle);
      if (is_zero(row)) continue;
      if (!factor_.empty()) scale(factor_[particle], row);
      all_->find_runs(particle, runs_);
      spread_row<row_width<Row>()>(runs_.data(), static_cast<int>(runs_.size()), numbers(row),
                                   numbers(cells[0]));
    }
    for (std::size_t cell = 0; cell < share_.size(); ++cell) scale(share_[cell], cells[cell]);
    return cells;
  }

  /// What cells offer, to be sampled: with their shares of the fluid.
  template <class Row>
  std::vector<Row> offered(std::vector<Row> cells) const {
    for (std::size_t cell = 0; cell < share_.size(); ++cell) scale(share_[cell], cells[cell]);
    return cells;
  }
  /// Sum over the particle's cells of w cells[c], offered(cells) given: the transpose of deposit().
  template <class Row>
  Row sample(const std::vector<Row>& cells, int particle) const {
    if (!reaches(particle)) return zero<Row>();
    Row sum = kernel_mean(cells, particle);
    if (!factor_.empty()) scale(factor_[particle], sum);
    return sum;
  }

  /// Sum of w^2 of the particle, -.
  double squares(int particle) const {
    double sum = 0;
    for_each_cell(particle, [&](int, double weight) { sum += weight * weight; });
    return sum;
  }

 private:
  /// Sum of w_ic cells[c].
  template <class Row>
  Row kernel_mean(const std::vector<Row>& cells, int particle) const {
    Row sum;
    all_->find_runs(particle, runs_);
    gather_rows<row_width<Row>()>(runs_.data(), static_cast<int>(runs_.size()), numbers(cells[0]),
                                  numbers(sum));
    return sum;
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
  template <class Row>
  static Row zero() {  // members may start with another value
    Row row{};
    std::fill_n(numbers(row), row_width<Row>(), 0.0);
    return row;
  }

  const KernelWeights* all_ = nullptr;
  std::vector<double> share_;         // s_ck per touched cell
  mutable std::vector<RowRun> runs_;  // of one particle
  std::vector<double> factor_;        // n_ik per particle; 0: it reaches no such cell
};

}  // namespace demvof
