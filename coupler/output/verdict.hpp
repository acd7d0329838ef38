// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "coupler/config/parameters.hpp"
#include "coupler/output/results.hpp"

namespace demvof {

/// Whether what a run computed can be true. Wrong physics is no completed run: first it is a warning, and
/// beyond reason a failure.
struct Verdict {
  std::vector<std::string> warnings;
  std::optional<std::string> failure;  // what is beyond reason, and what to try
};

/// The largest of the run.
struct Fastest {
  double courant = 0;  // cells that the fluid crossed in a step
  double speed = 0;    // of the fluid in a cell, m/s
};

/// At the end of a run.
/// exchange_closes: the exchange scheme gives the fluid what the particles got (not semi_implicit).
Verdict judge(const RunResults& results, const LimitParameters& limits, const Fastest& fastest,
              bool exchange_closes = true);

/// In the run: the first of the recorded quantities that is not a number, and what to try. Empty: all are.
std::string find_nonsense(const std::vector<std::pair<std::string, double>>& quantities);

}  // namespace demvof
