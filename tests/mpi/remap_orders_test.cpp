// SPDX-License-Identifier: GPL-3.0-or-later

// Orders of the remap: errors on n = 10 and n = 20 bulk cells per edge. One rank; that the ranks do not
// matter is remap_test's affair.

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <string>

#include "coupler/transfer/remap.hpp"
#include "tests/support/mpi_main.hpp"
#include "tests/support/spread_remap.hpp"

namespace demvof {
namespace {

using namespace test;

/// Equally curved everywhere, so that errors on different sets of cells compare; with a minimum inside.
double curved(const Vec3& x) {
  return 2 * std::pow(x.x - 0.45, 2) + std::pow(x.y - 0.55, 2) + 1.5 * std::pow(x.z - 0.5, 2) +
         0.4 * x.x * x.y;
}
double slope_and_curve(const Vec3& x) {
  return 10 + 6 * x.x - 5 * x.y + 4 * x.z + curved(x);
}

Spread::Error to_fine_error(const Spread& s, const Case& c, const Field& field) {
  return s.inner_error(s.remap.to_fine(s.totals(field), 1), field, c.contains);
}

/// Of the means that the bulk cells get from cell values, against the field at the centres of bulk cells.
Spread::Error to_bulk_error(const Spread& s, const Case& c, const Field& field) {
  std::vector<double> fine;
  for (const Vec3& centre : s.mesh.centre) fine.push_back(field(centre));
  const std::vector<double> sums = s.summed(s.remap.partial_sums(fine, 1, {}));
  const std::vector<char> inner = s.inner(c.contains);
  Spread::Error error;
  for (std::size_t slot = 0; slot < sums.size(); ++slot) {
    if (!inner[slot]) continue;
    const Vec3 centre = s.grid.cell_centre(s.grid.ijk(s.remap.cells().cells()[slot]));
    const double e = std::abs(sums[slot] / s.remap.bulk_volume()[slot] - field(centre));
    error.largest = std::max(error.largest, e);
    error.mean += e;
    error.cells += 1;
  }
  error.mean /= error.cells;
  return error;
}

struct Order {
  double mean, largest;  // of the mean error, of the largest error
};
/// Orders by what was measured; prints the table.
std::map<std::string, Order> orders(Case (*make)(int), const MappingParameters& mapping) {
  using Errors = std::map<std::string, Spread::Error>;
  const auto measure = [&](int n) {
    const Case c = make(n);
    const Spread s(MPI_COMM_WORLD, c, mapping);
    return Errors{{"to_fine", to_fine_error(s, c, slope_and_curve)},
                  {"to_fine at a minimum", to_fine_error(s, c, curved)},
                  {"to_bulk", to_bulk_error(s, c, slope_and_curve)}};
  };
  Errors coarse = measure(10), fine = measure(20);
  std::map<std::string, Order> found;
  for (const auto& [what, e] : coarse) {
    const Spread::Error& f = fine[what];
    const Order& o = found[what] = {std::log2(e.mean / f.mean), std::log2(e.largest / f.largest)};
    std::printf("%-20s mean error %.2e -> %.2e, order %.2f; largest %.2e -> %.2e, order %.2f\n", what.c_str(),
                e.mean, f.mean, o.mean, e.largest, f.largest, o.largest);
  }
  return found;
}

const MappingParameters linear{Mapping::conservative, Mapping::conservative};
const MappingParameters constant{Mapping::nearest, Mapping::conservative};

TEST(RemapOrders, NestedBoxes) {
  const auto found = orders(nested, linear);
  EXPECT_GT(found.at("to_fine").mean, 1.9);
  EXPECT_GT(found.at("to_fine").largest, 1.9);
  EXPECT_GT(found.at("to_fine at a minimum").largest, 1.8);
  EXPECT_GT(found.at("to_bulk").mean, 1.9);
  EXPECT_GT(found.at("to_bulk").largest, 1.9);
}

TEST(RemapOrders, BoxesThatDoNotNest) {
  const auto found = orders(unaligned, linear);
  EXPECT_GT(found.at("to_fine").mean, 1.9);
  EXPECT_GT(found.at("to_fine").largest, 1.9);
  EXPECT_GT(found.at("to_fine at a minimum").largest, 1.8);
  // Of first order: fine data are constant in a cell, so that all subcells of a cell that straddles bulk
  // cells have its mean.
  EXPECT_GT(found.at("to_bulk").mean, 0.9);
}

TEST(RemapOrders, HexahedraWithFacesThatAreNotPlane) {
  const auto found = orders(wobbly, linear);
  EXPECT_GT(found.at("to_fine").mean, 1.8);
  EXPECT_GT(found.at("to_fine").largest, 1.8);
  EXPECT_GT(found.at("to_bulk").mean, 0.9);
}

TEST(RemapOrders, ATurnedMesh) {
  const auto found = orders(turned, linear);
  EXPECT_GT(found.at("to_fine").mean, 1.8);
  // The more cells there are, the closer some of them come to the worst way to straddle.
  EXPECT_GT(found.at("to_fine").largest, 1.4);
  EXPECT_GT(found.at("to_bulk").mean, 0.4);
}

TEST(RemapOrders, ConstantProfilesAreOfFirstOrder) {
  for (const auto make : {nested, unaligned}) {
    const auto found = orders(make, constant);
    EXPECT_GT(found.at("to_fine").mean, 0.8);
    EXPECT_LT(found.at("to_fine").mean, 1.2);
  }
}

}  // namespace
}  // namespace demvof
