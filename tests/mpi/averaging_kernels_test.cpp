// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/mpi/averaging_kernels.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <random>
#include <utility>

#include "coupler/config/enum_names.hpp"
#include "coupler/transfer/axis_kernel.hpp"
#include "coupler/transfer/sphere_cells.hpp"
#include "tests/support/mpi_main.hpp"

namespace demvof::test {
namespace {

const Kernel all_kernels[] = {Kernel::centre, Kernel::volume, Kernel::linear, Kernel::gaussian,
                              Kernel::diffusion};

std::vector<double> deposited(const BulkGrid& grid, const AveragingParameters& parameters, const Set& set) {
  return Averager(MPI_COMM_SELF, grid, parameters, set).deposit();
}
double total(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0);
}

/// Inside, on walls, edges and corners, and beyond; diameters from 0.1 to 3 cells.
Set awkward(const BulkGrid& grid, int random_ones) {
  std::mt19937 random(17);
  std::uniform_real_distribution<> uniform(0, 1);
  const Vec3 size = grid.upper() - grid.lower();
  const double h = grid.spacing().x;
  Set set;
  const auto add = [&](double x, double y, double z) {
    set.add(grid.lower() + Vec3{x * size.x, y * size.y, z * size.z}, h * (0.05 + 1.45 * uniform(random)),
            0.1 + uniform(random));
  };
  for (int i = 0; i < random_ones; ++i) add(uniform(random), uniform(random), uniform(random));
  for (const double x : {-0.3, 0.0, 0.5, 1.0, 1.2})
    for (const double y : {-2.0, 0.0, 0.25, 1.0})
      for (const double z : {-0.01, 0.0, 1.0, 1.4}) add(x, y, z);
  return set;
}

/// Share of a sphere in a box by the midpoint rule over its chords.
double share_by_chords(const Vec3& centre, double radius, const Vec3& low, const Vec3& high) {
  const int n = 1000;
  const double x0 = std::max(low.x, centre.x - radius), x1 = std::min(high.x, centre.x + radius);
  const double y0 = std::max(low.y, centre.y - radius), y1 = std::min(high.y, centre.y + radius);
  if (x1 <= x0 || y1 <= y0) return 0;
  double sum = 0;
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) {
      const double x = x0 + (x1 - x0) * (i + 0.5) / n - centre.x,
                   y = y0 + (y1 - y0) * (j + 0.5) / n - centre.y;
      const double left = radius * radius - x * x - y * y;
      if (left <= 0) continue;
      const double half = std::sqrt(left);
      sum += std::max(0.0, std::min(high.z, centre.z + half) - std::max(low.z, centre.z - half));
    }
  return sum * (x1 - x0) * (y1 - y0) / n / n / (4 * pi / 3 * std::pow(radius, 3));
}

bool in_grid(const BulkGrid& grid, const Vec3& x) {
  for (int axis = 0; axis < 3; ++axis)
    if (!grid.periodic()[axis] && (x[axis] < grid.lower()[axis] || x[axis] > grid.upper()[axis]))
      return false;
  return true;
}

TEST_F(AveragingKernels, NothingIsLostAndNothingDependsOnTheRanks) {
  for (const Kernel kernel : all_kernels) {
    double worst_sum = 0, worst_difference = 0, lowest = 0, worst_transpose = 0, worst_ledger = 0;
    for (const bool periodic : {false, true}) {
      const BulkGrid grid({0, 0, 1}, {0.8, 0.5, 1.9}, {8, 5, 9}, {periodic, false, periodic});
      const Set set = awkward(grid, 300);
      const AveragingParameters parameters = averaging(kernel, 0.21);
      Averager alone(MPI_COMM_SELF, grid, parameters, set);
      const std::vector<double> cells = alone.deposit();
      double given = 0;  // by those in the grid; where there is no fluid nothing is displaced
      for (std::size_t i = 0; i < set.position.size(); ++i)
        if (in_grid(grid, set.position[i])) given += set.value[i];
      EXPECT_LT(given, total(set.value));
      worst_sum = std::max(worst_sum, std::abs(total(cells) / given - 1));
      lowest = std::min(lowest, *std::min_element(cells.begin(), cells.end()));

      std::mt19937 random(5);
      std::vector<double> field(cells.size());
      for (double& value : field) value = std::uniform_real_distribution<>(-1, 1)(random);
      const std::vector<double> sampled = alone.sample(field);
      const double left = std::inner_product(field.begin(), field.end(), cells.begin(), 0.0);
      const double right = std::inner_product(sampled.begin(), sampled.end(), set.value.begin(), 0.0);
      worst_transpose = std::max(worst_transpose, std::abs(left - right) / given);

      // What the fluid owes to the particles of a cell reaches them in full: M of a cell is shared by beta.
      double owed = 0;
      for (const double impulse : field) owed += impulse;
      const std::vector<double> received = alone.hand_over(field);
      owed -= alone.unplaced_left_over();
      const double handed_over = std::inner_product(received.begin(), received.end(), set.value.begin(), 0.0);
      worst_ledger = std::max(worst_ledger, std::abs(handed_over - owed) / double(cells.size()));

      int rank, size;
      MPI_Comm_rank(MPI_COMM_WORLD, &rank);
      MPI_Comm_size(MPI_COMM_WORLD, &size);
      const double largest = *std::max_element(cells.begin(), cells.end());
      for (int ranks = 2; ranks <= size; ++ranks) {
        MPI_Comm some;
        MPI_Comm_split(MPI_COMM_WORLD, rank < ranks, rank, &some);
        if (rank < ranks) {
          Averager spread(some, grid, parameters, set);
          const std::vector<double> same_cells = spread.deposit(), same_sampled = spread.sample(field);
          for (std::size_t c = 0; c < cells.size(); ++c)
            worst_difference = std::max(worst_difference, std::abs(same_cells[c] - cells[c]) / largest);
          for (std::size_t i = 0; i < sampled.size(); ++i)
            worst_difference = std::max(worst_difference, std::abs(same_sampled[i] - sampled[i]));
        }
        MPI_Comm_free(&some);
      }
    }
    EXPECT_LE(worst_difference, 1e-13);
    record([&](Record& r) {
      const std::string name = name_of(kernel);
      r.at_most(name + ": sum of all cells over what was deposited, less 1", worst_sum, 2e-14);
      r.at_least(name + ": lowest value of a cell", lowest, 0);
      r.at_most(name + ": sample against transposed deposit", worst_transpose, 6e-16);
      r.at_most(name + ": left-over impulse handed to the particles against owed", worst_ledger, 4.9e-16);
      r.at_most(name + ": 2 to 4 ranks against 1", worst_difference, 1e-14);
    });
  }
}

TEST_F(AveragingKernels, WhatIsSampledIsSampledAlike) {
  // The capillary force cancels the pressure gradient of a drop at rest: both are told with the same weights.
  const BulkGrid grid({0, 0, 0}, {0.8, 0.5, 0.9}, {8, 5, 9}, {true, false, false});
  const Set set = awkward(grid, 50);
  std::mt19937 random(3);
  std::vector<double> field(grid.cell_count());
  for (double& value : field) value = std::uniform_real_distribution<>(-1, 1)(random);
  for (const Kernel kernel : all_kernels) {
    Averager all(MPI_COMM_WORLD, grid, averaging(kernel, 0.21), set);
    const std::vector<double> velocity = all.sample(field);
    const auto differs = [&](const std::vector<double>& sampled) {
      double worst = 0;
      for (std::size_t i = 0; i < sampled.size(); ++i)
        worst = std::max(worst, std::abs(sampled[i] - velocity[i]));
      return worst;
    };
    using Fluid = BulkFluid;
    using Gradients = BulkFluidGradients;
    using Felt = FluidAtParticle;
    const double worst =
        std::max({differs(all.sampled(
                      field, [](Fluid& f, Gradients&, double value) { f.pressure_gradient.y = value; },
                      [](const Felt& f) { return f.pressure_gradient.y; })),
                  differs(all.sampled(
                      field, [](Fluid&, Gradients& g, double value) { g.stress_force.z = value; },
                      [](const Felt& f) { return f.gradients.stress_force.z; })),
                  differs(all.sampled(
                      field, [](Fluid&, Gradients& g, double value) { g.acceleration.x = value; },
                      [](const Felt& f) { return f.gradients.acceleration.x; })),
                  differs(all.sampled(
                      field, [](Fluid&, Gradients& g, double value) { g.vorticity.y = value; },
                      [](const Felt& f) { return f.gradients.vorticity.y; }))});
    record([&](Record& r) {
      r.at_most(name_of(kernel) + ": velocity against pressure gradient, stress, acceleration, vorticity",
                worst, 1e-13);
    });
  }
}

TEST_F(AveragingKernels, VolumeSharesAreTheCommonVolume) {
  // Known: an octant, a cap, half a ball.
  EXPECT_NEAR(unit_ball_beyond(0, 0, 0), pi / 6, 1e-15);
  EXPECT_NEAR(unit_ball_beyond(0.3, -1, -1), pi / 3 * 0.49 * 2.3, 1e-15);
  EXPECT_NEAR(unit_ball_beyond(0, -1, -2), 2 * pi / 3, 1e-15);
  EXPECT_EQ(unit_ball_beyond(0.6, 0.6, 0.6), 0);
  EXPECT_EQ(unit_ball_beyond(1, -1, -1), 0);
  double worst = 0;
  const struct {
    Vec3 centre;
    double radius;
  } spheres[] = {{{3.5, 3.5, 3.5}, 0.4},  {{3.5, 3.5, 3.5}, 0.5}, {{3.02, 3.9, 3.41}, 0.3},
                 {{3.2, 3.1, 3.8}, 0.77}, {{3, 3, 3}, 0.6},       {{3.37, 3.61, 3.05}, 1.5}};
  const BulkGrid grid({0, 0, 0}, {7, 7, 7}, {7, 7, 7});
  for (const auto& [centre, radius] : spheres) {
    SphereCells sphere(grid);
    sphere.find(centre, radius);
    double sum = 0;
    const auto [x, y, z] = sphere.spans();
    auto share = sphere.shares().begin();
    for (int k = 0; k < z.count; ++k)
      for (int j = 0; j < y.count; ++j)
        for (int i = 0; i < x.count; ++i, ++share) {
          sum += *share;
          if ((i + j + k) % 2) continue;  // every other cell will do
          const Vec3 low = grid.cell_lower({x.first + i, y.first + j, z.first + k});
          const double expected = share_by_chords(centre, radius, low, low + Vec3{1, 1, 1});
          worst = std::max(worst, std::abs(*share - expected));
        }
    EXPECT_NEAR(sum, 1, 2e-15);
  }
  record([&](Record& r) {
    r.at_most("volume: share against numerical integration (midpoint rule, 1000^2 chords)", worst, 3e-6);
  });
}

TEST_F(AveragingKernels, Moments) {
  // Cells of width 1; mean over positions of the particle within a cell.
  const int n = 41;
  const BulkGrid grid({0, 0, 0}, {n, 1, 1}, {n, 1, 1});
  const double d = 0.5, b = 3, sigma = 0.5;
  const double c = gaussian_cut, phi = std::exp(-0.5 * c * c) / std::sqrt(2 * pi);
  const double cut = 1 - 2 * c * phi / std::erf(c / std::sqrt(2.0));
  const std::map<Kernel, double> expected{{Kernel::centre, 1. / 12},
                                          {Kernel::volume, d * d / 20 + 1. / 12},
                                          {Kernel::linear, 1. / 6},
                                          {Kernel::gaussian, sigma * sigma * cut + 1. / 12},
                                          {Kernel::diffusion, b * b / 2 + 1. / 6}};
  for (const Kernel kernel : all_kernels) {
    const int positions = 400;
    double worst_mean = 0, second = 0;
    for (int p = 0; p < positions; ++p) {
      Set set;
      const double x = n / 2 + (p + 0.5) / positions;
      set.add({x, 0.5, 0.5}, d / 2);
      const std::vector<double> cells = deposited(grid, averaging(kernel, b), set);
      double mean = 0;
      for (int i = 0; i < n; ++i) {
        mean += cells[i] * (i + 0.5 - x);
        second += cells[i] * std::pow(i + 0.5 - x, 2) / positions;
      }
      worst_mean = std::max(worst_mean, std::abs(mean));
    }
    record([&](Record& r) {
      const std::string name = name_of(kernel);
      const std::string first = name + ": centre of the shares less that of the particle, in cells";
      if (kernel == Kernel::linear || kernel == Kernel::diffusion)
        r.at_most(first, worst_mean, 9e-9);
      else if (kernel == Kernel::gaussian)
        r.at_most(first, worst_mean, 5e-3);
      else
        r.note(first, worst_mean);
      r.at_most(name + ": second moment against the kernel's, relative",
                std::abs(second / expected.at(kernel) - 1), 1.8e-5);
    });
  }
}

TEST_F(AveragingKernels, AnEvenSetStaysEvenAtWalls) {
  const BulkGrid grid({0, 0, 0}, {6, 5, 4}, {6, 5, 4}, {false, true, false});
  Set set;
  for (int i = 0; i < 24; ++i)
    for (int j = 0; j < 20; ++j)
      for (int k = 0; k < 16; ++k) set.add({(i + 0.5) / 4, (j + 0.5) / 4, (k + 0.5) / 4}, 0.31);
  for (const Kernel kernel : all_kernels) {
    double worst = 0;
    for (const double value : deposited(grid, averaging(kernel, 2.5), set))
      worst = std::max(worst, std::abs(value / 64 - 1));
    record([&](Record& r) {
      r.at_most(name_of(kernel) + ": unevenness of an even set between walls", worst, 4e-14);
    });
  }
}

TEST_F(AveragingKernels, CrossingACellFace) {
  // Cells of two diameters; the particle moves by two cells through a face, an edge's neighbourhood and
  // walls.
  const BulkGrid grid({0, 0, 0}, {6, 5, 5}, {6, 5, 5});
  const double d = 0.5, b = 6 * d;
  const CellId cell = grid.id({3, 2, 2});
  for (const Kernel kernel : all_kernels) {
    std::vector<double> steps{0.02, 0.002, 0.0002}, jumps;
    for (const double step : steps) {
      double jump = 0;
      std::vector<double> before;
      for (int i = 0; i < 120; ++i) {  // around the places where something begins or ends
        for (const double around : {0.0, 0.25, 2.25, 2.75, 3.0, 3.5, 4.0}) {
          for (int s = 0; s < 2; ++s) {
            Set set;
            const double x = std::max(0.0, around + (i - 60 + s) * step);  // the centre up to the wall
            set.add({x, 2.43 + 0.1 * x, 2.61}, d / 2);
            const std::vector<double> now = deposited(grid, averaging(kernel, b), set);
            if (s == 1)
              for (std::size_t c = 0; c < now.size(); ++c)
                jump = std::max(jump, std::abs(now[c] - before[c]));
            before = now;
          }
        }
      }
      jumps.push_back(jump);
    }
    // The path through the middle of a row of cells.
    std::vector<double> path, share, rate;
    double largest_rate = 0;
    for (double x = 1.5; x <= 3.5001; x += 0.01) {
      Set set;
      set.add({x, 2.5, 2.5}, d / 2);
      path.push_back(x - 3);
      share.push_back(deposited(grid, averaging(kernel, b), set)[cell]);
      if (share.size() > 1)
        largest_rate = std::max(largest_rate, std::abs(share.back() - share.end()[-2]) / 0.01);
    }
    record([&](Record& r) {
      const std::string name = name_of(kernel);
      const std::string jump = name + ": largest change of a share in a step of 2e-4 cells";
      if (kernel == Kernel::centre)
        r.note(jump, jumps.back());
      else
        r.at_most(jump, jumps.back(), 2e-4 * 6);
      r.curve("change of a share in one step", "step / cell width", "largest change, -", name, steps, jumps,
              "xy");
      r.note(name +
                 ": largest d(share)/d(position in cells), mean over 0.01 cells: d(eps)/dt = that U V_p / (h "
                 "V_cell)",
             largest_rate);
      r.curve("share of the cell behind a face (cells of two diameters)",
              "position of the particle / cell width", "share, -", name, path, share, "", "-");
    });
  }
}

TEST_F(AveragingKernels, SpheresLargerThanACell) {
  const BulkGrid grid({0, 0, 0}, {9, 9, 9}, {9, 9, 9});
  Set set;
  set.add({4.5, 4.5, 4.5}, 1.5, 4 * pi / 3 * 1.5 * 1.5 * 1.5);
  for (const Kernel kernel : all_kernels) {
    const std::vector<double> cells = deposited(grid, averaging(kernel, 18), set);
    const double largest = *std::max_element(cells.begin(), cells.end());
    record([&](Record& r) {
      const std::string name =
          name_of(kernel) + ": solid fraction of the fullest cell, sphere of three cells";
      if (kernel == Kernel::volume)
        r.at_most(name, largest, 1 + 1e-14);
      else
        r.note(name, largest);
    });
  }
}

/// A sphere of four fifths of its cell, with a limit of one half: drag, further records and what is told move
/// with the volume.
TEST_F(AveragingKernels, FullCellsShareWhatTheyBringAndAreTold) {
  int ranks;
  MPI_Comm_size(MPI_COMM_WORLD, &ranks);
  const BulkGrid grid({0, 0, 0}, {3, 3, 3}, {3, 3, 3});
  const BulkPartition partition(grid.cells(), ranks);
  AveragingParameters parameters = averaging(Kernel::centre, 0);
  parameters.maximum_solid_fraction = 0.5;
  int rank;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  Set set;  // of the last rank alone
  std::vector<BulkParticles> contributions;
  if (rank == ranks - 1) {
    set.add({1.5, 1.5, 1.5}, 0.3);
    contributions.resize(1);
    contributions[0].solid_volume = 0.8;
    contributions[0].drag_factor = 8;
  }
  Averaging averaging(MPI_COMM_WORLD, grid, partition, parameters);
  averaging.weigh(set.position, set.radius);
  AveragingInFluid& fluid = averaging.in(0);
  const auto contribution = [&](int i) { return contributions[i]; };
  fluid.deposit(contribution);
  const CellValues<BulkParticles> again = fluid.deposit_records<BulkParticles>(contribution);
  const auto share = [&grid](CellId cell) {
    const auto [i, j, k] = grid.ijk(cell);
    const int steps = std::abs(i - 1) + std::abs(j - 1) + std::abs(k - 1);
    return steps == 0 ? 5.0 / 8 : steps == 1 ? 3.0 / 48 : 0.0;
  };
  CellValues<BulkFluid> told;
  double expected = 0;
  for (CellId cell = 0; cell < grid.cell_count(); ++cell) {
    const double number = static_cast<double>(cell * cell);
    expected += share(cell) * number;
    if (partition.owner(cell) != rank) continue;
    for (const CellValues<BulkParticles>* owned : {&std::as_const(fluid).deposited(), &again}) {
      const BulkParticles* particles = find(*owned, cell);
      EXPECT_NEAR(particles ? particles->solid_volume : 0, 0.8 * share(cell), 1e-15);
      EXPECT_NEAR(particles ? particles->drag_factor : 0, 8 * share(cell), 1e-14);
    }
    told.cells.push_back(cell);
    told.values.emplace_back();
    told.values.back().density = 1;
    told.values.back().velocity.x = number;
  }
  const auto felt = fluid.sample(told);
  for (std::size_t i = 0; i < contributions.size(); ++i)
    EXPECT_NEAR(felt(static_cast<int>(i)).velocity.x, expected, 1e-12);
}

}  // namespace
}  // namespace demvof::test
