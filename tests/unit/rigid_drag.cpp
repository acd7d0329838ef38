// SPDX-License-Identifier: GPL-3.0-or-later
#include "dem_side/rigid_drag.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "dem_side/implicit_drag.hpp"

namespace {

using demvof::add_place;
using demvof::Matrix6;
using demvof::Motion;
using demvof::RigidBody;
using demvof::Vec3;

struct Place {
  Vec3 arm;
  double beta, added;
  Vec3 fluid;
};

/// Axes along none of the case's.
RigidBody body() {
  const double c = std::cos(0.4), s = std::sin(0.4);
  RigidBody body;
  body.mass = 5e-5;
  body.inertia = {2e-11, 9e-11, 1e-10};
  body.axis = {Vec3{c, s, 0}, Vec3{-s * c, c * c, s}, Vec3{s * s, -c * s, c}};
  return body;
}

std::vector<Place> places(double beta) {
  return {{{1e-3, 2e-4, 0}, beta, 1e-5, {0.1, 0, 0}},
          {{-1e-3, 5e-4, 3e-4}, 3 * beta, 2e-5, {0, 0.1, 0.2}},
          {{0, -6e-4, 8e-4}, 0.1 * beta, 0, {0, 0, -0.1}}};
}

struct State {
  Motion velocity;
  void step(const RigidBody& body, const std::vector<Place>& places, const Motion& others, double length) {
    Matrix6 drag{}, added{};
    Motion forces = others;
    for (const Place& place : places) {
      add_place(drag, place.beta, place.arm);
      add_place(added, place.added, place.arm);
      forces.act(place.beta * (place.fluid - velocity.at(place.arm)), place.arm);
    }
    const demvof::RigidStep step = demvof::rigid_step(body, drag, added, forces, length);
    velocity.linear += length * step.acceleration.linear;
    velocity.angular += length * step.acceleration.angular;
  }
};

const Motion others{{1e-4, -2e-4, 3e-4}, {1e-8, 2e-8, -1e-8}}, start{{0.01, 0.02, -0.3}, {10, -20, 5}};

// One step or many: what it solves, it solves exactly.
TEST(RigidDrag, DoesNotDependOnTheStep) {
  for (const double beta : {0.0, 1e-6, 1e-3, 1e-1, 10.0}) {
    const auto end = [&](int steps) {
      State state{start};
      for (int n = 0; n < steps; ++n) state.step(body(), places(beta), others, 1e-3 / steps);
      return state.velocity;
    };
    const Motion one = end(1), many = end(17);
    EXPECT_LT(norm(one.linear - many.linear), 1e-12) << beta;
    EXPECT_LT(norm(one.angular - many.angular), 1e-9) << beta;
  }
}

// What it solves is Newton's and Euler's law with the drag and the added mass of the places: small explicit
// steps come to the same, at first order.
TEST(RigidDrag, SolvesTheEquationsOfMotion) {
  const double beta = 2e-2, length = 1e-3;
  State exact{start};
  exact.step(body(), places(beta), others, length);
  const auto error = [&](int steps) {
    Motion now = start, rate;
    for (int n = 0; n < steps; ++n) {
      for (int pass = 0; pass < 200; ++pass) {  // the added mass's share of the acceleration
        Motion sum = others;
        for (const Place& place : places(beta))
          sum.act(place.beta * (place.fluid - now.at(place.arm)) - place.added * rate.at(place.arm),
                  place.arm);
        const RigidBody whole = body();
        RigidBody turned = whole;
        turned.angular_momentum = sum.angular;
        rate = {0.5 * (rate.linear + sum.linear / whole.mass), 0.5 * (rate.angular + turned.spin())};
      }
      now.linear += length / steps * rate.linear;
      now.angular += length / steps * rate.angular;
    }
    return norm(now.linear - exact.velocity.linear) + 1e-3 * norm(now.angular - exact.velocity.angular);
  };
  EXPECT_LT(error(4000), 1e-4);
  EXPECT_NEAR(error(2000) / error(4000), 2, 0.1);
}

// At one place, the centre, it is the sphere's.
TEST(RigidDrag, IsThatOfASphereAtItsCentre) {
  const double beta = 0.3, added = 1e-5, length = 1e-4;
  Matrix6 drag{}, mass{};
  add_place(drag, beta, {});
  add_place(mass, added, {});
  const Vec3 pull{2e-3, 0, -1e-2}, force{0, 1e-4, 0};
  const Vec3 acceleration =
      demvof::rigid_step(body(), drag, mass, {pull + force, {}}, length).acceleration.linear;
  const double whole = body().mass + added;
  const Vec3 sphere = (demvof::implicit_drag(beta, pull, force, whole, length) + force) / whole;
  EXPECT_LT(norm(acceleration - sphere), 1e-13 * norm(sphere));
}

// In a fluid at rest energy decays, over 16 decades of beta and as many of the step.
TEST(RigidDrag, NeverGivesEnergy) {
  const auto energy = [](const Motion& velocity) {
    const RigidBody whole = body();
    double turning = 0;
    for (int i = 0; i < 3; ++i)
      turning += whole.inertia[i] * std::pow(dot(whole.axis[i], velocity.angular), 2);
    return whole.mass * dot(velocity.linear, velocity.linear) + turning;
  };
  for (double beta = 1e-8; beta < 1e9; beta *= 10) {
    std::vector<Place> still = places(beta);
    for (Place& place : still) place.fluid = {}, place.added = 0;
    State state{start};
    for (int n = 0; n < 20; ++n) {
      const double before = energy(state.velocity);
      state.step(body(), still, {}, 1e-5);
      EXPECT_LE(energy(state.velocity), before * (1 + 1e-12)) << beta;
    }
  }
}

// A component of the angular momentum that torques do not change stays.
TEST(RigidDrag, TurnsWhatMayTurn) {
  RigidBody whole = body();
  whole.turned = {false, false, false};
  State state{start};
  state.step(whole, places(1.0), others, 1e-3);
  EXPECT_EQ(norm(state.velocity.angular - start.angular), 0);
}

}  // namespace
