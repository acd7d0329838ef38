// SPDX-License-Identifier: GPL-3.0-or-later
// Dam break on a mesh that refines the interface by one level and coarsens behind it, without and with
// a porous bed in the way. Exact: the liquid volume, and 0 <= alpha <= 1. The coarse mesh's own interface
// is spread over twice the length, so more liquid is in interface cells there.

#include <gtest/gtest.h>

#include "foam_case.hpp"

namespace demvof::test {
namespace {

const Settings refined{
    {"mesh", "dynamicRefineFvMesh"}, {"p_tolerance", "1e-10"}, {"p_rel_tol", "0"}, {"end_time", "0.12"},
    {"longest_step", "1e-3"},        {"steps", "1000"}};

double column(const vector& x) {
  return x.x() < 0.05 && x.z() < 0.1 ? 1 : 0;
}

TEST(RefinedMesh, WithoutParticles) {
  const FoamCase box("refined", refined);
  const auto flow = box.open(scene(false, false, false));
  set_alpha(*flow, column);
  const double water = liquid_volume(*flow);
  double worst = 0;
  label most = 0;
  while (flow->time.value() < 0.1 && advance_clock(*flow)) {
    do_step(*flow);
    worst = std::max(worst, std::abs(liquid_volume(*flow) / water - 1));
    most = std::max(most, flow->mesh.nCells());
  }
  std::cout << flow->clock.steps << " steps, up to " << most << " cells: water error " << worst
            << ", alpha excess " << flow->alpha_excess << ", fastest " << largest_speed(*flow) << " m/s\n";
  EXPECT_GT(most, 7000);
  EXPECT_LT(worst, 1e-9);
  EXPECT_LT(flow->alpha_excess, 1e-6);
}

TEST(RefinedMesh, PorousBed) {
  const FoamCase box("refined_bed", refined);
  const auto flow = box.open(scene(true, true, false));
  set_alpha(*flow, column);
  const auto bed = [&] {
    return cell_values(*flow, [&](const vector& x) {
      return 1 - 0.5 * std::exp(-(Foam::sqr(x.x() - 0.12) + Foam::sqr(x.z())) / Foam::sqr(0.04));
    });
  };
  set_initial_porosity(*flow, bed());
  const double water = liquid_volume(*flow);
  double worst = 0, fastest = 0;
  label changes = 0;
  for (int window = 0; window < 100; ++window) {
    const scalarField eps = bed();
    forAll(eps, cell) flow->source->coefficient[cell] = 1e5 * flow->alpha[cell] * (1 - eps[cell]);
    begin_window(*flow, flow->time.value() + 1e-3);
    set_porosity_target(*flow, eps);
    while (advance_clock(*flow)) {
      if (refine_mesh(*flow)) {
        settle_flux(*flow);
        ++changes;
      }
      update_porosity(*flow);
      while (outer_corrector(*flow)) {
        advect_interface(*flow);
        predict_momentum(*flow);
        while (pressure_corrector(*flow)) correct_pressure(*flow);
      }
      end_step(*flow);
    }
    worst = std::max(worst, std::abs(liquid_volume(*flow) / water - 1));
    fastest = std::max(fastest, largest_speed(*flow));
  }
  std::cout << flow->clock.steps << " steps, " << changes << " mesh changes: water error " << worst
            << ", alpha excess " << flow->alpha_excess << ", fastest " << fastest << " m/s\n";
  EXPECT_GT(changes, 20);
  EXPECT_LT(worst, 1e-9);
  EXPECT_LT(flow->alpha_excess, 1e-8);
  EXPECT_LT(fastest, 6);
}

}  // namespace
}  // namespace demvof::test
