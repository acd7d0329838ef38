// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Drag on one particle, integrated exactly over a time step in which beta and the other forces are
// constant:
//
//   m dv/dt = beta (u - v) + F      v(t + dt) = u + F/beta + (v(t) - u - F/beta) exp(-x),   x = beta dt/m
//
//   mean drag over the step = m (v(t + dt) - v(t))/dt - F = beta phi (u - v(t)) + (phi - 1) F
//   phi = (1 - exp(-x))/x
//
// The particle never overshoots u + F/beta, however large x is, and beta = 0 needs no special case.
//
// Added mass m_a = C_m rho V, the force m_a (Du/Dt - dv/dt), joins with no further approximation: in
//
//   (m + m_a) dv/dt = beta (u - v) + (F + m_a Du/Dt)
//
// m + m_a stands for m and F + m_a Du/Dt for F. The acceleration is found, not extrapolated: stable for
// particles as light as wished.

#include <algorithm>
#include <cmath>

#include "coupler/base/series.hpp"
#include "coupler/base/vec3.hpp"

namespace demvof {

/// (1 - exp(-x))/x for x >= 0; 1 at x = 0.
inline double mean_decay(double x) {
  const double square = x * x;
  if (x < 1e-2)  // x^6/5040 left out; in pairs that do not wait for each other
    return 1 -
           x * ((1.0 / 2 - x * (1.0 / 6)) + square * ((1.0 / 24 - x * (1.0 / 120)) + square * (1.0 / 720)));
  return -std::expm1(-x) / x;
}

/// Mean drag over a step, N. beta: kg/s; pull: beta (u - v) at its start, N; other: F, N; mass: m or m + m_a,
/// kg; step, s.
inline Vec3 implicit_drag(double beta, const Vec3& pull, const Vec3& other, double mass, double step) {
  const double phi = mean_decay(beta * step / mass);
  return phi * pull + (phi - 1) * other;
}

/// n = d ln(beta s)/d ln s, -: a change ds of the slip changes the drag by n beta ds. 1 in Stokes's range, 2
/// in Newton's.
inline double drag_exponent(const Series& beta) {
  return beta.term[0] > 0 ? std::clamp(1 + beta.term[1] / beta.term[0], 1.0, 2.0) : 1;
}

/// theta, -: how much of its own inertia is left to a free particle over a window (s), 1 without drag, 0 when
/// it follows the fluid at once. tangent: n beta, kg/s; inertia: m + m_a, kg.
inline double inertial_share(double tangent, double inertia, double window) {
  return mean_decay(tangent * window / inertia);
}

/// beta_eff, kg/s: change of what a particle takes from the fluid, per time, with the fluid velocity; so it
/// goes by the tangent n beta of the drag, not by the secant beta. A free particle follows the fluid,
/// (m/window)(1 - exp(-n beta window/(m + m_a))): of the momentum it gains the added mass m_a is the fluid's
/// own. One held by contacts does not follow, n beta.
/// contact_fraction: part of the window it spent in contact, 0 .. 1. other: tangent of the drag in the other
/// fluid, which the particle follows as well, kg/s.
inline double drag_response(double tangent, double mass, double window, double contact_fraction,
                            double added_mass = 0, double other = 0) {
  const double inertia = mass + added_mass;
  const double free = mass / inertia * tangent * mean_decay((tangent + other) * window / inertia);
  return contact_fraction * tangent + (1 - contact_fraction) * free;
}

}  // namespace demvof
