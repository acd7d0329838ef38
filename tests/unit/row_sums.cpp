// SPDX-License-Identifier: GPL-3.0-or-later
#include "coupler/transfer/row_sums.hpp"

#include <gtest/gtest.h>

#include <random>
#include <vector>

namespace demvof {
namespace {

template <int width>
void expect_same_sums_in_wide_registers() {
  std::mt19937 random(5);
  std::uniform_real_distribution<> uniform(-1, 1);
  constexpr int particles = 6, cells = 5;  // of the particles four and two; of the rows some are not touched
  std::vector<double> rows(9 * width), from(particles * width), weight(particles * cells);
  for (std::vector<double>* numbers : {&rows, &from, &weight})
    for (double& number : *numbers) number = uniform(random);
  const std::vector<int> slot{0, 2, 3, 8, 6};
  const WeightBlock block{particles, cells, slot.data(), weight.data()};
  std::vector<double> spread = rows, expected = rows, sum(particles * width);
  row_sums::spread<Four, width>(block, from.data(), spread.data());
  row_sums::gather<Four, width>(block, rows.data(), sum.data());
  const auto expect_same = [&](auto&& spread_other, auto&& gather_other) {
    std::vector<double> spread_there = rows, sum_there(particles * width);
    spread_other(block, from.data(), spread_there.data());
    gather_other(block, rows.data(), sum_there.data());
    EXPECT_EQ(spread, spread_there);
    EXPECT_EQ(sum, sum_there);
  };
  expect_same(spread_rows<width>, gather_rows<width>);
  if (have_wide) expect_same(row_sums::spread_wide<width>, row_sums::gather_wide<width>);
  for (int i = 0; i < particles; ++i)
    for (int m = 0; m < width; ++m) {
      double mean = 0;
      for (int c = 0; c < cells; ++c) {
        expected[slot[c] * width + m] += weight[i * cells + c] * from[i * width + m];
        mean += weight[i * cells + c] * rows[slot[c] * width + m];
      }
      EXPECT_NEAR(sum[i * width + m], mean, 2e-15);
    }
  for (std::size_t i = 0; i < rows.size(); ++i) EXPECT_NEAR(spread[i], expected[i], 2e-15);
}

TEST(RowSums, TheSameInWideRegisters) {
  expect_same_sums_in_wide_registers<8>();
  expect_same_sums_in_wide_registers<16>();
  expect_same_sums_in_wide_registers<32>();
}

}  // namespace
}  // namespace demvof
