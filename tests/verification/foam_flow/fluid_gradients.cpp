// SPDX-License-Identifier: GPL-3.0-or-later
// What forces on particles are told of the fluid's derivatives: against exact fields of an unsteady vortex,
//
//   u = A(t) (sin kx cos kz, 0, -cos kx sin kz)
//   Du/Dt = A' u/A + A^2 k/2 (sin 2kx, 0, sin 2kz)
//   curl u = -2 A k (0, sin kx sin kz, 0)             div tau = -2 mu k^2 u
//
// in a fluid that really flows, where rho Du/Dt = -grad p + rho g + div tau, and in the surface of a drop,
// where sigma kappa grad alpha stands beside them.

#include "foam_side/fluid_gradients.hpp"

#include <gtest/gtest.h>

#include "foam_case.hpp"
#include "tests/support/record.hpp"

namespace demvof::test {
namespace {

constexpr double side = 0.1, k = 2 * 3.14159265358979323846 / side, A = 0.02;  // m, 1/m, m/s
constexpr double rate = 3;                                                     // A'/A, 1/s

ForceParameters all_forces() {
  ForceParameters forces;
  forces.viscous_stress = forces.capillary = true;
  forces.added_mass = 0.5;
  forces.lift = LiftLaw::saffman_mei;
  return forces;
}

Settings square(int cells) {
  const std::string n = std::to_string(cells);
  return {{"lx", "0.1"},
          {"ly", "0.01"},
          {"lz", "0.1"},
          {"nx", n},
          {"ny", "1"},
          {"nz", n},
          {"walls_U", "{ type slip; }"},
          {"bottom_U", "{ type slip; }"},
          {"p_tolerance", "1e-12"},
          {"p_rel_tol", "0"},
          {"longest_step", "2e-4"},
          {"first_step", "2e-4"}};
}

vector vortex(const vector& x) {
  return vector(std::sin(k * x.x()) * std::cos(k * x.z()), 0, -std::cos(k * x.x()) * std::sin(k * x.z()));
}

void set_velocity(Flow& flow, double amplitude) {
  forAll(flow.U, cell) flow.U[cell] = amplitude * vortex(flow.mesh.C()[cell]);
  flow.U.correctBoundaryConditions();
}

/// Away from the boundary, whose conditions the exact fields do not meet.
bool inside(const Flow& flow, label cell, double margin) {
  const vector& x = flow.mesh.C()[cell];
  return std::min({x.x(), side - x.x(), x.z(), side - x.z()}) > margin;
}

struct Errors {
  double acceleration = 0, vorticity = 0, stress = 0;  // largest, relative to the largest value
};

Errors of_exact_fields(int cells) {
  const auto flow = FoamCase("gradients_exact", square(cells)).open(scene(false, false, false));
  set_alpha(*flow, [](const vector&) { return 1.0; });
  const double dt = 0.1 / cells / cells;  // so that the error in time falls like that in space
  set_velocity(*flow, A * (1 - rate * dt));
  flow->U.oldTime();
  flow->time.setDeltaT(dt);
  ++flow->time;
  flow->clock.steps = 1;
  flow->U.storeOldTimes();
  set_velocity(*flow, A);

  const FluidGradients found = fluid_gradients(*flow, all_forces());
  const double mu = 1e-3, convective = A * A * k / 2;
  Errors worst;
  forAll(flow->U, cell) {
    if (!inside(*flow, cell, 0.02)) continue;
    const vector& x = flow->mesh.C()[cell];
    const vector u = A * vortex(x);
    const vector acceleration =
        rate * u + convective * vector(std::sin(2 * k * x.x()), 0, std::sin(2 * k * x.z()));
    const vector curl(0, -2 * A * k * std::sin(k * x.x()) * std::sin(k * x.z()), 0);
    const vector stress = -2 * mu * k * k * u;
    worst.acceleration = std::max(
        worst.acceleration, Foam::mag(found.acceleration[cell] - acceleration) / (rate * A + convective));
    worst.vorticity = std::max(worst.vorticity, Foam::mag(found.vorticity[cell] - curl) / (2 * A * k));
    worst.stress =
        std::max(worst.stress, Foam::mag(found.stress_force[cell] - stress) / (2 * mu * k * k * A));
  }
  return worst;
}

Record& record() {
  static Record record(
      "fluid_gradients", "Derivatives of the fluid for the forces on particles",
      "Du/Dt, curl u and div tau of an unsteady vortex against the exact fields on 16, 32 and 64 "
      "cells a side; the momentum balance rho Du/Dt = -grad p + rho g + div tau of what the "
      "particles are told in a fluid that flows; in the surface of a drop too, with sigma kappa grad alpha.",
      "tests/Alltest --verification -- -R foam_flow.FluidGradients");
  return record;
}

TEST(FluidGradients, AreOfSecondOrder) {
  std::vector<double> h, acceleration, vorticity, stress;
  for (const int cells : {16, 32, 64}) {
    const Errors errors = of_exact_fields(cells);
    h.push_back(side / cells);
    acceleration.push_back(errors.acceleration);
    vorticity.push_back(errors.vorticity);
    stress.push_back(errors.stress);
  }
  const auto order = [](const std::vector<double>& e) { return std::log2(e[1] / e[2]); };
  record().at_least("order of Du/Dt", order(acceleration), 1.9);
  record().at_least("order of curl u", order(vorticity), 1.9);
  record().at_least("order of div tau", order(stress), 1.9);
  record().at_most("error of Du/Dt on 64 cells", acceleration[2], 1e-3);
  record().at_most("error of curl u on 64 cells", vorticity[2], 4.5e-3);
  record().at_most("error of div tau on 64 cells", stress[2], 2.4e-3);
  const std::string picture = "derivatives of a vortex";
  record().curve(picture, "cell, m", "largest error, -", "Du/Dt", h, acceleration, "xy");
  record().curve(picture, "cell, m", "largest error, -", "curl u", h, vorticity, "xy");
  record().curve(picture, "cell, m", "largest error, -", "div tau", h, stress, "xy");
}

// The particles of a steady mixture must not be pushed: what they are told has to balance as the fluid does.
TEST(FluidGradients, BalanceInAFluidThatFlows) {
  std::vector<double> imbalance;
  for (const int cells : {16, 32}) {
    const auto flow = FoamCase("gradients_flow", square(cells)).open(scene(false, false, false));
    set_alpha(*flow, [](const vector&) { return 0.0; });  // what the open top lets in
    set_velocity(*flow, A);
    flow->phi = fvc::flux(flow->U);
    for (int n = 0; n < 10; ++n) {
      begin_window(*flow, flow->time.value() + 2e-4);
      advance(*flow);
    }
    const FluidGradients found = fluid_gradients(*flow, all_forces());
    const Foam::vectorField gradient = pressure_gradient(*flow);
    double worst = 0, largest = 0;
    forAll(flow->U, cell) {
      if (!inside(*flow, cell, 0.02)) continue;
      const vector inertia = flow->rho[cell] * found.acceleration[cell];
      const vector force = flow->rho[cell] * flow->g.value() - gradient[cell] + found.stress_force[cell];
      worst = std::max(worst, Foam::mag(inertia - force));
      largest = std::max(largest, Foam::mag(inertia));
    }
    imbalance.push_back(worst / largest);
    std::cout << cells << " cells: imbalance " << worst / largest << " of " << largest << " N/m3\n";
  }
  record().at_most("imbalance of rho Du/Dt and the forces told, 32 cells", imbalance[1], 4.5e-3);
  record().at_least("order of the imbalance", std::log2(imbalance[0] / imbalance[1]), 2);
}

// A drop that starts to fall: without the capillary force the particles in its surface would feel its
// pressure jump.
TEST(FluidGradients, BalanceInTheSurfaceOfADrop) {
  const double radius = 0.025;
  const auto flow = [&] {
    Settings settings = square(40);
    settings["sigma"] = "0.07";
    return FoamCase("gradients_drop", settings).open(scene(false, false, true));
  }();
  set_alpha(*flow, [&](const vector& x) {
    const double distance = std::hypot(x.x() - side / 2, x.z() - side / 2);
    return 0.5 * (1 + std::tanh((radius - distance) / 0.002));
  });
  begin_window(*flow, 2e-4);
  advance(*flow);
  const FluidGradients found = fluid_gradients(*flow, all_forces());
  ForceParameters none;
  EXPECT_EQ(Foam::gMax(Foam::mag(fluid_gradients(*flow, none).stress_force)()), 0);
  const Foam::vectorField gradient = pressure_gradient(*flow);
  double worst = 0, largest = 0;
  forAll(flow->U, cell) {
    const vector capillary = found.stress_force[cell];
    const vector force = flow->rho[cell] * flow->g.value() - gradient[cell] + capillary;
    worst = std::max(worst, Foam::mag(force - flow->rho[cell] * found.acceleration[cell]));
    largest = std::max(largest, Foam::mag(capillary));
  }
  record().at_most("drop: imbalance over the largest sigma kappa grad alpha", worst / largest, 9e-4);
}

}  // namespace
}  // namespace demvof::test
