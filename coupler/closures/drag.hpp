// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Drag factor beta of a sphere among others: the fluid's drag on it is beta (u - v).
//
//   beta = 3 pi mu d eps F(eps, Re)      Re = rho eps |u - v| d / mu      (superficial velocity)
//
//   d diameter, m        rho, mu density and viscosity of the fluid, kg/m3, Pa s
//   eps void fraction, - u, v velocity between the particles and of the particle, |u - v| slip, m/s
//   F drag over Stokes's drag at the superficial velocity eps |u - v|, -
//
// All laws are given in this one form, whatever their authors used: slip of the velocity between the
// particles (interstitial), and pressure model A, in which the particle also feels -V grad p and the
// fluid's equation has eps in front of grad p. In a uniform bed at rest the force balance of the fluid
// gives total force = drag + pressure force = drag/eps, and a law fitted to the total force (model B,
// pressure drop of a bed) is multiplied by eps. Each law below says what its source has.
//
// What is needed: d, mu > 0, rho, slip >= 0, 0 < eps <= 1. Every law is finite and positive there;
// whether it means anything is told by its range.
//
// Slip: double, or Series, which gives the derivatives with the value (coupler/base/series.hpp).

#include <cmath>

#include "coupler/base/series.hpp"
#include "coupler/base/sphere.hpp"

namespace demvof {

/// Where a law was fitted; -. Re is the superficial one above.
struct DragRange {
  double largest_reynolds, smallest_void_fraction, largest_void_fraction;

  bool contains(double reynolds, double void_fraction) const {
    return reynolds <= largest_reynolds && void_fraction >= smallest_void_fraction &&
           void_fraction <= largest_void_fraction;
  }
};

template <class Slip>
Slip superficial_reynolds(double diameter, double density, double viscosity, const Slip& slip,
                          double void_fraction) {
  return density * void_fraction * slip * diameter / viscosity;
}

/// 3 pi mu d, kg/s.
inline double stokes_factor(double diameter, double viscosity) {
  return 3 * pi * viscosity * diameter;
}

/// Where single spheres, and Wen and Yu's suspension, change over to Newton's range, with a jump of 0.4 %.
constexpr double branch_reynolds = 1000;

/// Schiller and Naumann, Z. Ver. Dtsch. Ing. 77 (1935) 318, as in Pozzetti & Peters (2017), eq. 33:
///
///   C_d = 24 (1 + 0.15 Re^0.687) / Re   Re < 1000        Re = rho |u - v| d / mu
///   C_d = 0.44                          otherwise (Newton's range, up to Re = 2e5)
///   beta = (pi d^2 / 8) C_d rho |u - v|
///
/// One sphere far from others: eps does not enter, interstitial and superficial velocity are the
/// same, and with model A's pressure gradient force nothing is counted twice. Below Re = 1000 the
/// slip cancels, which leaves 3 pi mu d (1 + 0.15 Re^0.687): defined at rest, Stokes's drag, and
/// defined for mu = 0 too. The range ends where eps^-2.65 (below) is as large as the fit's scatter of 5 %.
constexpr DragRange schiller_naumann_range{2e5, 0.98, 1};
template <class Slip>
Slip schiller_naumann(double diameter, double density, double viscosity, Slip slip,
                      double /*void_fraction*/ = 1) {
  Slip inertia = density * slip * diameter;  // Re mu
  if (takes_lower(inertia, branch_reynolds * viscosity))
    return stokes_factor(diameter, viscosity) * (1 + 0.15 * pow(inertia / viscosity, 0.687));
  return pi / 8 * 0.44 * inertia * diameter;
}

/// Gidaspow, Multiphase Flow and Fluidization (1994): Ergun's bed below eps = 0.8, Wen and Yu above.
///
///   eps <= 0.8   F = (150 (1 - eps) + 1.75 Re) / (18 eps^2)
///   eps >  0.8   F = (C_d Re / 24) eps^-3.65,   C_d of Schiller and Naumann at the superficial Re
///
/// Ergun, Chem. Eng. Prog. 48 (1952) 89, has the pressure drop of a bed (total force, superficial
/// velocity): times eps. Wen and Yu, Chem. Eng. Prog. Symp. Ser. 62 (1966) 100, have eps^-4.65 for the
/// total force at the superficial velocity, which is the same. Gidaspow's own form is model A.
/// The two branches do not meet: at eps = 0.8 Wen and Yu's lies below Ergun's by 13 % for Re -> 0, 5 %
/// at Re = 10, 42 % at Re = 100 and 73 % from Re = 1000 on (tests/unit/closures.cpp). The jump is left as
/// it is; no blend between the two is added.
/// Ergun's columns: eps 0.36 to 0.6, Re/(1 - eps) up to 2500.
constexpr DragRange gidaspow_range{1500, 0.36, 1};
template <class Slip>
Slip gidaspow(double diameter, double density, double viscosity, Slip slip, double eps) {
  Slip reynolds = superficial_reynolds(diameter, density, viscosity, slip, eps);
  Slip over_stokes = 0;
  if (eps <= 0.8)
    over_stokes = (150 * (1 - eps) + 1.75 * reynolds) / (18 * eps * eps);
  else if (takes_lower(reynolds, branch_reynolds))
    over_stokes = (1 + 0.15 * pow(reynolds, 0.687)) * pow(eps, -3.65);
  else
    over_stokes = 0.44 / 24 * reynolds * pow(eps, -3.65);
  return stokes_factor(diameter, viscosity) * eps * over_stokes;
}

/// C_d Re / 24 of a single sphere after Dallavalle (1948): C_d = (0.63 + 4.8 Re^-0.5)^2. 4 % below
/// Stokes's drag for Re -> 0.
template <class Slip>
Slip dallavalle_over_stokes(const Slip& reynolds) {
  const Slip root = 0.63 * sqrt(reynolds) + 4.8;
  return root * root / 24;
}

/// exp(-(1.5 - log10 Re)^2 / 2), the dip of the voidage exponent around Re = 30; 0 for Re = 0.
template <class Slip>
Slip voidage_dip(const Slip& reynolds) {
  if (value(reynolds) == 0) return 0;
  const Slip distance = 1.5 - log10(reynolds);
  return exp(-distance * distance / 2);
}

/// Di Felice, Int. J. Multiphase Flow 20 (1994) 153:
///
///   F = (C_d Re / 24) eps^-chi,   chi = 3.7 - 0.65 exp(-(1.5 - log10 Re)^2 / 2),   C_d of Dallavalle
///
/// Source: superficial velocity, drag without the pressure gradient force (model A; with chi + 1 it is
/// the total force of model B). Beds and suspensions, eps 0.4 to 1, Re 0.01 to 1e4.
constexpr DragRange di_felice_range{1e4, 0.4, 1};
template <class Slip>
Slip di_felice(double diameter, double density, double viscosity, Slip slip, double eps) {
  const Slip reynolds = superficial_reynolds(diameter, density, viscosity, slip, eps);
  const Slip exponent = 3.7 - 0.65 * voidage_dip(reynolds);
  return stokes_factor(diameter, viscosity) * eps * dallavalle_over_stokes(reynolds) * pow(eps, -exponent);
}

/// Hill, Koch and Ladd, J. Fluid Mech. 448 (2001) 213 and 243; Koch and Hill, Annu. Rev. Fluid Mech. 33
/// (2001) 619. phi = 1 - eps:
///
///   F = eps (F_0 + F_3 Re/2)
///   F_0 = (1 + 3 sqrt(phi/2) + (135/64) phi ln phi + 16.14 phi) / (1 + 0.681 phi - 8.48 phi^2 + 8.16 phi^3)
///         for phi < 0.4,   10 phi / eps^3 (Carman) otherwise
///   F_3 = 0.0673 + 0.212 phi + 0.0232 / eps^5
///
/// Source: total force on spheres in lattice-Boltzmann flows, superficial velocity, Re with the radius:
/// hence eps in front and Re/2. The form linear in Re is used for every Re, as usual in CFD-DEM; the
/// source has a quadratic first effect of inertia (Re < 20). phi up to 0.641, Re/2 up to 100.
constexpr DragRange koch_hill_range{200, 0.359, 1};
template <class Slip>
Slip koch_hill(double diameter, double density, double viscosity, Slip slip, double eps) {
  const Slip reynolds = superficial_reynolds(diameter, density, viscosity, slip, eps);
  const double phi = 1 - eps;
  double slow = 1;
  if (phi >= 0.4)
    slow = 10 * phi / (eps * eps * eps);
  else if (phi > 0)
    slow = (1 + 3 * std::sqrt(phi / 2) + 135.0 / 64 * phi * std::log(phi) + 16.14 * phi) /
           (1 + phi * (0.681 + phi * (-8.48 + phi * 8.16)));
  const double inertial = 0.0673 + 0.212 * phi + 0.0232 / (eps * eps * eps * eps * eps);
  return stokes_factor(diameter, viscosity) * eps * eps * (slow + inertial * reynolds / 2);
}

/// Beetstra, van der Hoef and Kuipers, AIChE J. 53 (2007) 489, erratum 53 (2007) 3020. phi = 1 - eps:
///
///   F = 10 phi/eps^2 + eps^2 (1 + 1.5 sqrt(phi))
///       + (0.413 Re / (24 eps^2)) (1/eps + 3 phi eps + 8.4 Re^-0.343) / (1 + 10^(3 phi) Re^-(1 + 4 phi)/2)
///
/// Source: superficial velocity, drag without the pressure gradient force (total force times eps), which
/// is model A. Lattice-Boltzmann, phi 0.1 to 0.6, Re up to 1000. For eps -> 1 it is above a single
/// sphere's drag, by 16 % at Re = 100 and 69 % at Re = 1000. Of several sizes: size_mix.hpp.
constexpr DragRange beetstra_range{1000, 0.4, 0.9};
template <class Slip>
Slip beetstra(double diameter, double density, double viscosity, Slip slip, double eps) {
  const Slip reynolds = superficial_reynolds(diameter, density, viscosity, slip, eps);
  const double phi = 1 - eps, square = eps * eps;
  const double slow = 10 * phi / square + square * (1 + 1.5 * std::sqrt(phi));
  const Slip power = pow(reynolds, (1 + 4 * phi) / 2);  // moves Re's negative powers out of sight
  const Slip inertial = 0.413 / (24 * square) *
                        (reynolds * (1 / eps + 3 * phi * eps) + 8.4 * pow(reynolds, 0.657)) * power /
                        (power + std::pow(10.0, 3 * phi));
  return stokes_factor(diameter, viscosity) * eps * (slow + inertial);
}

/// Rong, Dong and Yu, Chem. Eng. Sci. 99 (2013) 44:
///
///   F = (C_d Re / 24) eps^-chi,   C_d of Dallavalle
///   chi = 2.65 (eps + 1) - (5.3 - 3.5 eps) eps^2 exp(-(1.5 - log10 Re)^2 / 2)
///
/// Source: superficial velocity, drag without the pressure gradient force (model A). Lattice-Boltzmann
/// flows through packed beds, eps from 0.37, Re up to 3000.
constexpr DragRange rong_range{3000, 0.37, 1};
template <class Slip>
Slip rong(double diameter, double density, double viscosity, Slip slip, double eps) {
  const Slip reynolds = superficial_reynolds(diameter, density, viscosity, slip, eps);
  const Slip exponent = 2.65 * (eps + 1) - (5.3 - 3.5 * eps) * eps * eps * voidage_dip(reynolds);
  return stokes_factor(diameter, viscosity) * eps * dallavalle_over_stokes(reynolds) * pow(eps, -exponent);
}

}  // namespace demvof
