// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Four doubles in one register where the processor has such: a vector and something beside it. Programs are
// built for processors that have half of them; a function with DEMVOF_WIDE is to be called where have_wide
// says so. Products and sums are rounded one by one, in the same order with and without.

#include <cstring>

#include "coupler/base/vec3.hpp"

#if defined(__x86_64__) && defined(__GNUC__)
#define DEMVOF_WIDE [[gnu::target("avx2")]]
#else
#define DEMVOF_WIDE
#endif

namespace demvof {

#if defined(__x86_64__) && defined(__GNUC__)
inline const bool have_wide = __builtin_cpu_supports("avx2") != 0;
#else
constexpr bool have_wide = false;
#endif

using Four [[gnu::vector_size(4 * sizeof(double))]] = double;

[[gnu::always_inline]] inline void load(Four& four, const double* from) {
  std::memcpy(&four, from, sizeof(Four));
}
[[gnu::always_inline]] inline void store(double* to, const Four& four) {
  std::memcpy(to, &four, sizeof(Four));
}

[[gnu::always_inline]] inline Vec3 xyz(const Four& four) {
  return {four[0], four[1], four[2]};
}
[[gnu::always_inline]] inline double xyz_squared(const Four& four) {
  const Four squares = four * four;
  return squares[0] + squares[1] + squares[2];
}

}  // namespace demvof
