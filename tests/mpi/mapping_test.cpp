// SPDX-License-Identifier: GPL-3.0-or-later

// Row `mapping` of the verification table: every mapping strategy in both directions on refined sequences of
// meshes in all relations to the bulk grid. Values at points of the fine mesh (to_bulk: inverse_distance,
// cell_point, cell_point_face) are OpenFOAM's affair: row `mapping_to_bulk`.

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <map>
#include <string>
#include <vector>

#include "coupler/config/enum_names.hpp"
#include "coupler/transfer/remap.hpp"
#include "tests/support/mpi_main.hpp"
#include "tests/support/record.hpp"
#include "tests/support/spread_remap.hpp"

namespace demvof {
namespace {

using namespace test;

const std::vector<Mapping> strategies = {Mapping::nearest, Mapping::inverse_distance, Mapping::cell_point,
                                         Mapping::cell_point_face, Mapping::conservative};
/// Bulk cells per edge; a turned mesh leaves no inner cell on the coarsest.
std::vector<int> sequence(const std::string& name) {
  if (name == "turned") return {10, 20};
  return {5, 10, 20};
}

double smooth(const Vec3& x) {
  return 2 + std::sin(2 * x.x + 0.3) + std::cos(1.7 * x.y) * x.z + 0.5 * x.x * x.z;
}
Vec3 gradient(const Vec3& x) {
  return {2 * std::cos(2 * x.x + 0.3) + 0.5 * x.z, -1.7 * std::sin(1.7 * x.y) * x.z,
          std::cos(1.7 * x.y) + 0.5 * x.x};
}
double linear(const Vec3& x) {
  return 3 + 1.4 * x.x - 0.6 * x.y + 0.9 * x.z;
}

/// Order between the last two of a sequence that halves the spacing.
double order(const std::vector<double>& errors) {
  return std::log2(errors[errors.size() - 2] / errors.back());
}
/// Mean order over the sequence, for constant profiles: how fine cells straddle bulk cells differs from one
/// mesh to the next, and with it the factor of an error of first order.
double mean_order(const std::vector<double>& errors) {
  return std::log2(errors.front() / errors.back()) / static_cast<double>(errors.size() - 1);
}
std::vector<double> spacings(const std::string& name) {
  std::vector<double> h;
  for (const int n : sequence(name)) h.push_back(1.0 / n);
  return h;
}

/// Over a box, by Gauss's rule of three points per axis.
double mean_in_box(const Vec3& centre, const Vec3& size) {
  const double node = std::sqrt(0.15), weight[] = {5. / 18, 8. / 18, 5. / 18};
  double mean = 0;
  for (int i = 0; i < 27; ++i) {
    const Vec3 at{centre.x + (i % 3 - 1) * node * size.x, centre.y + (i / 3 % 3 - 1) * node * size.y,
                  centre.z + (i / 9 - 1) * node * size.z};
    mean += weight[i % 3] * weight[i / 3 % 3] * weight[i / 9] * smooth(at);
  }
  return mean;
}

/// Mean error of the bulk values against the field's mean over the cell, inside.
double to_bulk_error(const Spread& s, const Case& c, bool with_gradient) {
  std::vector<double> fine;
  std::vector<Vec3> slope;
  for (const Vec3& centre : s.mesh.centre) {
    fine.push_back(smooth(centre));
    if (with_gradient) slope.push_back(gradient(centre));
  }
  const std::vector<double> sums = s.summed(s.remap.partial_sums(fine, 1, {}, slope));
  const std::vector<char> inner = s.inner(c.contains);
  double error = 0, count = 0;
  for (std::size_t slot = 0; slot < sums.size(); ++slot) {
    if (!inner[slot]) continue;
    const Vec3 centre = s.grid.cell_centre(s.grid.ijk(s.remap.cells().cells()[slot]));
    error += std::abs(sums[slot] / s.remap.bulk_volume()[slot] - mean_in_box(centre, s.grid.spacing()));
    ++count;
  }
  return error / count;
}

/// |integral on the fine mesh / sum of the bulk totals - 1|
double integral_error(const Spread& s, const Field& field) {
  const std::vector<double> totals = s.totals(field);
  return std::abs(s.integral(s.remap.to_fine(totals, 1)) / s.total(totals) - 1);
}

/// Boxes that nest, those in the corner below half split into eight.
Case refined(int n) {
  Case c{"refined", BulkGrid(zero, one, {n, n, n}), {}, true};
  const double h = 1.0 / n;
  for (int k = 0; k < n; ++k)
    for (int j = 0; j < n; ++j)
      for (int i = 0; i < n; ++i) {
        const Vec3 lower{i * h, j * h, k * h};
        const int parts = i + j + k < n ? 2 : 1;
        const Cells cells = hexahedra(lower, lower + Vec3{h, h, h}, {parts, parts, parts});
        c.cells.insert(c.cells.end(), cells.begin(), cells.end());
      }
  return c;
}
Case coarse(int n) {
  return {"coarse", BulkGrid(zero, one, {n, n, n}), hexahedra(zero, one, {n, n, n}), true};
}

TEST(Mapping, ReachesItsOrderAndKeepsWhatItPromises) {
  Record record(
      "mapping", "Mapping between bulk grid and fine mesh",
      "Polyhedral meshes of the unit box (nested in the bulk grid, not nested, turned by 0.25 rad, with "
      "faces "
      "that are not plane) on 5, 10 and 20 bulk cells per edge (turned: 10 and 20). Mean error of a smooth "
      "field inside, its "
      "order, "
      "and the relative error of the integral. nearest and conservative keep the integral on any mesh; the "
      "paper's interpolations do not, and by how much is recorded.",
      "tests/Alltest --verification -- -R mapping_test");

  const std::map<Mapping, double> least = {{Mapping::nearest, 0.85},
                                           {Mapping::inverse_distance, 0.85},
                                           {Mapping::cell_point, 1.8},
                                           {Mapping::cell_point_face, 1.8},
                                           {Mapping::conservative, 1.8}};
  Case (*const makes[])(int) = {nested, unaligned, turned, wobbly};
  for (const auto make : makes) {
    const std::string name = make(5).name;
    std::map<Mapping, std::vector<double>> errors;
    std::map<Mapping, double> lost;
    std::vector<double> first_order, second_order;
    for (const int n : sequence(name)) {
      const Case c = make(n);
      for (const Mapping mapping : strategies) {
        const Spread s(MPI_COMM_WORLD, c, {mapping, Mapping::conservative});
        errors[mapping].push_back(
            s.inner_error(s.remap.to_fine(s.totals(smooth), 1), smooth, c.contains).mean);
        lost[mapping] = integral_error(s, smooth);
      }
      const Spread s(MPI_COMM_WORLD, c);
      first_order.push_back(to_bulk_error(s, c, false));
      second_order.push_back(to_bulk_error(s, c, true));
    }
    for (const Mapping mapping : strategies) {
      const std::string what = name + ", to_fine " + name_of(mapping);
      const bool constant = mapping == Mapping::nearest;
      record.at_least(what + ": order", constant ? mean_order(errors[mapping]) : order(errors[mapping]),
                      least.at(mapping));
      if (interpolates(mapping))
        record.note(what + ": integral error at 20 cells", lost[mapping]);
      else
        record.at_most(what + ": integral error at 20 cells", lost[mapping], 2e-13);
      record.curve("To the fine mesh, " + name, "bulk spacing, -", "mean error, -", name_of(mapping),
                   spacings(name), errors[mapping], "xy");
    }
    record.at_least(name + ", to_bulk conservative: order", order(second_order), 1.85);
    if (name != "nested") record.note(name + ", to_bulk without a profile: order", order(first_order));
    record.curve("To the bulk grid, " + name, "bulk spacing, -", "mean error, -", "conservative",
                 spacings(name), second_order, "xy");
    record.curve("To the bulk grid, " + name, "bulk spacing, -", "mean error, -", "constant in a fine cell",
                 spacings(name), first_order, "xy");
  }

  // Up to the walls: a linear field on a full box.
  const Case box = unaligned(10);
  for (const Mapping mapping : {Mapping::cell_point, Mapping::cell_point_face, Mapping::conservative}) {
    const Spread s(MPI_COMM_WORLD, box, {mapping, Mapping::conservative});
    const std::vector<double> fine = s.remap.to_fine(s.totals(linear), 1);
    double worst = 0;
    for (std::size_t cell = 0; cell < fine.size(); ++cell)
      worst = std::max(worst, std::abs(fine[cell] - linear(s.mesh.centre[cell])));
    const std::string what = "linear field up to the walls, " + name_of(mapping);
    if (mapping == Mapping::cell_point_face)
      record.at_most(what, s.max(worst), 6e-14);
    else
      record.note(what, s.max(worst));
  }

  // A mesh change: what lies on the bulk grid goes to the old and to the new mesh, and back.
  double change = 0;
  for (const Mapping mapping : {Mapping::nearest, Mapping::conservative}) {
    const Spread before(MPI_COMM_WORLD, coarse(8), {mapping, mapping});
    const Spread after(MPI_COMM_WORLD, refined(8), {mapping, mapping});
    const std::vector<double> totals = before.totals(smooth);
    const double there = before.integral(before.remap.to_fine(totals, 1));
    const std::vector<double> fine = after.remap.to_fine(totals, 1);
    change = std::max(change, std::abs(after.integral(fine) / there - 1));
    const std::vector<double> back = after.summed(after.remap.partial_sums(fine, 1, {}));
    for (std::size_t slot = 0; slot < back.size(); ++slot)
      change = std::max(change, std::abs(back[slot] / totals[slot] - 1));
  }
  record.at_most("cells refined in between: change of integrals and of bulk totals", change, 8e-15);

  // The sum over the bulk cells with any profile in the fine cells.
  double kept = 0;
  for (const auto make : makes) {
    const Spread s(MPI_COMM_WORLD, make(6));
    std::vector<double> fine;
    std::vector<Vec3> slope;
    for (const Vec3& x : s.mesh.centre) {
      fine.push_back(smooth(x));
      slope.push_back({std::sin(40 * x.x), 5 * std::cos(30 * x.y), -7 * x.z});
    }
    const std::vector<double> sums = s.remap.partial_sums(fine, 1, {}, slope);
    double total = 0;
    for (const double sum : sums) total += sum;
    kept = std::max(kept, std::abs(s.sum(total) / s.integral(fine) - 1));
  }
  record.at_most("to_bulk conservative: integral error", kept, 5e-14);
}

}  // namespace
}  // namespace demvof
