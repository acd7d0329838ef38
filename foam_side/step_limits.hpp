// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// What a time step of the fluid should not exceed.
//
//   Courant     Co = dt/2 sum_faces |phi| / (eps V)            at most maxCo, at the interface maxAlphaCo
//   capillary   dt = sqrt((rho_1 + rho_2) dx^3 / (4 pi sigma)) shortest wave on the smallest cell, dx =
//   V^(1/3)
//                                                              Brackbill, Kothe & Zemach 1992
//
// The clock keeps the first (advance_clock.cpp); the second is shown to the user, as interFoam does not keep
// it.

#include <algorithm>

#include "foam_side/flow.hpp"

namespace demvof {

/// Courant number per second of the present flux, 1/s; anywhere, and where 0.01 < alpha < 0.99.
struct CourantRates {
  double anywhere = 0, interface = 0;
};
CourantRates courant_rates(const Flow& flow);

/// As controlDict states them.
struct StepLimits {
  explicit StepLimits(const Foam::dictionary& control)
      : adjust(control.lookupOrDefault("adjustTimeStep", false)),
        courant(control.lookupOrDefault<scalar>("maxCo", 1)),
        interface_courant(control.get<scalar>("maxAlphaCo")),
        step(control.lookupOrDefault<scalar>("maxDeltaT", Foam::GREAT)) {}
  bool adjust;
  double courant, interface_courant;
  double step;  // s

  /// How many times longer a step with these Courant numbers could be.
  double room(const CourantRates& numbers) const {
    return std::min(courant / (numbers.anywhere + Foam::SMALL),
                    interface_courant / (numbers.interface + Foam::SMALL));
  }
};

/// Of the fluid, s; without windows that of the start. window: the longest.
double longest_step(const Flow& flow, double window);

/// s; 0 without surface tension. Collective.
double capillary_step(const Flow& flow, double surface_tension);

}  // namespace demvof
