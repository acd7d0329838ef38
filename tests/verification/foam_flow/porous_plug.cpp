// SPDX-License-Identifier: GPL-3.0-or-later
// Water driven up through a plug of held particles, at w = 0.2 m/s outside.
// Exact, one-dimensional and without viscosity: u = w/eps everywhere, and the pressure before the plug
// is the sum of the drag, integral of C u/eps dz: what speeds the fluid up is regained behind.
// eps and C change over a length of `edge`; the mesh has cells of 2.5 mm.

#include <gtest/gtest.h>

#include <algorithm>

#include "foam_case.hpp"

namespace demvof::test {
namespace {

const double w = 0.2, eps_plug = 0.45;

struct Variant {
  const char* name;
  double drag, edge;    // C in the plug, kg/(m3 s); m
  bool explicit_force;  // the same drag as a given force
  double tolerance;     // of u in any cell; first to second order in the edge's width in cells
};

void PrintTo(const Variant& variant, std::ostream* out) {
  *out << variant.name;
}

class PorousPlug : public testing::TestWithParam<Variant> {};

TEST_P(PorousPlug, SpeedAndPressureDrop) {
  const Variant& variant = GetParam();
  const FoamCase channel("porous_plug", {{"lx", "0.01"},
                                         {"ly", "0.01"},
                                         {"lz", "0.2"},
                                         {"nx", "1"},
                                         {"ny", "1"},
                                         {"nz", "80"},
                                         {"p_tolerance", "1e-10"},
                                         {"walls_U", "{ type slip; }"},
                                         {"bottom_U", "{ type fixedValue; value uniform (0 0 0.2); }"},
                                         {"inflow_alpha", "1"}});
  const auto flow = channel.open(scene(true, true, false));
  set_alpha(*flow, [](const vector&) { return 1.0; });
  const auto plug = [&](const vector& x) {
    return std::clamp(0.5 + (0.02 - std::abs(x.z() - 0.1)) / variant.edge, 0.0, 1.0);
  };
  const scalarField eps = cell_values(*flow, [&](const vector& x) { return 1 - plug(x) * (1 - eps_plug); });
  const scalarField drag = cell_values(*flow, [&](const vector& x) { return variant.drag * plug(x); });
  set_initial_porosity(*flow, eps);
  if (variant.explicit_force)
    forAll(drag, cell) flow->source->force[cell] = vector(0, 0, -drag[cell] * w / eps[cell]);
  else
    flow->source->coefficient.field() = drag;
  for (int window = 0; window < 400; ++window) {
    begin_window(*flow, flow->time.value() + 2e-3);
    set_porosity_target(*flow, eps);
    advance(*flow);
  }

  double worst = 0, drop = 0;
  forAll(eps, cell) {
    worst = std::max(worst, std::abs(flow->U[cell].z() * eps[cell] / w - 1));
    drop += drag[cell] * w / Foam::sqr(eps[cell]) * 0.0025;
  }
  const label inlet = flow->mesh.findCell(Foam::point(0.005, 0.005, 0.001));
  std::cout << variant.name << ": velocity error " << worst << ", pressure before the plug "
            << flow->p_rgh[inlet] << " of " << drop << " Pa\n";
  EXPECT_LT(worst, variant.tolerance);
  EXPECT_NEAR(flow->p_rgh[inlet], drop, 0.005 * drop + 0.5 * 1000 * w * w);
}

INSTANTIATE_TEST_SUITE_P(Drag, PorousPlug,
                         testing::Values(Variant{"stiff_sharp", 1e6, 1e-9, false, 0.5},
                                         Variant{"stiff", 1e6, 0.01, false, 0.02},
                                         Variant{"stiff_smooth", 1e6, 0.02, false, 0.01},
                                         Variant{"weak", 1e4, 0.01, false, 0.06},
                                         Variant{"weak_smooth", 1e4, 0.02, false, 0.03},
                                         Variant{"given_force", 1e5, 0.02, true, 0.03}),
                         [](const testing::TestParamInfo<Variant>& info) { return info.param.name; });

}  // namespace
}  // namespace demvof::test
