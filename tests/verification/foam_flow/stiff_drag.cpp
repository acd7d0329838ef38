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
const double length = 0.1, dt = 1e-4, rho = 1000;

/// Swirl in x-z that vanishes at the walls; speed up to about 1 um/s, so that convection is nothing.
vector swirl(const vector& x) {
  const double a = pi * x.x() / length, b = pi * x.z() / length, speed = 1e-6;
  return {-speed * std::pow(std::sin(a), 2) * std::sin(2 * b), 0,
          speed * std::sin(2 * a) * std::pow(std::sin(b), 2)};
}

struct Variant {
  double k;
  Settings pimple;
  bool porous;
};

void PrintTo(const Variant& variant, std::ostream* out) {
  *out << variant.k << (variant.porous ? "" : " without porosity");
  for (const auto& [key, value] : variant.pimple) *out << ", " << key << ' ' << value;
}

class StiffDrag : public testing::TestWithParam<Variant> {};

TEST_P(StiffDrag, OneStepGivesTheImplicitSolution) {
  const double k = GetParam().k, eps = GetParam().porous ? 0.6 : 1;
  Settings settings{
      {"nu_water", "1e-12"}, {"top_alpha", "1"}, {"lx", "0.1"}, {"ly", "0.01"},           {"lz", "0.1"},
      {"nx", "40"},          {"ny", "1"},        {"nz", "40"},  {"p_tolerance", "1e-12"}, {"p_rel_tol", "0"}};
  for (const auto& [key, value] : GetParam().pimple) settings[key] = value;
  const auto flow = FoamCase("stiff_drag", settings).open(scene(true, GetParam().porous, false));
  set_alpha(*flow, [](const vector&) { return 1.0; });
  if (GetParam().porous) set_initial_porosity(*flow, scalarField(flow->mesh.nCells(), eps));
  flow->source->coefficient.field() = k * eps * rho / dt;
  forAll(flow->source->reference, cell) flow->source->reference[cell] = swirl(flow->mesh.C()[cell]);
  begin_window(*flow, dt);
  if (GetParam().porous) set_porosity_target(*flow, scalarField(flow->mesh.nCells(), eps));
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
  const double speed = k / (1 + k) * 1e-6;
  std::cout << "k = " << k << ": velocity error " << worst / speed << ", momentum balance "
            << imbalance / (eps * rho * speed) << "\n";
  EXPECT_LT(worst, 0.01 * speed);                  // second-order divergence of the swirl on 40 x 40 cells
  EXPECT_LT(imbalance, 1e-5 * eps * rho * speed);  // further outer correctors have a little convection
}

const Settings predicted{{"predictor", "yes"}}, repeated{{"outer_correctors", "2"}},
    relaxed{{"outer_correctors", "3"}, {"relaxation", "{ fields { p_rgh 0.5; } equations { U 0.7; } }"}},
    everything{{"predictor", "yes"},
               {"outer_correctors", "3"},
               {"relaxation", "{ fields { p_rgh 0.5; } equations { U 0.7; } }"}};

INSTANTIATE_TEST_SUITE_P(Stiffness, StiffDrag,
                         testing::Values(Variant{1e-2, {}, true}, Variant{1, {}, true},
                                         Variant{1e2, {}, true}, Variant{1e4, {}, true},
                                         Variant{1e6, {}, true}, Variant{1e8, {}, true},
                                         Variant{1e6, {}, false}, Variant{1e6, predicted, true},
                                         Variant{1e6, predicted, false}, Variant{1e6, repeated, true},
                                         Variant{1e6, relaxed, true}, Variant{1e6, relaxed, false},
                                         Variant{1e6, everything, true}, Variant{1e6, everything, false}));

/// Where drag holds the fluid on both sides of a face, it answers to a pressure as that drag says, whatever
/// the fluids weigh. Water that drives the air out of a bed, u = w/eps from the start: eps grad p = -C u, up
/// to the surface and across it.
TEST(StiffDragAtSurface, PressureDropsEvenly) {
  const double eps = 0.6, w = 1e-3, step = 1e-4;
  for (const double drag : {1e6, 1e8, 1e10}) {
    const auto flow =
        FoamCase("drag_across_surface", {{"walls_U", "{ type slip; }"},
                                         {"bottom_U", "{ type fixedValue; value uniform (0 0 1e-3); }"},
                                         {"inflow_alpha", "1"},
                                         {"g_z", "0"},
                                         {"lx", "0.01"},
                                         {"ly", "0.01"},
                                         {"lz", "0.1"},
                                         {"nx", "2"},
                                         {"ny", "2"},
                                         {"nz", "20"},
                                         {"p_tolerance", "1e-12"},
                                         {"p_rel_tol", "0"},
                                         {"first_step", std::to_string(step)}})
            .open(scene(true, true, false));
    set_alpha(*flow, [](const vector& x) { return x.z() < 0.05 ? 1 : 0; });
    set_initial_porosity(*flow, scalarField(flow->mesh.nCells(), eps));
    flow->U.primitiveFieldRef() = vector(0, 0, w / eps);
    flow->U.correctBoundaryConditions();
    flow->phi = eps * fvc::flux(flow->U);
    *flow->velocity_flux = fvc::flux(flow->U);
    flow->source->coefficient.field() = drag;
    for (int k = 0; k < 3; ++k) {
      begin_window(*flow, flow->time.value() + step);
      set_porosity_target(*flow, scalarField(flow->mesh.nCells(), eps));
      advance(*flow);
    }
    double worst = 0;
    const Foam::surfaceScalarField slope(fvc::snGrad(flow->p_rgh));
    forAll(flow->mesh.owner(), face) {
      const vector& S = flow->mesh.Sf()[face];
      if (std::abs(S.z()) < 0.5 * Foam::mag(S)) continue;
      worst = std::max(worst, std::abs(slope[face] * S.z() / Foam::mag(S) + drag * w / (eps * eps)));
    }
    std::cout << "C " << drag << " kg/(m3 s): slope of the pressure off by "
              << worst / (drag * w / (eps * eps)) << "\n";
    EXPECT_LT(worst / (drag * w / (eps * eps)), 180 / drag);  // inertia leaves 60/C
  }
}

}  // namespace
}  // namespace demvof::test
