// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Lubrication: the film of fluid between two surfaces that approach each other is squeezed out, and sucked in
// when they part,
//
//   F = -6 pi mu a^2 h'/h        a = r_1 r_2/(r_1 + r_2) of two spheres, a = r of a sphere and a plane
//
//   h gap between the surfaces, m, much smaller than a; mu viscosity of the fluid, Pa s
//
// Reynolds's (1886) squeeze film as Taylor gave it for spheres; the leading term of the exact solution
// (Brenner 1961). It acts on gaps between two limits: above the cut-off h_c the drag law of the single sphere
// stands alone, and from the roughness h_r downwards asperities touch while the fluid gets out between them.
//
// F h' dt is an exact differential. With L(h) = ln(max(h_r, min(h, h_c))) and k = 1/m_1 + 1/m_2 the relative
// velocity v = h' of two bodies that nothing else acts on keeps
//
//   v + 6 pi mu a^2 k L(h)
//
// which is asked of every time step: v* the velocity at its end without a film,
//
//   v + 6 pi mu a^2 k (L(h + v dt) - L(h)) = v*                                                         (1)
//
// The left side grows with v: there is one solution, between 0 and v*, for any step and any viscosity. The
// film never turns a motion round and never gives energy, and what is lost between two gaps is 6 pi mu a^2 k
// times the logarithm of their ratio, whatever the steps.

#include <algorithm>
#include <cmath>

#include "coupler/base/sphere.hpp"

namespace demvof {

struct LubricationParameters {
  double cut_off = 0.1;     // h_c over the mean radius of both spheres, or over that of the sphere at a wall
  double roughness = 1e-3;  // h_r likewise
  bool suction = true;      // the film resists surfaces that part, too; false: it cavitates
};

/// 6 pi mu a^2, N s.
inline double film_resistance(double viscosity, double reduced_radius) {
  return 6 * pi * viscosity * reduced_radius * reduced_radius;
}

inline double reduced_radius(double first, double second) {
  return first * second / (first + second);
}

/// Where a film acts, m.
struct FilmLimits {
  double roughness, cut_off;

  double clamp(double gap) const { return std::clamp(gap, roughness, cut_off); }
};

/// L(h + v dt) - L(h), -, for the v of (1). gap: h, m; free: v*, m/s; resistance: 6 pi mu a^2, N s; mobility:
/// k, 1/kg; step: s.
inline double film_strain(const FilmLimits& limits, double gap, double free, double resistance,
                          double mobility, double step) {
  const double from = limits.clamp(gap);
  if (limits.clamp(gap + free * step) == from) return 0;
  const double lost = resistance * mobility;  // m/s, per unit of strain
  const double limit = free < 0 ? limits.roughness : limits.cut_off;
  const double through = std::log(limit / from);
  const double behind = free - lost * through;  // when the step leads through the limit
  if (behind * free > 0 && limits.clamp(gap + behind * step) == limit) return through;
  // The left side of (1) is concave in u = (h + v dt)/from - 1: Newton's steps from below stay below.
  const double ahead = (from - gap) / step, scale = from / step;
  double u = (free - ahead) / (scale + lost);
  u = std::max(u, limits.roughness / from - 1);
  constexpr int most_steps = 60;
  constexpr double round_off = 1e-15;
  for (int n = 0; n < most_steps; ++n) {
    const double open = scale * u + ahead + lost * std::log1p(u) - free;
    const double change = -open / (scale + lost / (1 + u));
    if (!(change > round_off * std::abs(u))) break;
    u += change;
  }
  return std::log1p(u);
}

}  // namespace demvof
