// SPDX-License-Identifier: GPL-3.0-or-later
#include "dem_side/rigid_drag.hpp"

#include <algorithm>
#include <cmath>

#include "dem_side/implicit_drag.hpp"

namespace demvof {
namespace {

using Vector6 = std::array<double, 6>;

Vector6 vector6(const Motion& m) {
  return {m.linear.x, m.linear.y, m.linear.z, m.angular.x, m.angular.y, m.angular.z};
}
Motion motion(const Vector6& v) {
  return {{v[0], v[1], v[2]}, {v[3], v[4], v[5]}};
}

Vector6 product(const Matrix6& a, const Vector6& x) {
  Vector6 result{};
  for (int i = 0; i < 6; ++i)
    for (int j = 0; j < 6; ++j) result[i] += a[i][j] * x[j];
  return result;
}
Vector6 transposed_product(const Matrix6& a, const Vector6& x) {
  Vector6 result{};
  for (int i = 0; i < 6; ++i)
    for (int j = 0; j < 6; ++j) result[i] += a[j][i] * x[j];
  return result;
}
Matrix6 congruent(const Matrix6& g, const Matrix6& a) {  // g^T a g
  Matrix6 half{}, result{};
  for (int i = 0; i < 6; ++i)
    for (int k = 0; k < 6; ++k)
      for (int j = 0; j < 6; ++j) half[i][j] += a[i][k] * g[k][j];
  for (int k = 0; k < 6; ++k)
    for (int i = 0; i < 6; ++i)
      for (int j = 0; j < 6; ++j) result[i][j] += g[k][i] * half[k][j];
  return result;
}

/// B of W = B B^T.
Matrix6 mobility_root(const RigidBody& body) {
  Matrix6 root{};
  for (int i = 0; i < 3; ++i) {
    root[i][i] = 1 / std::sqrt(body.mass);
    for (int axis = 0; axis < 3; ++axis)
      if (body.turned[i] && body.inertia[axis] > 0)
        root[3 + i][3 + axis] = body.axis[axis][i] / std::sqrt(body.inertia[axis]);
  }
  return root;
}

/// B <- B C^-T, C C^T = 1 + s.
void divide_by_root(Matrix6& b, Matrix6 s) {
  for (int i = 0; i < 6; ++i) s[i][i] += 1;
  for (int j = 0; j < 6; ++j) {  // C in place
    for (int i = j; i < 6; ++i) {
      for (int k = 0; k < j; ++k) s[i][j] -= s[i][k] * s[j][k];
      s[i][j] = i == j ? std::sqrt(s[j][j]) : s[i][j] / s[j][j];
    }
  }
  for (auto& row : b)
    for (int j = 0; j < 6; ++j) {
      for (int k = 0; k < j; ++k) row[j] -= row[k] * s[j][k];
      row[j] /= s[j][j];
    }
}

/// Jacobi's rotations: a becomes diagonal, the columns of the result its eigenvectors.
Matrix6 diagonalise(Matrix6& a) {
  Matrix6 q{};
  for (int i = 0; i < 6; ++i) q[i][i] = 1;
  for (int sweep = 0; sweep < 30; ++sweep) {
    double off = 0, all = 0;
    for (int i = 0; i < 6; ++i)
      for (int j = 0; j < 6; ++j) {
        all += a[i][j] * a[i][j];
        off += i != j ? a[i][j] * a[i][j] : 0;
      }
    if (off <= 1e-31 * all) break;
    for (int i = 0; i < 5; ++i)
      for (int j = i + 1; j < 6; ++j) {
        if (a[i][j] == 0) continue;
        const double half = 0.5 * (a[j][j] - a[i][i]) / a[i][j];
        const double t = std::copysign(1.0, half) / (std::abs(half) + std::sqrt(half * half + 1));
        const double c = 1 / std::sqrt(t * t + 1), s = t * c;
        for (int k = 0; k < 6; ++k) {
          const double first = a[k][i], second = a[k][j];
          a[k][i] = c * first - s * second, a[k][j] = s * first + c * second;
        }
        for (int k = 0; k < 6; ++k) {
          const double first = a[i][k], second = a[j][k];
          a[i][k] = c * first - s * second, a[j][k] = s * first + c * second;
        }
        a[i][j] = a[j][i] = 0;
        for (auto& row : q) {
          const double first = row[i], second = row[j];
          row[i] = c * first - s * second, row[j] = s * first + c * second;
        }
      }
  }
  return q;
}

/// psi = (1 - phi)/x: of the change that a constant force would make in a step, its mean over the step.
double mean_of_change(double x) {
  return x < 1e-2 ? 1.0 / 2 - x * (1.0 / 6 - x * (1.0 / 24 - x * (1.0 / 120 - x * (1.0 / 720))))
                  : (1 - mean_decay(x)) / x;
}

/// psi(X) h for a symmetric X without negative eigenvalues.
Vector6 mean_of_change(Matrix6 x, const Vector6& h) {
  double trace = 0;
  for (int i = 0; i < 6; ++i) trace += x[i][i];
  Vector6 result;
  if (trace < 1e-2) {  // by the series: the rule in water
    const double coefficients[] = {1.0 / 120, 1.0 / 24, 1.0 / 6, 1.0 / 2};
    for (int i = 0; i < 6; ++i) result[i] = h[i] / 720;
    for (const double c : coefficients) {
      const Vector6 next = product(x, result);
      for (int i = 0; i < 6; ++i) result[i] = c * h[i] - next[i];
    }
    return result;
  }
  const Matrix6 q = diagonalise(x);
  result = transposed_product(q, h);
  for (int i = 0; i < 6; ++i) result[i] *= mean_of_change(std::max(x[i][i], 0.0));
  return product(q, result);
}

}  // namespace

Vec3 RigidBody::spin() const {
  Vec3 spin;
  for (int i = 0; i < 3; ++i)
    if (inertia[i] > 0) spin += dot(axis[i], angular_momentum) / inertia[i] * axis[i];
  return spin;
}

void add_place(Matrix6& sum, double c, const Vec3& arm) {
  const double r[3] = {arm.x, arm.y, arm.z}, square = dot(arm, arm);
  for (int i = 0; i < 3; ++i) {
    sum[i][i] += c;
    sum[3 + i][3 + i] += c * square;
    for (int j = 0; j < 3; ++j) sum[3 + i][3 + j] -= c * r[i] * r[j];
    const int next = (i + 1) % 3, last = (i + 2) % 3;
    sum[3 + i][next] -= c * r[last], sum[next][3 + i] -= c * r[last];
    sum[3 + i][last] += c * r[next], sum[last][3 + i] += c * r[next];
  }
}

RigidStep rigid_step(const RigidBody& body, const Matrix6& drag, const Matrix6& added_mass,
                     const Motion& pull_and_others, double step) {
  Matrix6 g = mobility_root(body);
  if (added_mass[0][0] > 0) divide_by_root(g, congruent(g, added_mass));
  Matrix6 x = congruent(g, drag);
  for (auto& row : x)
    for (double& value : row) value *= step;
  const Vector6 h = transposed_product(g, vector6(pull_and_others));
  Vector6 change = mean_of_change(x, h);
  Vector6 rate = product(x, change);
  for (int i = 0; i < 6; ++i) {
    rate[i] = h[i] - rate[i];  // phi = 1 - x psi
    change[i] *= step;
  }
  return {motion(product(g, change)), motion(product(g, rate))};
}

}  // namespace demvof
