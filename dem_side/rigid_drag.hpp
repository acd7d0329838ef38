// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Drag on a rigid body that fluid holds at several places r_i from its centre of mass, integrated exactly
// over a time step in which beta_i, u_i, the other forces and the body's orientation are constant:
// implicit_drag.hpp with velocity and spin V = (v, w) in place of v, force and torque F in place of F.
//
//   dV/dt = W (P - R (V - V(t)) + F - M_a dV/dt)      velocity of place i: v + w x r_i = J_i V
//
//   W     1/m, and the inverse of the moment of inertia
//   P, R  sums of J_i^T beta_i (u_i - J_i V(t)) and of J_i^T beta_i J_i;  M_a: of J_i^T m_ai J_i
//
// With W = B B^T, 1 + B^T M_a B = C C^T and G = B C^-T it is h' = G^T (P + F) - A h, V = V(t) + G h, with
// A = G^T R G symmetric and without a negative eigenvalue: its modes decay each by itself, none overshoots,
// and a drag whose centre is not that of mass turns what it stops, for any step and any beta.

#include <array>

#include "coupler/base/vec3.hpp"

namespace demvof {

/// Velocity and spin, their rates, or force and torque.
struct Motion {
  Vec3 linear, angular;

  Vec3 at(const Vec3& arm) const { return linear + cross(angular, arm); }
  void act(const Vec3& force, const Vec3& arm) {
    linear += force;
    angular += cross(arm, force);
  }
};

struct RigidBody {
  double mass = 0;                                  // kg
  std::array<double, 3> inertia = {};               // about its axes, kg m2; 0: not turned about it
  std::array<Vec3, 3> axis = {};                    // principal
  Vec3 angular_momentum;                            // kg m2/s
  std::array<bool, 3> turned = {true, true, true};  // components of that which torques change

  Vec3 spin() const;  // rad/s
};

/// Symmetric in all uses here.
using Matrix6 = std::array<std::array<double, 6>, 6>;

/// sum += c J^T J of a place.
void add_place(Matrix6& sum, double c, const Vec3& arm);

/// What a step does to a body.
struct RigidStep {
  Motion mean_change;   // of V: mean over the step less V at its start
  Motion acceleration;  // mean
};
RigidStep rigid_step(const RigidBody& body, const Matrix6& drag, const Matrix6& added_mass,
                     const Motion& pull_and_others, double step);

}  // namespace demvof
