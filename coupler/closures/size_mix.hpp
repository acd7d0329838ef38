// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Share of a particle in the drag of a bed of several sizes.
//
//   beta_i = (d_i/d_32) s_i beta(d_32)      s_i = (y + 0.064 y^3) / (1 + 0.064 z)
//   y = d_i/d_32      d_32 = sum V / sum (V/d)      z = (sum V d / sum V) / d_32
//
//   d_i diameter of the particle, m; sums over the particles around it, V their volumes, m3; beta(d_32) drag
//   factor of a bed of equal spheres of the Sauter diameter d_32, the mean surface's
//
// Van der Hoef, Beetstra and Kuipers, J. Fluid Mech. 528 (2005) 233, and Beetstra, van der Hoef and Kuipers,
// AIChE J. 53 (2007) 489 give the total force on a sphere of size i, over that of equal spheres, as
//
//   eps y + (1 - eps) y^2 + 0.064 eps y^3           (times d_i/d_32)
//
// Of it the pressure gradient, which acts on the volume, has (1 - eps) y^2: model A's drag is what is left,
// y + 0.064 y^3 (the erratum, 53 (2007) 3020, has the difference between the models). The sum over a bed of y
// alone is that of equal spheres of d_32. The fitted cubic term is not: it leaves equal spheres with 1.064 of
// their own law; 1 + 0.064 z is what makes the sum right for every mixture. Fitted up to a ratio of sizes
// of 4.

namespace demvof {

/// Of the particles around one; zero: not known, all like the one.
struct SizeMix {
  double sauter_diameter = 0;  // d_32, m
  double coarseness = 1;       // z, -; 1 for equal sizes
};

/// s_i, -; ratio: y, coarseness: z.
inline double size_share(double ratio, double coarseness) {
  constexpr double cubic = 0.064;
  return (ratio + cubic * ratio * ratio * ratio) / (1 + cubic * coarseness);
}

/// True where the fit has been made.
inline bool size_ratio_known(double ratio) {
  return ratio >= 0.25 && ratio <= 4;
}

}  // namespace demvof
