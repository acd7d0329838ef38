// SPDX-License-Identifier: GPL-3.0-or-later
// A disc of liquid carried by a given velocity field and back to where it began: shape, volume, bounds.
//
//   shape error = sum eps |alpha - alpha_exact| V / sum eps alpha_exact V
//
// diagonal: uniform flow to and fro; vortex: psi = sin^2(pi x) sin^2(pi z)/pi, one box turns the disc into
// a spiral (LeVeque, SIAM J. Numer. Anal. 33 (1996) 627), reversed at half time. The flux comes from the
// stream function at the cells' edges, so it is divergence-free to round-off; with a void fraction the
// velocity between the particles is flux/eps.

#include <gtest/gtest.h>

#include <algorithm>

#include "foam_case.hpp"
#include "tests/support/record.hpp"

namespace demvof::test {
namespace {

constexpr double pi = 3.14159265358979323846;
constexpr double radius = 0.15;

struct Motion {
  const char* name;
  double x0, z0;  // centre of the disc
  double (*stream)(double x, double z);
  double turnover;  // time of the way out and back, s
};

const Motion diagonal{"diagonal flow", 0.3, 0.35, [](double x, double z) { return 0.5 * z - 0.35 * x; }, 0.9};
const Motion vortex{
    "vortex", 0.5, 0.75,
    [](double x, double z) { return std::pow(std::sin(pi * x), 2) * std::pow(std::sin(pi * z), 2) / pi; },
    2.0};

/// Share of a square cell inside the disc, by 20 x 20 samples.
double share_of_disc(const vector& x, double h, const Motion& motion) {
  int inside = 0;
  for (int i = 0; i < 20; ++i)
    for (int j = 0; j < 20; ++j) {
      const double dx = x.x() + h * ((i + 0.5) / 20 - 0.5) - motion.x0;
      const double dz = x.z() + h * ((j + 0.5) / 20 - 0.5) - motion.z0;
      inside += dx * dx + dz * dz < radius * radius;
    }
  return inside / 400.0;
}

/// The stream function's flux through a face of the one-cell-thick mesh, m3/s.
double flux_of(const Foam::fvMesh& mesh, const Foam::face& face, const vector& area, const Motion& motion) {
  if (std::abs(area.y()) > 0.5 * Foam::mag(area)) return 0;
  // Between the two points of the face at y = 0, in the direction in which the area has the flow to its
  // right.
  std::vector<vector> ends;
  for (const label point : face)
    if (mesh.points()[point].y() < 1e-12) ends.push_back(mesh.points()[point]);
  const vector along = ends.at(1) - ends.at(0);
  const double sign = (along.z() * area.x() - along.x() * area.z()) > 0 ? 1 : -1;
  const double depth = mesh.bounds().max().y();
  return sign * depth * (motion.stream(ends[1].x(), ends[1].z()) - motion.stream(ends[0].x(), ends[0].z()));
}

void set_flow(Flow& flow, const Motion& motion, double factor) {
  const Foam::fvMesh& mesh = flow.mesh;
  forAll(flow.phi, face) flow.phi[face] = factor * flux_of(mesh, mesh.faces()[face], mesh.Sf()[face], motion);
  forAll(mesh.boundary(), patch) {
    forAll(mesh.boundary()[patch], i) flow.phi.boundaryFieldRef()[patch][i] =
        factor * flux_of(mesh, mesh.faces()[mesh.boundary()[patch].start() + i],
                         mesh.Sf().boundaryField()[patch][i], motion);
  }
  const Foam::vectorField velocity = (*flow.reconstruct)([&](const auto& at, label) { return at(flow.phi); });
  const scalarField& eps = flow.porosity->eps.primitiveField();
  forAll(flow.U, cell) flow.U[cell] = velocity[cell] / eps[cell];
  flow.U.correctBoundaryConditions();
}

struct Result {
  double shape_error = 0, volume_error = 0, excess = 0;
};

/// jump: eps alternates between 1 and 0.4 in blocks of four cells.
Result carry(const Motion& motion, int n, const std::string& scheme, int sub_cycles, bool jump) {
  const FoamCase box("interface_advection", {{"lx", "1"},
                                             {"ly", std::to_string(1.0 / n)},
                                             {"lz", "1"},
                                             {"nx", std::to_string(n)},
                                             {"ny", "1"},
                                             {"nz", std::to_string(n)},
                                             {"walls_U", "{ type zeroGradient; }"},
                                             {"bottom_U", "{ type zeroGradient; }"},
                                             {"alpha_scheme", scheme},
                                             {"limiter_iterations", "10"},
                                             {"alpha_sub_cycles", std::to_string(sub_cycles)}});
  const auto flow = box.open(scene(true, true, false));
  const double h = 1.0 / n;
  const auto disc = [&](const vector& x) { return share_of_disc(x, h, motion); };
  set_alpha(*flow, disc);
  const scalarField start(flow->alpha.primitiveField());
  const scalarField eps = cell_values(*flow, [&](const vector& x) {
    const int block = static_cast<int>(x.x() / (4 * h)) + static_cast<int>(x.z() / (4 * h));
    return jump && block % 2 == 0 ? 0.4 : 1.0;
  });
  set_initial_porosity(*flow, eps);
  const double smallest = Foam::min(eps);
  const double liquid = liquid_volume(*flow);
  // Courant number 0.5 of the velocity in the pores
  const int steps = static_cast<int>(std::ceil(motion.turnover / (0.5 * h * smallest) / 2)) * 2;
  Result result;
  begin_window(*flow, motion.turnover);
  flow->clock.limit = motion.turnover / steps;
  for (int step = 0; step < steps; ++step) {
    set_flow(*flow, motion, step < steps / 2 ? 1 : -1);
    flow->time.setDeltaT(motion.turnover / steps, false);
    ++flow->time;
    flow->porosity->eps.oldTime();
    advect_interface(*flow);
    result.volume_error = std::max(result.volume_error, std::abs(liquid_volume(*flow) / liquid - 1));
    for (const double alpha : flow->alpha.primitiveField())
      result.excess = std::max({result.excess, -alpha, alpha - 1});
  }
  double difference = 0, whole = 0;
  forAll(start, cell) {
    difference += eps[cell] * std::abs(flow->alpha[cell] - start[cell]);
    whole += eps[cell] * start[cell];
  }
  result.shape_error = difference / whole;
  return result;
}

TEST(InterfaceAdvection, DiscComesBack) {
  Record record(
      "interface_advection", "Disc of liquid carried out and back",
      "A disc in uniform diagonal flow and in a vortex, reversed at half time; with MULES and "
      "compression, and with isoAdvector's geometric flux under the same limiter; the vortex also "
      "where the void fraction jumps between 1 and 0.4 every four cells. Exact: shape, volume, bounds.",
      "tests/Alltest --verification -- -R foam_flow.InterfaceAdvection");
  for (const bool jump : {false, true})
    for (const Motion& motion : {diagonal, vortex}) {
      // Jumps shear the disc to shreds, and the diagonal flow would carry some of them out of the box.
      if (jump && motion.name == diagonal.name) continue;
      const std::string where = std::string(motion.name) + (jump ? ", eps 1 and 0.4" : "");
      std::vector<double> cells{32, 64};
      std::map<std::string, std::vector<double>> errors;
      for (const std::string scheme : {"MULES", "isoAdvection"}) {
        Result worst;
        for (const double n : cells) {
          const Result result = carry(motion, static_cast<int>(n), scheme, n > 32 ? 2 : 1, jump);
          errors[scheme].push_back(result.shape_error);
          worst.volume_error = std::max(worst.volume_error, result.volume_error);
          worst.excess = std::max(worst.excess, result.excess);
        }
        record.at_most(scheme + ", " + where + ": liquid volume", worst.volume_error, 3e-13);
        record.at_most(scheme + ", " + where + ": alpha outside 0 to 1", worst.excess, 8.8e-15);
        record.note(scheme + ", " + where + ": shape error, 32 cells", errors[scheme][0]);
        record.note(scheme + ", " + where + ": shape error, 64 cells", errors[scheme][1]);
        record.curve(where, "cells per side", "shape error, -", scheme, cells, errors[scheme], "xy");
      }
      record.at_most("isoAdvection against MULES, " + where + ": shape error, 64 cells",
                     errors["isoAdvection"][1] / errors["MULES"][1], 1);
    }
}

}  // namespace
}  // namespace demvof::test
