// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Drag factor beta of one sphere: the fluid's drag on it is beta (u - v).
//
//   beta = (pi d^2 / 8) C_d rho |u - v|,     Re = rho |u - v| d / mu
//
// d diameter, m; rho, mu density and viscosity of the fluid, kg/m3, Pa s; |u - v| slip, m/s.
//
// Every law below says for which range it was fitted, whether u is the interstitial velocity (of
// the fluid between the particles) or the superficial one (eps times that), and whether it belongs
// to pressure model A (the pressure gradient force -V grad p comes on top of the drag, eps in front
// of grad p in the fluid's equation) or to B.

#include <cmath>

namespace demvof {

/// Schiller and Naumann, Z. Ver. Dtsch. Ing. 77 (1935) 318, as in Pozzetti & Peters (2017), eq. 33:
///
///   C_d = 24 (1 + 0.15 Re^0.687) / Re   Re < 1000
///   C_d = 0.44                          otherwise (Newton's range, up to Re = 2e5)
///
/// One sphere far from others: eps does not enter, interstitial and superficial velocity are the
/// same, and with model A's pressure gradient force nothing is counted twice. Below Re = 1000 the
/// slip cancels, which leaves 3 pi mu d (1 + 0.15 Re^0.687): defined at rest, and Stokes's drag.
/// Returns beta, kg/s, for d > 0 and rho, mu, slip >= 0.
inline double schiller_naumann(double diameter, double density, double viscosity, double slip) {
  constexpr double pi = 3.14159265358979323846;
  const double inertia = density * slip * diameter;  // Re mu
  if (inertia < 1000 * viscosity)
    return 3 * pi * viscosity * diameter * (1 + 0.15 * std::pow(inertia / viscosity, 0.687));
  return pi / 8 * 0.44 * inertia * diameter;
}

}  // namespace demvof
