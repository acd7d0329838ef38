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
// The same for eight doubles. Such processors could round a product and a sum as one, which no others do.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__)
#define DEMVOF_WIDEST [[gnu::target("avx512f"), gnu::optimize("fp-contract=off")]]
#else
#define DEMVOF_WIDEST
#endif

namespace demvof {

#if defined(__x86_64__) && defined(__GNUC__)
inline const bool have_wide = __builtin_cpu_supports("avx2") != 0;
#else
constexpr bool have_wide = false;
#endif
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__)
inline const bool have_widest = __builtin_cpu_supports("avx512f") != 0;
#else
constexpr bool have_widest = false;
#endif

using Four [[gnu::vector_size(4 * sizeof(double))]] = double;
using Eight [[gnu::vector_size(8 * sizeof(double))]] = double;

[[gnu::always_inline]] inline void load(Four& numbers, const double* from) {
  std::memcpy(&numbers, from, sizeof(Four));
}
[[gnu::always_inline]] inline void store(double* to, const Four& numbers) {
  std::memcpy(to, &numbers, sizeof(Four));
}
[[gnu::always_inline]] inline void load(Eight& numbers, const double* from) {
  std::memcpy(&numbers, from, sizeof(Eight));
}
[[gnu::always_inline]] inline void store(double* to, const Eight& numbers) {
  std::memcpy(to, &numbers, sizeof(Eight));
}

[[gnu::always_inline]] inline Vec3 xyz(const Four& four) {
  return {four[0], four[1], four[2]};
}
[[gnu::always_inline]] inline double xyz_squared(const Four& four) {
  const Four squares = four * four;
  return squares[0] + squares[1] + squares[2];
}

}  // namespace demvof
