// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Viscosity of a suspension over that of its liquid, mu_r, with the solid fraction phi:
//
//   krieger_dougherty   (1 - phi/phi_m)^(-2.5 phi_m)              Trans. Soc. Rheol. 3 (1959) 137
//   eilers              (1 + 1.25 phi / (1 - phi/phi_m))^2        Kolloid-Z. 97 (1941) 313
//
// phi_m = 0.64, random close packing. Both go over into Einstein's 1 + 2.5 phi; at 5 % they give 1.139
// and 1.140, Batchelor and Green's (J. Fluid Mech. 56 (1972) 401) 1 + 2.5 phi + 5.2 phi^2 1.138. Spheres that
// go with a slow flow of their liquid: a bed that is held does not shear.

#include <algorithm>
#include <cmath>

#include "coupler/closures/force_parameters.hpp"

namespace demvof {

/// mu_r, -. Above the solid fraction of 0.6 its value there (84 and 169): the law goes to infinity at phi_m.
inline double relative_viscosity(SuspensionViscosity law, double solid_fraction) {
  constexpr double packed = 0.64, largest = 0.6;
  const double phi = std::clamp(solid_fraction, 0.0, largest);
  if (law == SuspensionViscosity::krieger_dougherty) return std::pow(1 - phi / packed, -2.5 * packed);
  if (law == SuspensionViscosity::eilers) {
    const double root = 1 + 1.25 * phi / (1 - phi / packed);
    return root * root;
  }
  return 1;
}

}  // namespace demvof
