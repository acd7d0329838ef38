// SPDX-License-Identifier: GPL-3.0-or-later
// A standing wave of water in held beads that fill the box, water and air alike: void fraction eps, drag
// alpha C u.
//
//   omega^2 = g k tanh(k h) - gamma^2,   gamma = C/(2 eps rho)       (linear, without viscosity, and without
//   the
//                                                                     inertia and drag of the air)
//
// eps itself drops out: inertia, weight and pressure of the pore fluid all carry it. (With the same C in the
// air, which moves as much as the water, its pressure would double the decay.)

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "foam_case.hpp"

namespace demvof::test {
namespace {

const double length = 0.1, depth = 0.05, amplitude = 1e-3, eps = 0.6;  // m, -
const int cells = 40;

struct Wave {
  double omega, decay;  // 1/s
};

/// From the level at one wall, sampled every dt: zero crossings and extremes of a damped cosine.
Wave measure(const std::vector<double>& level, double dt) {
  std::vector<double> crossing, extreme;
  for (std::size_t i = 1; i + 1 < level.size(); ++i) {
    const double a = level[i - 1], b = level[i], c = level[i + 1];
    if (b * c < 0) crossing.push_back((static_cast<double>(i) + b / (b - c)) * dt);
    if ((b - a) * (c - b) < 0) extreme.push_back(std::abs(b - (c - a) * (c - a) / (8 * (a - 2 * b + c))));
  }
  const double halves = static_cast<double>(crossing.size() - 1);
  Wave wave;
  wave.omega = M_PI * halves / (crossing.back() - crossing.front());
  wave.decay = std::log(extreme.front() / extreme.back()) * wave.omega /
               (M_PI * static_cast<double>(extreme.size() - 1));
  return wave;
}

Wave run(double drag) {
  const FoamCase box("standing_wave", {{"lx", "0.1"},
                                       {"ly", "0.01"},
                                       {"lz", "0.1"},
                                       {"nx", std::to_string(cells)},
                                       {"ny", "1"},
                                       {"nz", std::to_string(cells)},
                                       {"p_tolerance", "1e-9"},
                                       {"walls_U", "{ type slip; }"},
                                       {"bottom_U", "{ type slip; }"}});
  const auto flow = box.open(scene(true, true, false));
  const double dz = 0.1 / cells, dt = 2e-3;
  set_alpha(*flow, [&](const vector& x) {
    const double surface = depth + amplitude * std::cos(M_PI * x.x() / length);
    return std::clamp(0.5 + (surface - x.z()) / dz, 0.0, 1.0);
  });
  const scalarField everywhere(flow->mesh.nCells(), eps);
  set_initial_porosity(*flow, everywhere);
  balance_pressure(*flow);
  std::vector<double> level;
  for (int window = 0; window < 440; ++window) {
    begin_window(*flow, flow->time.value() + dt);
    set_porosity_target(*flow, everywhere);
    flow->source->coefficient.field() = drag * flow->alpha.primitiveField();
    advance(*flow);
    double height = 0;
    forAll(flow->alpha, cell) if (flow->mesh.C()[cell].x() < length / cells) height += flow->alpha[cell] * dz;
    level.push_back(height - depth);
  }
  return measure(level, dt);
}

TEST(StandingWave, HeldBeadsWithoutDrag) {
  const Wave wave = run(0);
  std::cout << "omega " << wave.omega << ", decay " << wave.decay << " 1/s\n";
  EXPECT_NEAR(wave.omega, 16.812, 0.01 * 16.812);
  EXPECT_LT(std::abs(wave.decay), 0.05 * 2.5);
}

TEST(StandingWave, HeldBeadsWithDrag) {
  const Wave wave = run(3000);
  std::cout << "omega " << wave.omega << ", decay " << wave.decay << " 1/s\n";
  EXPECT_NEAR(wave.omega, 16.626, 0.01 * 16.626);
  EXPECT_NEAR(wave.decay, 2.5, 0.05 * 2.5);
}

}  // namespace
}  // namespace demvof::test
