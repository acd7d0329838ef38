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

class RefinedMesh : public testing::TestWithParam<const char*> {};

TEST_P(RefinedMesh, WithoutParticles) {
  Settings settings = refined;
  settings["alpha_scheme"] = GetParam();
  const FoamCase box("refined", settings);
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

TEST_P(RefinedMesh, PorousBed) {
  Settings settings = refined;
  settings["alpha_scheme"] = GetParam();
  const FoamCase box("refined_bed", settings);
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

INSTANTIATE_TEST_SUITE_P(Scheme, RefinedMesh, testing::Values("MULES", "isoAdvection"),
                         [](const testing::TestParamInfo<const char*>& info) {
                           return std::string(info.param);
                         });

/// From cells of 10 mm to 2.5 mm by fluid.refinement, with a porous bed that moves: the surface never leaves
/// the fine cells, and renewing the void fraction of new cells loses no liquid and moves no fluid.
TEST(RefinedMeshFromCoarse, KeepsTheSurfaceFine) {
  RefinementParameters refinement;
  refinement.levels = 2;
  Settings settings = refined;
  settings.erase("mesh");
  const FoamCase box("refined_from_coarse", settings);
  const auto flow = box.open(scene(true, true, false), &refinement);
  set_alpha(*flow, column);
  const double finest = std::pow(0.01 / 4, 3), window = 1e-3;
  // As the bulk grid gives it: a linear profile in each coarse cell, whose parts add up to the whole.
  const auto bed = [&](double time) {
    return cell_values(*flow, [&](const vector& x) {
      const auto eps = [&](double along, double up) {
        return 1 - 0.5 * std::exp(-(Foam::sqr(along - 0.12 - 0.2 * time) + up * up) / Foam::sqr(0.04));
      };
      constexpr double size = 0.01;
      const double cx = size * (std::floor(x.x() / size) + 0.5), cz = size * (std::floor(x.z() / size) + 0.5);
      const double slope_x = (eps(cx + size, cz) - eps(cx - size, cz)) / (2 * size);
      const double slope_z = (eps(cx, cz + size) - eps(cx, cz - size)) / (2 * size);
      return eps(cx, cz) + slope_x * (x.x() - cx) + slope_z * (x.z() - cz);
    });
  };
  set_initial_porosity(*flow, bed(0));
  const double water = liquid_volume(*flow);
  double worst = 0, fastest = 0, coarse = 0;
  for (int n = 0; n < 60; ++n) {
    begin_window(*flow, (n + 1) * window);
    set_porosity_target(*flow, bed((n + 1) * window));
    while (advance_clock(*flow)) {
      if (refine_mesh(*flow)) {
        renew_porosity(*flow, bed(n * window), bed((n + 1) * window));
        settle_flux(*flow);
        worst = std::max(worst, std::abs(liquid_volume(*flow) / water - 1));
      }
      update_porosity(*flow);
      while (outer_corrector(*flow)) {
        advect_interface(*flow);
        predict_momentum(*flow);
        while (pressure_corrector(*flow)) correct_pressure(*flow);
      }
      end_step(*flow);
      forAll(flow->alpha, cell) if (flow->alpha[cell] > 0.01 && flow->alpha[cell] < 0.99) coarse =
          std::max(coarse, flow->mesh.V()[cell] / finest);
    }
    fastest = std::max(fastest, largest_speed(*flow));
  }
  std::cout << flow->clock.steps << " steps, " << flow->refinement->changes << " mesh changes, "
            << flow->mesh.nCells() << " cells at the end: water error " << worst << ", alpha excess "
            << flow->alpha_excess << ", largest interface cell " << coarse << " of the finest, fastest "
            << fastest << " m/s\n";
  EXPECT_GT(flow->refinement->changes, 10);
  EXPECT_LT(worst, 1e-9);
  EXPECT_LT(flow->alpha_excess, 1e-8);
  EXPECT_LT(coarse, 1.001);
  EXPECT_LT(fastest, 6);
}

}  // namespace
}  // namespace demvof::test
