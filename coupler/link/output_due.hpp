// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cmath>

namespace demvof {

/// Fields, particles and restart data are written, by both programs, at the end of the first window that
/// reaches each multiple of output.interval. window: number of the one that has ended, from 1; lengths in s.
inline bool output_due(long window, double window_length, double interval) {
  if (interval <= 0) return false;
  const auto multiples = [&](long windows) {
    return std::floor(static_cast<double>(windows) * window_length / interval * (1 + 1e-9));
  };
  return multiples(window) > multiples(window - 1);
}

}  // namespace demvof
