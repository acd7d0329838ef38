// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// f(x (1 + t)) as its power series in t, up to t^3: a formula that is given one in place of a number gives
// its value and its derivatives at once, and how far from x they are those of the same branch.

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace demvof {

struct Series {
  static constexpr int terms = 4;
  std::array<double, terms> term{};
  double reach = std::numeric_limits<double>::infinity();  // largest |t|, -

  Series(double constant = 0)
      : term{constant} {}  // NOLINT(google-explicit-constructor): a number is one, too
  /// x (1 + t).
  static Series of_variable(double x) {
    Series result(x);
    result.term[1] = x;
    return result;
  }
  double at(double t) const { return (term[0] + t * term[1]) + t * t * (term[2] + t * term[3]); }
};

inline double value(double a) {
  return a;
}
inline double value(const Series& a) {
  return a.term[0];
}

/// Which branch a formula takes. The other one is not for what is told here, where its place is well known.
inline bool takes_lower(double a, double bound) {
  return a < bound;
}
inline bool takes_lower(Series& a, double bound) {
  constexpr double well_known = 0.9;
  a.reach = std::min(a.reach, well_known * std::abs(bound - a.term[0]) / std::abs(a.term[1]));
  return a.term[0] < bound;
}

inline Series operator+(Series a, const Series& b) {
  for (int k = 0; k < Series::terms; ++k) a.term[k] += b.term[k];
  a.reach = std::min(a.reach, b.reach);
  return a;
}
inline Series operator*(double factor, Series a) {
  for (double& term : a.term) term *= factor;
  return a;
}
inline Series operator*(const Series& a, double factor) {
  return factor * a;
}
inline Series operator*(const Series& a, const Series& b) {
  Series product;
  for (int k = 0; k < Series::terms; ++k)
    for (int j = 0; j <= k; ++j) product.term[k] += a.term[j] * b.term[k - j];
  product.reach = std::min(a.reach, b.reach);
  return product;
}
inline Series operator-(const Series& a) {
  return -1.0 * a;
}
inline Series operator-(const Series& a, const Series& b) {
  return a + -b;
}
inline Series operator/(const Series& a, double divisor) {
  return 1 / divisor * a;
}
inline Series operator/(Series a, const Series& b) {
  for (int k = 0; k < Series::terms; ++k) {
    for (int j = 1; j <= k; ++j) a.term[k] -= b.term[j] * a.term[k - j];
    a.term[k] /= b.term[0];
  }
  a.reach = std::min(a.reach, b.reach);
  return a;
}

// Beside those of series, for formulas of either.
using std::exp, std::log10, std::pow, std::sqrt;

/// a b' = p a' b.
inline Series pow(const Series& a, double p) {
  Series power(std::pow(a.term[0], p));
  const double per_a = 1 / a.term[0];
  for (int k = 1; k < Series::terms; ++k) {
    for (int j = 1; j <= k; ++j) power.term[k] += (p * j - (k - j)) * (per_a * a.term[j]) * power.term[k - j];
    power.term[k] *= 1.0 / k;
  }
  power.reach = a.reach;
  return power;
}
inline Series sqrt(const Series& a) {
  return pow(a, 0.5);
}
/// b' = a' b.
inline Series exp(const Series& a) {
  Series power(std::exp(a.term[0]));
  for (int k = 1; k < Series::terms; ++k) {
    for (int j = 1; j <= k; ++j) power.term[k] += j * a.term[j] * power.term[k - j];
    power.term[k] /= k;
  }
  power.reach = a.reach;
  return power;
}
inline Series pow(double base, const Series& exponent) {
  return exp(std::log(base) * exponent);
}
/// a b' = a'/ln 10.
inline Series log10(const Series& a) {
  Series logarithm(std::log10(a.term[0]));
  for (int k = 1; k < Series::terms; ++k) {
    logarithm.term[k] = k / std::log(10.0) * a.term[k];
    for (int j = 1; j < k; ++j) logarithm.term[k] -= j * logarithm.term[j] * a.term[k - j];
    logarithm.term[k] /= k * a.term[0];
  }
  logarithm.reach = a.reach;
  return logarithm;
}

}  // namespace demvof
