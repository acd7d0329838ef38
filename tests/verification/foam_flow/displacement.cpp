// SPDX-License-Identifier: GPL-3.0-or-later
// A cloud of particles, given as a smooth void fraction, appears under water, moves and turns.
// Exact: what leaves the box is what the cloud displaces; the water stays; alpha = 1 stays 1.

#include <gtest/gtest.h>

#include <cmath>

#include "foam_case.hpp"

namespace demvof::test {
namespace {

struct Variant {
  const char* name;
  Settings settings;
  int steps_per_window;
  double eps_tolerance;  // of the pressure solver
};

void PrintTo(const Variant& variant, std::ostream* out) {
  *out << variant.name;
}

class Displacement : public testing::TestWithParam<Variant> {};

const double level = 0.12, window = 1e-3;  // m, s

/// Void fraction of the cloud at time t: it grows for 4 windows, then swings; 0.6 in its middle.
double cloud(const vector& x, double t) {
  const double grown = std::min(1.0, t / (4 * window));
  const vector middle(0.05 + 0.02 * std::sin(200 * t), 0.05, 0.05 + 0.01 * std::sin(330 * t));
  return 1 - 0.4 * grown * std::exp(-Foam::magSqr(x - middle) / (0.02 * 0.02));
}

TEST_P(Displacement, WaterIsKeptAndOutflowIsWhatTheCloudDisplaces) {
  Settings settings = GetParam().settings;
  const Settings box{{"lx", "0.1"},
                     {"ly", "0.1"},
                     {"lz", "0.2"},
                     {"nx", "10"},
                     {"ny", "10"},
                     {"nz", "20"},
                     {"p_tolerance", "1e-13"},
                     {"p_rel_tol", "0"}};
  settings.insert(box.begin(), box.end());
  settings["first_step"] = settings["longest_step"] = std::to_string(window / GetParam().steps_per_window);
  const auto flow =
      FoamCase(std::string("displacement_") + GetParam().name, settings).open(scene(true, true, false));
  set_alpha(*flow, [](const vector& x) { return x.z() < level ? 1.0 : 0.0; });
  const auto eps_at = [&](double t) {
    return cell_values(*flow, [t](const vector& x) { return cloud(x, t); });
  };
  const scalarField& volume = flow->mesh.V().field();
  const auto solid = [&](double t) { return Foam::gSum(scalarField((1 - eps_at(t)) * volume)); };

  set_initial_porosity(*flow, eps_at(0));
  const double water = liquid_volume(*flow);
  const label top = flow->mesh.boundaryMesh().findPatchID("top");
  double outflow = 0, worst_water = 0, worst_deep = 0, worst_outflow = 0, worst_eps = 0, fastest = 0;
  for (int n = 1; n <= 30; ++n) {
    begin_window(*flow, n * window);
    set_porosity_target(*flow, eps_at(n * window));
    while (advance_clock(*flow)) {
      // with one outer corrector the alpha step uses the flux of now
      if (settings.count("outer_correctors") == 0)
        outflow += flow->time.deltaTValue() * Foam::gSum(flow->phi.boundaryField()[top]);
      do_step(*flow);
    }
    worst_water = std::max(worst_water, std::abs(liquid_volume(*flow) / water - 1));
    worst_outflow = std::max(worst_outflow, std::abs(outflow - solid(n * window)));
    worst_eps = std::max(worst_eps,
                         Foam::gMax(Foam::mag(flow->porosity->eps.primitiveField() - eps_at(n * window))()));
    fastest = std::max(fastest, largest_speed(*flow));
    forAll(flow->alpha, cell) {
      if (flow->mesh.C()[cell].z() < 0.08) worst_deep = std::max(worst_deep, std::abs(flow->alpha[cell] - 1));
    }
  }
  std::cout << GetParam().name << ": " << flow->clock.steps << " steps, errors: water " << worst_water
            << ", alpha = 1 " << worst_deep << ", bounds " << flow->alpha_excess << ", eps " << worst_eps
            << ", outflow " << worst_outflow / solid(30 * window) << ", fastest " << fastest << " m/s\n";
  EXPECT_LT(worst_water, 1e-10);
  EXPECT_LT(worst_deep, 1e-10);
  EXPECT_LT(flow->alpha_excess, 1e-8);
  EXPECT_LT(worst_eps, GetParam().eps_tolerance);
  EXPECT_LT(fastest, 30);
  if (settings.count("outer_correctors") == 0) {
    EXPECT_LT(worst_outflow, GetParam().eps_tolerance * solid(30 * window));
  }
}

INSTANTIATE_TEST_SUITE_P(
    Settings, Displacement,
    testing::Values(Variant{"one_step", {}, 1, 1e-10}, Variant{"three_steps", {}, 3, 1e-10},
                    Variant{"sub_cycles", {{"alpha_sub_cycles", "3"}}, 2, 1e-10},
                    Variant{"semi_implicit", {{"mules_corr", "yes"}, {"alpha_sub_cycles", "2"}}, 2, 1e-10},
                    Variant{"outer_correctors", {{"outer_correctors", "2"}}, 2, 1e-10},
                    Variant{"relaxed",
                            {{"outer_correctors", "3"},
                             {"predictor", "yes"},
                             {"relaxation", "{ fields { p_rgh 0.7; } equations { U 0.8; } }"}},
                            1,
                            1e-10},
                    Variant{
                        "geometric", {{"alpha_scheme", "isoAdvection"}, {"alpha_sub_cycles", "2"}}, 2, 1e-10},
                    Variant{"loose_pressure", {{"p_tolerance", "1e-4"}}, 2, 1e-2}),
    [](const testing::TestParamInfo<Variant>& info) { return info.param.name; });

}  // namespace
}  // namespace demvof::test
