// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// What the fluid is expected to do in a window, continued from the window before: coupling.order 2.
//
//   D = w (u - u_before) dt_w/dt_w,before     expected change of the fluid over the coming window
//
//   told    u_seen + D/2                      the fluid of the window's middle
//   u_ref   u_felt + (t/dt_w - 1/2) D         at the time t in the window: u_seen + D at its end
//
// Told the fluid of the window's start, particles feel it half a window late, and the implicit part
// C (u_ref - u) hands back an impulse of first order a window later still. Continued, the drag impulse is
// that of the window's mean and the fluid's expected course is what the implicit part does not act on: what
// is left of either is of second order. Du/Dt is that of the last window, and is continued to the middle of
// the next: by a whole change, w_a of it. So is grad p without porosity; with it, what the pressure owes
// (owed_pressure.hpp) comes to the same.
//
// Where particles and fluid push each other about, a continued fluid grows. So the weights go to 0 with the
// omega of relaxation.hpp, and that of the acceleration before three times the reaction of the added mass,
// C_m s, s = eps_s/eps, is the fluid's own inertia:
//
//   w = max(0, 1 - 4 (1 - omega)),   w_a = w min(1, max(0, 2 - 8 C_m s))
//
// 1 where nothing is relaxed, 0 where more than a quarter is. No disturbance of the linear map of one window
// grows then which does not with w = 0 (tests/unit/continuation.cpp). A steady state has D = 0.
// docs/theory.md, docs/decisions/order_in_the_window.md.

#include <algorithm>

namespace demvof {

/// w, -, in [0, 1]. relaxation: omega.
inline double continuation_weight(double relaxation) {
  return std::max(0.0, 1 - 4 * (1 - relaxation));
}
/// w_a over w, -. reaction: C_m s.
inline double continued_acceleration(double reaction) {
  return std::clamp(2 - 8 * reaction, 0.0, 1.0);
}

}  // namespace demvof
