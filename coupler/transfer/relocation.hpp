// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <utility>
#include <vector>

#include "coupler/grid/bulk_cells.hpp"
#include "coupler/transfer/cell_neighbourhood.hpp"

namespace demvof {

/// Shares of what bulk cells hold that count in cells beside them. gather() is the transpose of spread():
/// what particles bring moves with their volume, and what the fluid tells them comes back in the same shares.
/// A sequence of rounds; in each, cells give to face neighbours. Every call is collective.
class Relocation {
 public:
  /// What one of this rank's cells gives in a round.
  struct Gift {
    int cell;            // place in around.cells()
    double share;        // of what it holds, to each that receives
    unsigned receivers;  // bit f: the neighbour at face f
  };
  /// What one of them receives.
  struct Receipt {
    int cell, giver;  // place in around.cells(); slot of the neighbour
    double share;     // of what that holds
  };
  struct Round {
    std::vector<Gift> gifts;
    std::vector<Receipt> receipts;
  };

  Relocation() = default;
  Relocation(std::shared_ptr<const CellNeighbourhood> around, std::vector<Round> rounds)
      : around_(std::move(around)), rounds_(std::move(rounds)) {}

  /// The same on all ranks.
  bool empty() const { return rounds_.empty(); }

  /// Sums over particles after the move. owned: any of this rank's cells; returned: those and the ones that
  /// receive.
  template <class T>
  CellValues<T> spread(const CellValues<T>& owned) const {
    Dense<T> cells = dense(owned);
    for (const Round& round : rounds_) {
      const std::vector<T> beside = around_->share(cells.values);
      for (const Gift& gift : round.gifts)
        scale(cells.values[gift.cell], 1 - gift.share * __builtin_popcount(gift.receivers));
      for (const Receipt& receipt : round.receipts) {
        add(cells.values[receipt.cell], receipt.share, beside[receipt.giver]);
        cells.known[receipt.cell] = true;
      }
    }
    return sparse(cells);
  }
  /// What cells offer to the particles that were in them. Cells that are not in owned offer T{}.
  template <class T>
  CellValues<T> gather(const CellValues<T>& owned) const {
    Dense<T> cells = dense(owned);
    for (auto round = rounds_.rbegin(); round != rounds_.rend(); ++round) {
      const std::vector<T> beside = around_->share(cells.values);
      for (const Gift& gift : round->gifts) {
        T& value = cells.values[gift.cell];
        scale(value, 1 - gift.share * __builtin_popcount(gift.receivers));
        for (int face = 0; face < 6; ++face)
          if (gift.receivers >> face & 1) add(value, gift.share, beside[around_->beside()[gift.cell][face]]);
        cells.known[gift.cell] = true;
      }
    }
    return sparse(cells);
  }

 private:
  template <class T>
  struct Dense {
    std::vector<T> values;
    std::vector<char> known;
  };
  template <class T>
  Dense<T> dense(const CellValues<T>& owned) const {
    const std::size_t cells = around_->cells().size();
    Dense<T> all{std::vector<T>(cells), std::vector<char>(cells)};
    for (std::size_t i = 0; i < owned.cells.size(); ++i) {
      const std::size_t place = around_->place(owned.cells[i]);
      all.values[place] = owned.values[i];
      all.known[place] = true;
    }
    return all;
  }
  template <class T>
  CellValues<T> sparse(const Dense<T>& all) const {
    CellValues<T> owned;
    for (std::size_t c = 0; c < all.values.size(); ++c)
      if (all.known[c]) {
        owned.cells.push_back(around_->cells()[c]);
        owned.values.push_back(all.values[c]);
      }
    return owned;
  }
  // Records are plain rows of doubles.
  template <class T>
  static void scale(T& record, double factor) {
    double* row = reinterpret_cast<double*>(&record);
    for (int i = 0; i < row_width<T>(); ++i) row[i] *= factor;
  }
  template <class T>
  static void add(T& record, double factor, const T& other) {
    double* row = reinterpret_cast<double*>(&record);
    const double* more = reinterpret_cast<const double*>(&other);
    for (int i = 0; i < row_width<T>(); ++i) row[i] += factor * more[i];
  }

  std::shared_ptr<const CellNeighbourhood> around_;
  std::vector<Round> rounds_;
};

}  // namespace demvof
