// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// When and how the two sides exchange momentum; meanings: momentum_exchange.hpp, relaxation.hpp.

namespace demvof {

enum class Schedule { staggered, concurrent };
enum class ExchangeScheme { explicit_drag, semi_implicit, conservative_implicit };  // YAML: explicit, ...
enum class Sharing { volume, mass };  // weights of the fine cells of a bulk cell: 1 or eps rho

}  // namespace demvof
