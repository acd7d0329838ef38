// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Gravity as a function of time, in the frame of the walls: what shakes a tank with the acceleration a(t)
// acts inside it as g - a(t).
//
//   g_w = 1/dt_w  integral of g(t) over the window     g(t): piecewise linear, constant outside the table
//
// Fluid and particles have g_w in the whole window, from the same numbers: their weights balance in every one
// of their steps, and over the run each has got the integral of g.

#include <algorithm>
#include <vector>

#include "coupler/base/vec3.hpp"

namespace demvof {

struct GravityTable {
  struct Row {
    double time = 0;  // s
    Vec3 gravity;     // m/s2
  };
  std::vector<Row> rows;  // one at least; times increase

  /// g(t), m/s2. time: s.
  Vec3 at(double time) const {
    const auto next = after(time);
    if (next == rows.begin()) return rows.front().gravity;
    if (next == rows.end()) return rows.back().gravity;
    const Row& last = *(next - 1);
    return last.gravity + (time - last.time) / (next->time - last.time) * (next->gravity - last.gravity);
  }

  /// Mean over a time that is longer than 0, m/s2; exact, and where g is constant g to the last bit.
  Vec3 mean(double begin, double end) const {
    const Vec3 first = at(begin);
    double time = begin;
    Vec3 before, sum;  // g less the first one, m/s2; its integral, m/s
    const auto add = [&](double to, const Vec3& gravity) {
      const Vec3 now = gravity - first;
      sum += 0.5 * (to - time) * (before + now);
      time = to;
      before = now;
    };
    for (auto row = after(begin); row != rows.end() && row->time < end; ++row) add(row->time, row->gravity);
    add(end, at(end));
    return first + 1 / (end - begin) * sum;
  }

 private:
  /// The first row behind a time.
  std::vector<Row>::const_iterator after(double time) const {
    return std::upper_bound(rows.begin(), rows.end(), time,
                            [](double t, const Row& row) { return t < row.time; });
  }
};

}  // namespace demvof
