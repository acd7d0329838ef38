// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Sums of rows of doubles with the weights of particles, in registers as wide as the processor has
// (base/four.hpp): rows are whole numbers of eights.

#include "coupler/base/four.hpp"

namespace demvof {

/// Weights of particles that reach the same cells, one particle after the other.
struct WeightBlock {
  int particles, cells;
  const int* slot;       // of each cell
  const double* weight;  // of particle i in cell c: weight[i * cells + c]
};

namespace row_sums {

/// As many at a time as go into one register.
template <class Numbers, int width>
struct Row {
  static constexpr int in_one = sizeof(Numbers) / sizeof(double), count = width / in_one;
  static_assert(width % in_one == 0);
  Numbers numbers[count] = {};

  [[gnu::always_inline]] void load(const double* from) {
#pragma GCC unroll 8
    for (int i = 0; i < count; ++i) demvof::load(numbers[i], from + in_one * i);
  }
  [[gnu::always_inline]] void store(double* to) const {
#pragma GCC unroll 8
    for (int i = 0; i < count; ++i) demvof::store(to + in_one * i, numbers[i]);
  }
  [[gnu::always_inline]] void add(double factor, const Row& row) {
#pragma GCC unroll 8
    for (int i = 0; i < count; ++i) numbers[i] += factor * row.numbers[i];
  }
};

template <class Numbers, int width>
[[gnu::always_inline]] inline void spread(const WeightBlock& block, const double* from, double* rows) {
  for (int cell = 0; cell < block.cells; ++cell) {
    double* to = rows + static_cast<long>(block.slot[cell]) * width;
    Row<Numbers, width> sum, row;
    sum.load(to);
    const double* next = from;
    const double* weight = block.weight + cell;
    for (int i = 0; i < block.particles; ++i, next += width, weight += block.cells) {
      row.load(next);
      sum.add(*weight, row);
    }
    sum.store(to);
  }
}

/// For so many particles at once, that do not wait for each other.
template <class Numbers, int width, int at_once>
[[gnu::always_inline]] inline void gather_some(const WeightBlock& block, int first, const double* rows,
                                               double* to) {
  Row<Numbers, width> sum[at_once], row;
  const double* weight = block.weight + first * block.cells;
  for (int cell = 0; cell < block.cells; ++cell) {
    row.load(rows + static_cast<long>(block.slot[cell]) * width);
#pragma GCC unroll 4
    for (int i = 0; i < at_once; ++i) sum[i].add(weight[i * block.cells + cell], row);
  }
#pragma GCC unroll 4
  for (int i = 0; i < at_once; ++i) sum[i].store(to + (first + i) * width);
}

template <class Numbers, int width>
[[gnu::always_inline]] inline void gather(const WeightBlock& block, const double* rows, double* to) {
  constexpr int at_once = 4;
  int first = 0;
  for (; first + at_once <= block.particles; first += at_once)
    gather_some<Numbers, width, at_once>(block, first, rows, to);
  for (; first < block.particles; ++first) gather_some<Numbers, width, 1>(block, first, rows, to);
}

template <int width>
DEMVOF_WIDE void spread_wide(const WeightBlock& block, const double* from, double* rows) {
  spread<Four, width>(block, from, rows);
}
template <int width>
DEMVOF_WIDEST void spread_widest(const WeightBlock& block, const double* from, double* rows) {
  spread<Eight, width>(block, from, rows);
}
template <int width>
DEMVOF_WIDE void gather_wide(const WeightBlock& block, const double* rows, double* to) {
  gather<Four, width>(block, rows, to);
}
template <int width>
DEMVOF_WIDEST void gather_widest(const WeightBlock& block, const double* rows, double* to) {
  gather<Eight, width>(block, rows, to);
}

}  // namespace row_sums

/// rows += weight row, for the cells of all particles; from: a row of each particle.
template <int width>
void spread_rows(const WeightBlock& block, const double* from, double* rows) {
  using namespace row_sums;
  (have_widest ? spread_widest<width>
   : have_wide ? spread_wide<width>
               : spread<Four, width>)(block, from, rows);
}

/// Sum of weight rows, a row for each particle.
template <int width>
void gather_rows(const WeightBlock& block, const double* rows, double* to) {
  using namespace row_sums;
  (have_widest ? gather_widest<width>
   : have_wide ? gather_wide<width>
               : gather<Four, width>)(block, rows, to);
}

}  // namespace demvof
