// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// When and how the two sides exchange momentum; meanings: momentum_exchange.hpp, relaxation.hpp,
// window_rule.hpp.

namespace demvof {

enum class Schedule { staggered, concurrent };
enum class ExchangeScheme { explicit_drag, semi_implicit, conservative_implicit };  // YAML: explicit, ...
/// Windows as long as their error allows, instead of all the same.
struct AdaptiveWindow {
  double tolerance = 0;              // of the velocity that a particle hears of a window late, m/s
  double shortest = 0, longest = 0;  // s
};
enum class Sharing { volume, mass };  // weights of the fine cells of a bulk cell: 1 or eps rho

}  // namespace demvof
