// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// History force on a sphere (Basset 1888, Boussinesq 1885), for Re < 1:
//
//   F(t) = B int_0^t g(s) (t - s)^-1/2 ds      g = d(u - v)/dt      B = (3/2) d^2 sqrt(pi rho mu)
//
//   d diameter, m; rho, mu density and viscosity of the fluid, kg/m3, Pa s; u - v slip, m/s
//
// Without storing the past: the kernel of all but the present step is a sum of exponentials, the trapezoidal
// rule in x = ln r of
//
//   t^-1/2 = pi^-1/2 int exp(x/2 - t exp(x)) dx ~ sum w_k exp(-r_k t)
//
// which converges exponentially (Beylkin and Monzon, Appl. Comput. Harmon. Anal. 28 (2010) 131), and each of
// the integrals I_k of g exp(-r_k (t - s)) goes from step to step alone; van Hinsberg, ten Thije Boonkkamp
// and Clercx, J. Comput. Phys. 230 (2011) 1465, do so with fitted exponents and a stored window. Over a step
// dt with constant g:
//
//   F = B (sum w_k exp(-r_k dt) I_k + 2 sqrt(dt) g)       the step's own part exactly
//   I_k <- exp(-r_k dt) I_k + g (1 - exp(-r_k dt))/r_k
//
// so that 2 B sqrt(dt) adds to the added mass, and the acceleration is found, not extrapolated.

#include <array>
#include <cmath>

#include "coupler/base/sphere.hpp"

namespace demvof {

/// B, N s^(3/2)/m; the force is B times an acceleration times a root of time.
inline double history_factor(double diameter, double density, double viscosity) {
  return 1.5 * diameter * diameter * std::sqrt(pi * density * viscosity);
}

/// The sum of exponentials for steps of one length. Within 0.6 % of the kernel for ages from one step to 1e6.
class HistoryKernel {
 public:
  static constexpr int terms = 15;

  explicit HistoryKernel(double step) {
    constexpr double spacing = 1.3, fastest = 12;  // of x; r dt of the first term
    double rate = fastest / step;
    for (int k = 0; k + 1 < terms; ++k, rate *= std::exp(-spacing)) {
      rate_[k] = rate;
      weight_[k] = spacing * std::sqrt(rate / pi);
    }
    // What is slower in one term: the integral from r = 0 to half a spacing beyond, at its mean rate.
    const double edge = rate * std::exp(spacing / 2);
    weight_[terms - 1] = 2 * std::sqrt(edge / pi);
    rate_[terms - 1] = edge / 3;
    for (int k = 0; k < terms; ++k) {
      decay_[k] = std::exp(-rate_[k] * step);
      gain_[k] = -std::expm1(-rate_[k] * step) / rate_[k];
    }
    own_ = 2 * std::sqrt(step);
  }

  double weight(int k) const { return weight_[k]; }  // s^-1/2
  double rate(int k) const { return rate_[k]; }      // 1/s
  double decay(int k) const { return decay_[k]; }
  double gain(int k) const { return gain_[k]; }  // s
  double own() const { return own_; }            // 2 sqrt(dt), s^1/2

  /// The sum, s^-1/2; age: s.
  double operator()(double age) const {
    double sum = 0;
    for (int k = 0; k < terms; ++k) sum += weight_[k] * std::exp(-rate_[k] * age);
    return sum;
  }

 private:
  std::array<double, terms> rate_, weight_, decay_, gain_;
  double own_ = 0;
};

}  // namespace demvof
