// SPDX-License-Identifier: GPL-3.0-or-later
// Water under air in an open box stays at rest, whatever the void fraction and the drag are.
// Exact solution: u = 0, grad p = rho g.

#include <gtest/gtest.h>

#include <random>

#include "foam_case.hpp"

namespace demvof::test {
namespace {

const double level = 0.1;  // m

std::unique_ptr<Flow> open_column(const std::string& name, Settings settings, bool surface_tension) {
  const Settings column{{"lx", "0.05"}, {"ly", "0.05"}, {"lz", "0.2"},           {"nx", "10"},
                        {"ny", "10"},   {"nz", "40"},   {"p_tolerance", "1e-10"}};
  settings.insert(column.begin(), column.end());
  auto flow = FoamCase(name, settings).open(scene(true, true, surface_tension));
  set_alpha(*flow, [](const vector& x) { return x.z() < level ? 1.0 : 0.0; });
  return flow;
}

class HydrostaticColumn : public testing::TestWithParam<double> {};

TEST_P(HydrostaticColumn, StaysAtRestWithRandomVoidFractionAndHeldParticles) {
  const double top_of_bed = GetParam();  // m; below, in and above the interface
  auto flow = open_column("hydrostatic", {{"sigma", "0.07"}}, true);
  std::mt19937 random(7);
  std::uniform_real_distribution<double> any_eps(0.4, 1);
  const scalarField eps =
      cell_values(*flow, [&](const vector& x) { return x.z() < top_of_bed ? any_eps(random) : 1.0; });
  set_initial_porosity(*flow, eps);
  flow->source->coefficient.field() =
      cell_values(*flow, [&](const vector& x) { return x.z() < top_of_bed ? 1e6 : 0.0; });

  for (int window = 0; window < 100; ++window) {
    begin_window(*flow, flow->time.value() + 1e-4);
    set_porosity_target(*flow, eps);
    advance(*flow);
  }
  std::cout << "bed to " << top_of_bed << " m: " << flow->clock.steps << " steps, |U| "
            << largest_speed(*flow) << " m/s, alpha excess " << flow->alpha_excess << "\n";
  EXPECT_GE(flow->clock.steps, 100);
  EXPECT_LT(largest_speed(*flow), 1e-6);
  const Foam::vectorField gradient = pressure_gradient(*flow);
  forAll(flow->rho, cell) {
    const vector weight = flow->rho[cell] * flow->g.value();
    ASSERT_LT(Foam::mag(gradient[cell] - weight), 1e-6 * 9810) << "cell " << cell;
  }
}

INSTANTIATE_TEST_SUITE_P(TopOfBed, HydrostaticColumn, testing::Values(0.06, 0.1, 0.15));

}  // namespace
}  // namespace demvof::test
