// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Sums of rows of doubles with the weights of a particle, in registers as wide as the processor has
// (base/four.hpp).

#include "coupler/base/four.hpp"

namespace demvof {

/// Rows that follow each other from first on: row a has weight factor share[a].
struct RowRun {
  int first, count;
  const double* share;
  double factor;
};

namespace row_sums {

/// Four at a time, and what is left.
template <int width>
struct Row {
  static constexpr int fours = width / 4, rest = width % 4;
  Four four[fours + 1] = {};
  double one[rest + 1] = {};

  [[gnu::always_inline]] void load(const double* from) {
#pragma GCC unroll 8
    for (int i = 0; i < fours; ++i) demvof::load(four[i], from + 4 * i);
#pragma GCC unroll 4
    for (int i = 0; i < rest; ++i) one[i] = from[4 * fours + i];
  }
  [[gnu::always_inline]] void store(double* to) const {
#pragma GCC unroll 8
    for (int i = 0; i < fours; ++i) demvof::store(to + 4 * i, four[i]);
#pragma GCC unroll 4
    for (int i = 0; i < rest; ++i) to[4 * fours + i] = one[i];
  }
  [[gnu::always_inline]] void add(double factor, const Row& row) {
#pragma GCC unroll 8
    for (int i = 0; i < fours; ++i) four[i] += factor * row.four[i];
#pragma GCC unroll 4
    for (int i = 0; i < rest; ++i) one[i] += factor * row.one[i];
  }
};

template <int width>
[[gnu::always_inline]] inline void spread(const RowRun* runs, int count, const double* from, double* rows) {
  Row<width> row, sum;
  row.load(from);
  for (const RowRun* run = runs; run != runs + count; ++run) {
    double* to = rows + static_cast<long>(run->first) * width;
    for (int a = 0; a < run->count; ++a, to += width) {
      sum.load(to);
      sum.add(run->share[a] * run->factor, row);
      sum.store(to);
    }
  }
}

template <int width>
[[gnu::always_inline]] inline void gather(const RowRun* runs, int count, const double* rows, double* to) {
  Row<width> sum, row;
  for (const RowRun* run = runs; run != runs + count; ++run) {
    const double* from = rows + static_cast<long>(run->first) * width;
    Row<width> along;  // sums that do not wait for each other
    for (int a = 0; a < run->count; ++a, from += width) {
      row.load(from);
      along.add(run->share[a], row);
    }
    sum.add(run->factor, along);
  }
  sum.store(to);
}

template <int width>
DEMVOF_WIDE void spread_wide(const RowRun* runs, int count, const double* row, double* rows) {
  spread<width>(runs, count, row, rows);
}
template <int width>
DEMVOF_WIDE void gather_wide(const RowRun* runs, int count, const double* rows, double* row) {
  gather<width>(runs, count, rows, row);
}

}  // namespace row_sums

/// rows += weight row, for the rows of all runs.
template <int width>
void spread_row(const RowRun* runs, int count, const double* row, double* rows) {
  have_wide ? row_sums::spread_wide<width>(runs, count, row, rows)
            : row_sums::spread<width>(runs, count, row, rows);
}

/// row = sum of weight rows.
template <int width>
void gather_rows(const RowRun* runs, int count, const double* rows, double* row) {
  have_wide ? row_sums::gather_wide<width>(runs, count, rows, row)
            : row_sums::gather<width>(runs, count, rows, row);
}

}  // namespace demvof
