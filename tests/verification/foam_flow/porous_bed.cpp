// SPDX-License-Identifier: GPL-3.0-or-later
// Dam break against a bed of held particles: void fraction 0.45, drag coefficient as of Carman and Kozeny
// for 2.7 mm spheres, 150 mu (1 - eps)^2/(eps d)^2, about 1e5 kg/(m3 s) in water and 1e3 in air.
// Exact: the liquid volume, and 0 <= alpha <= 1.

#include <gtest/gtest.h>

#include "foam_case.hpp"

namespace demvof::test {
namespace {

TEST(PorousBed, DamBreakKeepsLiquidAndBounds) {
  const FoamCase box("porous_bed", {{"alpha_sub_cycles", "2"}});
  const auto flow = box.open(scene(true, true, false));
  set_alpha(*flow, [](const vector& x) { return x.x() < 0.05 && x.z() < 0.1 ? 1.0 : 0.0; });
  const auto in_bed = [](const vector& x) { return x.x() > 0.08 && x.z() < 0.04; };
  const scalarField eps = cell_values(*flow, [&](const vector& x) { return in_bed(x) ? 0.45 : 1.0; });
  set_initial_porosity(*flow, eps);
  const double water = liquid_volume(*flow);

  double worst_water = 0, fastest = 0, in_pores = 0;
  for (int window = 0; window < 250; ++window) {
    forAll(eps, cell) {
      const double alpha = flow->alpha[cell];
      flow->source->coefficient[cell] = eps[cell] < 1 ? 1e5 * alpha + 1e3 * (1 - alpha) : 0;
    }
    begin_window(*flow, flow->time.value() + 1e-3);
    set_porosity_target(*flow, eps);
    advance(*flow);
    worst_water = std::max(worst_water, std::abs(liquid_volume(*flow) / water - 1));
    fastest = std::max(fastest, largest_speed(*flow));
  }
  forAll(eps, cell) if (eps[cell] < 1) in_pores += eps[cell] * flow->alpha[cell] * flow->mesh.V()[cell];
  std::cout << flow->clock.steps << " steps to " << flow->time.value() << " s: water error " << worst_water
            << ", alpha excess " << flow->alpha_excess << ", fastest " << fastest << " m/s, water in the bed "
            << in_pores / water << "\n";
  EXPECT_LT(worst_water, 1e-9);
  EXPECT_LT(flow->alpha_excess, 1e-8);
  EXPECT_LT(fastest, 6);
  EXPECT_GT(in_pores, 0.1 * water) << "water never reached the bed";
}

}  // namespace
}  // namespace demvof::test
