// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cmath>

namespace demvof {

/// Multiples of output.interval up to a time, s.
inline double outputs_until(double time, double interval) {
  return std::floor(time / interval * (1 + 1e-9));
}

/// Fields, particles and restart data are written, by both programs, at the end of the first window that
/// reaches each multiple of output.interval. begin, end: of the one that has ended, s.
inline bool output_due(double begin, double end, double interval) {
  return interval > 0 && outputs_until(end, interval) > outputs_until(begin, interval);
}

/// The first DEM step after the one numbered `after` that reaches such a multiple. step: its length, s.
inline long next_output_step(long after, double step, double interval) {
  const double time = (outputs_until(static_cast<double>(after) * step, interval) + 1) * interval;
  return std::max(after + 1, static_cast<long>(std::ceil(time / step * (1 - 1e-9))));
}

}  // namespace demvof
