// SPDX-License-Identifier: GPL-3.0-or-later
// Drag of any stiffness k = C dt/(eps rho) towards a divergence-free velocity u_ref, fluid at rest before.
// Exact for one implicit Euler step without convection and viscosity: u = k/(1 + k) u_ref, and the
// momentum of the fluid is what drag and pressure gave it.

#include <gtest/gtest.h>

#include <cmath>

#include "foam_case.hpp"

namespace demvof::test {
namespace {

const double pi = 3.14159265358979323846;
const double length = 0.1, eps = 0.6, dt = 1e-4, rho = 1000;

/// Swirl in x-z that vanishes at the walls; speed up to about 0.1 mm/s, so that convection is nothing.
vector swirl(const vector& x) {
  const double a = pi * x.x() / length, b = pi * x.z() / length, speed = 1e-4;
  return {-speed * std::pow(std::sin(a), 2) * std::sin(2 * b), 0,
          speed * std::sin(2 * a) * std::pow(std::sin(b), 2)};
}

class StiffDrag : public testing::TestWithParam<double> {};

TEST_P(StiffDrag, OneStepGivesTheImplicitSolution) {
  const double k = GetParam();
  const FoamCase box("stiff_drag", {{"lx", "0.1"},
                                    {"ly", "0.01"},
                                    {"lz", "0.1"},
                                    {"nx", "40"},
                                    {"ny", "1"},
                                    {"nz", "40"},
                                    {"p_tolerance", "1e-12"},
                                    {"p_rel_tol", "0"}});
  const auto flow = box.open(scene(true, true, false));
  set_alpha(*flow, [](const vector&) { return 1.0; });
  set_initial_porosity(*flow, scalarField(flow->mesh.nCells(), eps));
  flow->source->coefficient.field() = k * eps * rho / dt;
  forAll(flow->source->reference, cell) flow->source->reference[cell] = swirl(flow->mesh.C()[cell]);
  begin_window(*flow, dt);
  set_porosity_target(*flow, scalarField(flow->mesh.nCells(), eps));
  advance(*flow);
  ASSERT_EQ(flow->clock.steps, 1);

  const Foam::vectorField gradient = pressure_gradient(*flow);
  double worst = 0, imbalance = 0;
  forAll(flow->U, cell) {
    const vector exact = k / (1 + k) * swirl(flow->mesh.C()[cell]);
    worst = std::max(worst, Foam::mag(flow->U[cell] - exact));
    const vector from_pressure = dt * eps * (rho * flow->g.value() - gradient[cell]);
    imbalance = std::max(imbalance, Foam::mag(eps * rho * flow->U[cell] - from_pressure -
                                              flow->source->implicit_impulse[cell]));
  }
  const double speed = k / (1 + k) * 1e-4;
  std::cout << "k = " << k << ": velocity error " << worst / speed << ", momentum balance "
            << imbalance / (eps * rho * speed) << "\n";
  EXPECT_LT(worst, 0.01 * speed);  // second-order divergence of the swirl on 40 x 40 cells
  // Wall cells differ from the others by their stress, 1e-6 of their inertia; times k that is drag.
  EXPECT_LT(imbalance, (1e-4 + 1e-8 * k) * eps * rho * speed);
}

INSTANTIATE_TEST_SUITE_P(Stiffness, StiffDrag, testing::Values(1e-2, 1, 1e2, 1e4, 1e6, 1e8));

}  // namespace
}  // namespace demvof::test
