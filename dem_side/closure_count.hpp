// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace demvof {

/// How often a closure was evaluated, and how often outside the range it was fitted for.
struct ClosureCount {
  double evaluations = 0, outside = 0;
};

}  // namespace demvof
