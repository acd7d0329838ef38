// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// A particle's own disturbance of the fluid velocity that it is given.
//
// Drag laws want the velocity u_inf that the fluid would have at the particle without it. What is sampled
// from the bulk grid contains the fluid that the particle itself drags along, so that drag comes out too
// small. Far from walls, and slow against the slip U = |u_inf - v|, this disturbance obeys Oseen's equation
// with the particle's reaction beta U spread as the averaging does, here as a Gaussian of standard deviation
// s per axis for deposit and sampling together. At the particle, steady, it is psi U towards v:
//
//   psi = beta Phi(Re_s) / (mu s),   Re_s = rho U s / mu
//   Phi = (1/4 pi^2) int_0^inf exp(-q^2/2) int_-1^1 (1 - x^2) q^2 / (q^2 + Re_s^2 x^2) dx dq
//   Phi -> sqrt(pi/2) / (3 pi^2)   Re_s -> 0 (regularised Stokeslet)
//   Phi -> 1 / (4 pi Re_s)         Re_s -> infinity (momentum of a wake of section 4 pi s^2)
//
// and u_sampled - v = (1 - psi) (u_inf - v). The integral is replaced by a rational function that is within
// 0.033 % of it for every Re_s. Balachandar, Liu and Lakhote, J. Comput. Phys. 376 (2019) 160-185, correct in
// this way with the steady solution for a Gaussian; Evrard, Denner and van Wachem, J. Comput. Phys. X 8
// (2020) 100078, with regularised Stokeslets and Oseen's factor. Holds for s of at least a diameter, one
// particle, a void fraction near
// 1. Unsteady: the wake needs a time of the order of the shorter of rho s^2/mu and s/U to form.

#include "coupler/base/series.hpp"
#include "coupler/base/sphere.hpp"

namespace demvof {

/// psi, -; 0 without drag. beta: drag factor, kg/s; density, kg/m3; viscosity, Pa s; slip: U, m/s; width: s,
/// m.
template <class Number>
Number own_wake_share(Number beta, double density, double viscosity, Number slip, double width) {
  if (value(beta) == 0) return 0;
  constexpr double stokes = 0.042329090622827;            // Phi(0)
  constexpr double oseen = 4 * pi * stokes;               // makes the limit of large Re_s
  constexpr double p = 0.76247724, q = 1.64147899;        // fitted
  const Number inertia = oseen * density * slip * width;  // Pa s; with x = inertia / mu:
  // Phi = stokes (1 + p x) / (1 + q x + p x^2)
  const Number mobility =
      (viscosity + p * inertia) / (viscosity * viscosity + q * inertia * viscosity + p * inertia * inertia);
  return beta * stokes * mobility / width;
}

}  // namespace demvof
