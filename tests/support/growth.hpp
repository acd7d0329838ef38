// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace demvof {

/// Growth per window in the long run of a linear map from window to window: its spectral radius, from its
/// 2^32nd power. advance: takes and returns a State, std::array<double, n>.
template <class State, class Advance>
double growth_of(const Advance& advance) {
  constexpr std::size_t n = std::tuple_size_v<State>;
  using Matrix = std::array<State, n>;
  Matrix a;
  for (std::size_t column = 0; column < n; ++column) {
    State unit{};
    unit[column] = 1;
    const State image = advance(unit);
    for (std::size_t row = 0; row < n; ++row) a[row][column] = image[row];
  }
  double log_size = 0;
  constexpr int squarings = 32;
  for (int s = 0; s < squarings; ++s) {
    Matrix square{};
    double size = 0;
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t j = 0; j < n; ++j) {
        for (std::size_t l = 0; l < n; ++l) square[i][j] += a[i][l] * a[l][j];
        size = std::max(size, std::abs(square[i][j]));
      }
    if (size == 0) return 0;
    for (State& row : square)
      for (double& value : row) value /= size;
    a = square;
    log_size = 2 * log_size + std::log(size);
  }
  return std::exp(log_size / std::pow(2.0, squarings));
}

}  // namespace demvof
