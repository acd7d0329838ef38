// SPDX-License-Identifier: GPL-3.0-or-later
#include "coupler/transfer/remap.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <random>

#include "coupler/config/enum_names.hpp"
#include "tests/support/mpi_main.hpp"
#include "tests/support/spread_remap.hpp"

namespace demvof {
namespace {

using namespace test;

MappingParameters both(Mapping mapping) {
  return {mapping, mapping};
}

TEST(Remap, BulkVolumesAddUpToTheMesh) {
  for (const Case& c : all_cases(5)) {
    SCOPED_TRACE(c.name);
    const Spread s(MPI_COMM_WORLD, c);
    double volume = 0;
    for (const double v : s.mesh.volume) volume += v;
    volume = s.sum(volume);
    EXPECT_NEAR(volume, c.name == "turned" ? std::pow(0.72, 3) : 1.0, 1e-13);
    EXPECT_NEAR(s.total(s.remap.bulk_volume()), volume, 1e-13);
    if (c.name == "turned") continue;
    for (const double v : s.remap.bulk_volume()) EXPECT_NEAR(v, s.grid.cell_volume(), 1e-13);
  }
}

TEST(Remap, ConstantDensityStaysConstant) {
  for (const auto& [mapping, name] : enum_names<Mapping>)
    for (const Case& c : all_cases(5)) {
      SCOPED_TRACE(c.name + ", " + name);
      const Spread s(MPI_COMM_WORLD, c, both(mapping));
      std::vector<double> totals = s.remap.bulk_volume();
      for (double& total : totals) total *= 0.37;
      for (const double value : s.remap.to_fine(totals, 1)) EXPECT_NEAR(value, 0.37, 1e-13);
    }
}

TEST(Remap, ToFineKeepsTheIntegralAndCreatesNoExtrema) {
  for (const Mapping to_fine : {Mapping::nearest, Mapping::conservative})
    for (const Mapping to_bulk : {Mapping::nearest, Mapping::conservative})
      for (const Case& c : all_cases(6)) {
        SCOPED_TRACE(c.name);
        const Spread s(MPI_COMM_WORLD, c, {to_fine, to_bulk});
        const std::vector<CellId>& cells = s.remap.cells().cells();
        // Three columns: rough and >= 0 with many zeros; one cell alone; smooth of both signs.
        std::vector<double> totals(3 * cells.size()), column(cells.size());
        std::vector<double> largest(3), sums(3), sizes(3);
        for (int m = 0; m < 3; ++m) {
          for (std::size_t slot = 0; slot < cells.size(); ++slot) {
            std::mt19937 random(static_cast<unsigned>(cells[slot]));
            const double x = static_cast<double>(random() % 1000) / 1000;
            const double density = m == 0   ? std::max(0.0, x - 0.5)
                                   : m == 1 ? double(cells[slot] == s.grid.id({3, 3, 3}))
                                            : std::sin(0.7 * cells[slot]) + 3;
            column[slot] = totals[3 * slot + m] = density * s.remap.bulk_volume()[slot];
            largest[m] = std::max(largest[m], density);
          }
          sums[m] = s.total(column);
          largest[m] = s.max(largest[m]);
        }
        const std::vector<double> fine = s.remap.to_fine(totals, 3);
        std::vector<double> fine_column(s.mine.size());
        for (int m = 0; m < 3; ++m) {
          for (std::size_t cell = 0; cell < fine_column.size(); ++cell) {
            fine_column[cell] = fine[3 * cell + m];
            EXPECT_GE(fine_column[cell], 0);
            EXPECT_LE(fine_column[cell], largest[m] * (1 + 1e-13));
          }
          EXPECT_NEAR(s.integral(fine_column), sums[m], 1e-13 * sums[m]);
        }
        if (!c.nested) continue;
        const std::vector<double> back = s.summed(s.remap.partial_sums(fine_column, 1, {}));
        for (std::size_t slot = 0; slot < cells.size(); ++slot)
          EXPECT_NEAR(back[slot], totals[3 * slot + 2], 1e-13 * s.grid.cell_volume()) << "of one bulk cell";
      }
}

TEST(Remap, LinearFieldsComeBackExactlyAwayFromTheBoundary) {
  const Field field = [](const Vec3& x) { return 5 + 2 * x.x - 1.3 * x.y + 0.4 * x.z; };
  for (const Case& c : all_cases(9)) {
    SCOPED_TRACE(c.name);
    const Spread s(MPI_COMM_WORLD, c);
    const auto error = s.inner_error(s.remap.to_fine(s.totals(field), 1), field, c.contains);
    EXPECT_GT(error.cells, 5);
    EXPECT_LT(error.largest, 2e-12);
  }
}

TEST(Remap, PartialSumsWeighSubcellsByVolumeAndWeight) {
  const Case c = unaligned(4);
  const Spread s(MPI_COMM_WORLD, c);
  std::vector<double> values, weight;
  for (const Vec3& centre : s.mesh.centre) {
    values.insert(values.end(), {1.0, centre.x});
    weight.push_back(2.0 + centre.y);
  }
  const std::vector<double> sums = s.remap.partial_sums(values, 2, weight);
  double mass = 0, moment = 0, expected_mass = 0, expected_moment = 0;
  for (std::size_t slot = 0; slot < sums.size() / 2; ++slot)
    mass += sums[2 * slot], moment += sums[2 * slot + 1];
  for (std::size_t cell = 0; cell < weight.size(); ++cell) {
    expected_mass += s.mesh.volume[cell] * weight[cell];
    expected_moment += s.mesh.volume[cell] * weight[cell] * s.mesh.centre[cell].x;
  }
  EXPECT_NEAR(s.sum(mass), 2.5, 1e-13);  // integral of 2 + y
  EXPECT_NEAR(mass, expected_mass, 1e-13);
  EXPECT_NEAR(moment, expected_moment, 1e-13);
}

TEST(Remap, PeriodicSlopesLookAcrossTheEnd) {
  // sin(2 pi x) on 8 periodic cells is as smooth at the ends as inside: nested cells around x = 0 must be
  // sloped, with the steepest slope of all.
  const BulkGrid grid(zero, one, {8, 2, 2}, {true, false, false});
  const Case c{"periodic", grid, hexahedra(zero, one, {32, 4, 4}), true};
  const Spread s(MPI_COMM_WORLD, c);
  const double pi = std::acos(-1.0);
  const std::vector<double> fine =
      s.remap.to_fine(s.totals([&](const Vec3& x) { return std::sin(2 * pi * x.x); }), 1);
  for (std::size_t cell = 0; cell < fine.size(); ++cell) {
    const double x = s.mesh.centre[cell].x;
    if (x > 0.125 && x < 0.875) continue;
    EXPECT_NEAR(fine[cell], std::sin(2 * pi * x), 0.04) << x;
  }
}

TEST(Remap, AnyDecompositionGivesTheResultOfOneRank) {
  const Field field = [](const Vec3& x) {
    return std::max(0.0, std::sin(5 * x.x) * std::cos(7 * x.y + x.z));
  };
  for (const auto& [to_fine, name] : enum_names<Mapping>)
    for (const Case& c : all_cases(6)) {
      SCOPED_TRACE(c.name + ", " + name);
      const MappingParameters mapping{to_fine, Mapping::conservative};
      const Spread spread(MPI_COMM_WORLD, c, mapping), alone(MPI_COMM_SELF, c, mapping);
      const std::vector<double> fine = spread.remap.to_fine(spread.totals(field), 1);
      const std::vector<double> reference = alone.remap.to_fine(alone.totals(field), 1);
      ASSERT_EQ(alone.mine.size(), c.cells.size());
      for (std::size_t cell = 0; cell < fine.size(); ++cell)
        EXPECT_NEAR(fine[cell], reference[spread.mine[cell]], 1e-13);
    }
}

TEST(Remap, ARankWithoutCellsTakesPart) {
  int rank;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  const BulkGrid grid(zero, one, {4, 4, 4});
  const Cells cells = rank == 0 ? hexahedra(zero, one, {8, 8, 8}) : Cells{};
  const Remap remap(MPI_COMM_WORLD, grid, BulkPartition(grid.cells(), Spread::size(MPI_COMM_WORLD)),
                    fine_mesh(cells), MappingParameters());
  EXPECT_EQ(remap.cells().cells().size(), rank == 0 ? 64u : 0u);
  EXPECT_EQ(remap.to_fine(remap.bulk_volume(), 1), std::vector<double>(cells.size(), 1.0));
}

}  // namespace
}  // namespace demvof
