// SPDX-License-Identifier: GPL-3.0-or-later
// Dam break on a mesh that refines the interface by one level and coarsens behind it, without and with
// a porous bed in the way. Exact: the liquid volume, and 0 <= alpha <= 1. The coarse mesh's own interface
// is spread over twice the length, so more liquid is in interface cells there.

#include <gtest/gtest.h>

#include <fstream>

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

/// 10 mm cells refined twice, and a surface that lies on none of their faces: what setFields puts half a cell
/// off is put right on the refined mesh, and the water is at rest from the first step on.
TEST(RefinedMeshFromCoarse, StartsAtRestWhereTheCaseSays) {
  const double level = 0.0974, finest = 0.0025;
  RefinementParameters refinement;
  refinement.levels = 2;
  Settings settings = refined;
  settings.erase("mesh");
  settings.insert({{"lx", "0.1"}, {"ly", "0.05"}, {"lz", "0.2"}, {"nx", "10"}, {"ny", "5"}, {"nz", "20"}});
  const FoamCase box("refined_start", settings);
  std::ofstream(box.folder() + "/system/setFieldsDict")
      << "FoamFile { version 2.0; format ascii; class dictionary; object setFieldsDict; }\n"
      << "defaultFieldValues ( volScalarFieldValue alpha.water 0 volVectorFieldValue U (0 0 0) );\n"
      << "regions ( boxToCell { box (0 0 0) (1 1 " << level
      << "); fieldValues ( volScalarFieldValue alpha.water 1 ); } );\n";
  box.run("setFields");
  const auto flow = box.open(scene(false, false, false), &refinement);
  const double start = liquid_volume(*flow) / (0.1 * 0.05);
  double fastest = 0;
  for (int step = 0; step < 20 && advance_clock(*flow); ++step) {
    do_step(*flow);
    fastest = std::max(fastest, largest_speed(*flow));
  }
  const double end = liquid_volume(*flow) / (0.1 * 0.05);
  std::cout << flow->mesh.nCells() << " cells, level " << start << " m at the start, " << end
            << " m at the end, fastest " << fastest << " m/s\n";
  EXPECT_GT(flow->mesh.nCells(), 5000);
  EXPECT_LT(std::abs(start - level), 0.5 * finest + 1e-9);
  EXPECT_LT(std::abs(end / start - 1), 1e-12);
  EXPECT_LT(fastest, 1e-5);
}

/// A run that goes on has a surface of its own: fields that are not what setFieldsDict says are never set
/// again.
TEST(RefinedMeshFromCoarse, LeavesOtherFieldsAlone) {
  RefinementParameters refinement;
  Settings settings = refined;
  settings.erase("mesh");
  const FoamCase box("refined_restart", settings);
  box.run("setFields");
  {
    std::ofstream other(box.folder() + "/system/setFieldsDict", std::ios::app);
    other << "regions ( boxToCell { box (0 0 0) (0.08 0.1 0.1); fieldValues ( volScalarFieldValue "
             "alpha.water 1 "
             "); } );\n";
  }
  const auto flow = box.open(scene(false, false, false), &refinement);
  EXPECT_EQ(flow->mesh.nCells(), 6000);
  EXPECT_NEAR(liquid_volume(*flow), 0.05 * 0.1 * 0.1, 1e-12);
}

/// No surface: only what else is asked for is fine, and nothing when nothing is.
TEST(RefinementCriteria, ParticlesAndSteepVoidFraction) {
  const auto eps = [](const vector& x) { return Foam::mag(x - vector(0.1, 0.05, 0.15)) < 0.03 ? 0.6 : 1.0; };
  const auto cells_with = [&](bool particles, double porosity_jump, const char* name, auto&& must_be_fine) {
    RefinementParameters refinement;
    refinement.levels = 1;
    refinement.particles = particles;
    refinement.porosity_jump = porosity_jump;
    Settings settings = refined;
    settings.erase("mesh");
    const auto flow = FoamCase(name, settings).open(scene(true, true, false), &refinement);
    const scalarField bed = cell_values(*flow, eps);
    set_initial_porosity(*flow, bed);
    begin_window(*flow, 1e-3);
    set_porosity_target(*flow, bed);
    advance_clock(*flow);
    refine_mesh(*flow);
    forAll(flow->mesh.C(), cell) {
      if (!must_be_fine(flow->mesh.C()[cell])) continue;
      EXPECT_LT(flow->mesh.V()[cell], 0.13e-6) << name << ", cell " << cell;
    }
    return flow->mesh.nCells();
  };
  const auto distance = [](const vector& x) { return Foam::mag(x - vector(0.1, 0.05, 0.15)); };
  const label none = cells_with(false, 0, "criterion_none", [](const vector&) { return false; });
  const label particles =
      cells_with(true, 0, "criterion_particles", [&](const vector& x) { return distance(x) < 0.03; });
  const label edge = cells_with(false, 0.1, "criterion_jump",
                                [&](const vector& x) { return std::abs(distance(x) - 0.03) < 0.003; });
  const label smooth = cells_with(false, 0.5, "criterion_no_jump", [](const vector&) { return false; });
  std::cout << "cells: " << none << " without a criterion, " << particles << " around particles, " << edge
            << " at a jump of 0.4 above 0.1, " << smooth << " above 0.5\n";
  EXPECT_EQ(none, 6000);
  EXPECT_EQ(smooth, 6000);
  EXPECT_GT(particles, 6000);
  EXPECT_GT(edge, 6000);
}

}  // namespace
}  // namespace demvof::test
