// SPDX-License-Identifier: GPL-3.0-or-later
#include "coupler/transfer/kernel_weights.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <random>

#include "coupler/transfer/axis_kernel.hpp"
#include "coupler/transfer/fluid_weights.hpp"

namespace demvof {
namespace {

const Kernel all_kernels[] = {Kernel::centre, Kernel::volume, Kernel::linear, Kernel::gaussian,
                              Kernel::diffusion};

std::vector<double> radii(const std::vector<Vec3>& points, double radius) {
  return std::vector<double>(points.size(), radius);
}

AveragingParameters averaging(Kernel kernel, double width = 0) {
  AveragingParameters parameters;
  parameters.kernel = kernel;
  parameters.width = width;
  return parameters;
}

/// Shares of one particle by cell.
std::map<CellId, double> shares(const BulkGrid& grid, const AveragingParameters& parameters, Vec3 position,
                                double radius = 0.01) {
  const KernelWeights weights = kernel_weights(grid, parameters, {position}, {radius});
  std::map<CellId, double> result;
  weights.for_each_cell(0, [&](int slot, double weight) { result[weights.cells()[slot]] += weight; });
  return result;
}

/// Points inside, on walls, edges and corners, and outside of the box.
std::vector<Vec3> awkward_points(const BulkGrid& grid) {
  std::vector<Vec3> points;
  for (const double x : {-0.4, 0.0, 0.02, 0.5, 0.7311, 1.0, 2.5})
    for (const double y : {-3.0, 0.0, 0.25, 0.99, 1.0, 1.01})
      for (const double z : {-0.001, 0.0, 0.4999999, 1.0, 1.3}) {
        const Vec3 size = grid.upper() - grid.lower();
        points.push_back(grid.lower() + Vec3{x * size.x, y * size.y, z * size.z});
      }
  return points;
}

TEST(KernelWeights, SharesOfEveryParticleAddUpToOne) {
  for (const bool periodic : {false, true})
    for (const std::array<int, 3> cells : {std::array<int, 3>{20, 10, 30}, {1, 1, 1}, {2, 1, 5}})
      for (const Kernel kernel : all_kernels)
        for (const double width : {0.0, 1e-4, 0.013, 0.02, 0.3}) {  // 0.02: reaches whole cells far
          const BulkGrid grid({-0.1, 0, 1}, {0.1, 0.1, 1.3}, cells, {periodic, false, periodic});
          const std::vector<Vec3> points = awkward_points(grid);
          const KernelWeights weights = kernel_weights(grid, averaging(kernel, width), points,
                                                       radii(points, std::min(0.04, width + 0.003)));
          ASSERT_EQ(weights.particles(), int(points.size()));
          EXPECT_TRUE(std::is_sorted(weights.cells().begin(), weights.cells().end()));
          EXPECT_EQ(std::adjacent_find(weights.cells().begin(), weights.cells().end()),
                    weights.cells().end());
          for (int i = 0; i < weights.particles(); ++i) {
            double sum = 0;
            std::vector<int> slots;
            weights.for_each_cell(i, [&](int slot, double weight) {
              EXPECT_GE(weight, 0);
              sum += weight;
              slots.push_back(slot);
            });
            EXPECT_NEAR(sum, 1, 1e-14);
            std::sort(slots.begin(), slots.end());
            EXPECT_EQ(std::adjacent_find(slots.begin(), slots.end()), slots.end()) << "a cell twice";
          }
        }
}

TEST(KernelWeights, NoParticlesNoCells) {
  const KernelWeights weights = kernel_weights(BulkGrid({0, 0, 0}, {1, 1, 1}, {2, 2, 2}), {}, {}, {});
  EXPECT_EQ(weights.particles(), 0);
  EXPECT_TRUE(weights.cells().empty());
}

TEST(KernelWeights, CellsCountByTheirOpenShare) {
  const BulkGrid grid({0, 0, 0}, {4, 1, 1}, {4, 1, 1});
  // Halfway between cells 1 and 2; in cell 3; in cell 0, of which nothing is open.
  const KernelWeights weights = kernel_weights(grid, averaging(Kernel::linear),
                                               {{2, 0.5, 0.5}, {3.5, 0.5, 0.5}, {0.25, 0.5, 0.5}}, {1, 1, 1});
  std::vector<double> share;
  for (const CellId cell : weights.cells())
    share.push_back(std::map<CellId, double>{{0, 0}, {1, 0.25}, {2, 1}, {3, 1}}[cell]);
  FluidWeights open;
  open.set(weights, share);
  std::vector<std::map<CellId, double>> found(3);
  for (int i = 0; i < 3; ++i)
    open.for_each_cell(i, [&](int slot, double weight) {
      if (weight != 0) found[i][weights.cells()[slot]] = weight;
    });
  EXPECT_EQ(found[0], (std::map<CellId, double>{{1, 0.2}, {2, 0.8}}));
  EXPECT_EQ(found[1], (std::map<CellId, double>{{3, 1}}));
  EXPECT_FALSE(open.reaches(2));
  EXPECT_TRUE(found[2].empty()) << "reaches no open cell";
}

/// What a particle has in a cell, found without boxes, runs and folded spans: the product of the shares of
/// the cells, each by itself, of all images of the axis that the cell stands for.
TEST(KernelWeights, ProductsOfTheAxesWhereverTheCellsStand) {
  for (const bool periodic : {false, true})
    for (const int n : {1, 2, 3, 5, 9})
      for (const double width :
           {0.2, 0.5, 0.9, 2.6}) {  // the last reaches round a period of five more than once
        const BulkGrid grid({0, 0, 0}, {double(n), 4, 7}, {n, 4, 7}, {periodic, true, false});
        const auto cumulated = [&](double x) {  // of the cut Gaussian
          const double cut = gaussian_cut / std::sqrt(2.0), z = x / (std::sqrt(2.0) * width);
          return 0.5 * (1 + std::erf(std::clamp(z, -cut, cut)) / std::erf(cut));
        };
        const auto share = [&](int axis, double x, int cell) {
          const int m = grid.cells()[axis];
          double sum = 0;
          for (int image = -60; image < 60; ++image) {
            const bool mirrored = !grid.periodic()[axis] && ((image % (2 * m)) + 2 * m) % (2 * m) >= m;
            const int inside = ((image % m) + m) % m;
            if ((mirrored ? m - 1 - inside : inside) == cell)
              sum += cumulated(image + 1 - x) - cumulated(image - x);
          }
          return sum;
        };
        for (const Vec3& point : {Vec3{0.1 * n, 0.03, 0.2}, {0.97 * n, 3.9, 6.8}, {0.52 * n, 2.2, 3.3}}) {
          double sum = 0;
          for (const auto& [cell, found] : shares(grid, averaging(Kernel::gaussian, width), point)) {
            const std::array<int, 3> ijk = grid.ijk(cell);
            EXPECT_NEAR(found,
                        share(0, point.x, ijk[0]) * share(1, point.y, ijk[1]) * share(2, point.z, ijk[2]),
                        1e-15)
                << n << ' ' << periodic << ' ' << width;
            sum += found;
          }
          EXPECT_NEAR(sum, 1, 1e-14);
        }
      }
}

TEST(KernelWeights, SingleWeightsAreTheProductUntilChanged) {
  const BulkGrid grid({0, 0, 0}, {3, 4, 7}, {3, 4, 7}, {true, false, false});
  // The second and third have the same cells.
  const std::vector<Vec3> points{{0.1, 0.2, 3.3}, {2.9, 2.2, 6.9}, {2.8, 2.1, 6.8}, {1.5, 2, 3}};
  KernelWeights weights = kernel_weights(grid, averaging(Kernel::gaussian), points, radii(points, 1));
  ASSERT_EQ(weights.groups().size(), 3);
  const auto all = [&weights](int particle) {
    std::vector<std::pair<int, double>> found;
    weights.for_each_cell(particle, [&](int slot, double weight) { found.emplace_back(slot, weight); });
    return found;
  };
  const auto first = all(0), second = all(1), third = all(2), fourth = all(3);
  double* single = weights.single(1);
  EXPECT_EQ(all(1), second);
  EXPECT_EQ(all(2), third);
  single[third.size() + 2] = 7;
  EXPECT_EQ(weights.single(1), single) << "they are single already";
  auto changed = third;
  changed[2].second = 7;
  EXPECT_EQ(all(1), second);
  EXPECT_EQ(all(2), changed);
  EXPECT_EQ(all(0), first);
  weights.single(2);
  EXPECT_EQ(all(3), fourth);
  EXPECT_EQ(all(2), changed);
}

/// Particles of the same cells are one group, up to the largest that there is.
TEST(KernelWeights, ParticlesWithTheSameCellsAreGroups) {
  const BulkGrid grid({0, 0, 0}, {4, 4, 4}, {4, 4, 4});
  std::vector<Vec3> points(KernelWeights::most_in_a_group + 3, Vec3{1.2, 1.3, 1.4});
  points.push_back({1.7, 1.3, 1.4});
  points.push_back({1.2, 1.3, 1.4});
  const KernelWeights weights = kernel_weights(grid, averaging(Kernel::linear), points, radii(points, 1));
  std::vector<std::pair<int, int>> found;
  for (const KernelWeights::Group& group : weights.groups()) found.emplace_back(group.first, group.count);
  constexpr int most = KernelWeights::most_in_a_group;
  EXPECT_EQ(found, (std::vector<std::pair<int, int>>{{0, most}, {most, 3}, {most + 3, 1}, {most + 4, 1}}));
  for (int i = 0; i < weights.particles(); ++i) {
    const KernelWeights::Group& group = weights.group_of(i);
    EXPECT_TRUE(group.first <= i && i < group.first + group.count);
  }
}

TEST(KernelWeights, CentreGivesAllToTheCellOfTheParticle) {
  const BulkGrid grid({0, 0, 0}, {2, 1, 3}, {20, 10, 30});
  for (const Vec3& point : awkward_points(grid)) {
    const auto all = shares(grid, averaging(Kernel::centre), point);
    ASSERT_EQ(all.size(), 1u);
    EXPECT_EQ(all.begin()->first, grid.id(grid.locate(point)));
  }
}

TEST(KernelWeights, LinearIsTheTrilinearHat) {
  const BulkGrid grid({0, 0, 0}, {4, 4, 4}, {4, 4, 4});
  const auto inside = shares(grid, averaging(Kernel::linear), {1.7, 2.4, 2.5});
  // centres 1.5 | 2.5 in x (0.8, 0.2), 1.5 | 2.5 in y (0.1, 0.9), on 2.5 in z
  EXPECT_NEAR(inside.at(grid.id({1, 1, 2})), 0.08, 1e-15);
  EXPECT_NEAR(inside.at(grid.id({2, 1, 2})), 0.02, 1e-15);
  EXPECT_NEAR(inside.at(grid.id({1, 2, 2})), 0.72, 1e-15);
  EXPECT_NEAR(inside.at(grid.id({2, 2, 2})), 0.18, 1e-15);
  const auto corner = shares(grid, averaging(Kernel::linear), {0.1, 4, -2});
  EXPECT_NEAR(corner.at(grid.id({0, 3, 0})), 1, 1e-15);
}

TEST(KernelWeights, LinearKernelSamplesLinearFieldsExactly) {
  const BulkGrid grid({0, -1, 3}, {2, 0, 6}, {8, 5, 9});
  const auto field = [](const Vec3& x) { return 3 - 2 * x.x + 7 * x.y + 0.5 * x.z; };
  std::mt19937 random(3);
  std::vector<Vec3> points;
  for (int i = 0; i < 500; ++i) {  // at least half a cell away from walls
    const auto in = [&](double low, double high) {
      return std::uniform_real_distribution<>(low, high)(random);
    };
    points.push_back({in(0.125, 1.875), in(-0.9, -0.1), in(3 + 1. / 6, 6 - 1. / 6)});
  }
  const KernelWeights weights = kernel_weights(grid, averaging(Kernel::linear), points, radii(points, 1));
  std::vector<double> cell_values, values(points.size());
  for (const CellId cell : weights.cells()) cell_values.push_back(field(grid.cell_centre(grid.ijk(cell))));
  FluidWeights all;
  all.set(weights);
  auto sampled = all.samples(cell_values);
  for (int i = 0; i < weights.particles(); ++i) values[i] = sampled(i);
  for (std::size_t i = 0; i < points.size(); ++i) EXPECT_NEAR(values[i], field(points[i]), 2e-14);
}

TEST(KernelWeights, GaussianSharesAreIntegralsOfTheCutGaussian) {
  // Independent: Simpson's rule for the density of one axis, far from walls.
  const BulkGrid grid({0, 0, 0}, {20, 1, 1}, {20, 1, 1});
  const double x_p = 9.83, width = 0.7;
  const auto density = [&](double x) { return std::exp(-0.5 * std::pow((x - x_p) / width, 2)); };
  const auto integral = [&](double a, double b) {
    a = std::clamp(a, x_p - gaussian_cut * width, x_p + gaussian_cut * width);
    b = std::clamp(b, x_p - gaussian_cut * width, x_p + gaussian_cut * width);
    const int n = 2000;
    double sum = 0;
    for (int i = 0; i < n; ++i) {
      const double l = a + (b - a) * i / n, r = a + (b - a) * (i + 1) / n;
      sum += (density(l) + 4 * density(0.5 * (l + r)) + density(r)) * (b - a) / n / 6;
    }
    return sum;
  };
  const double all = integral(0, 20);
  const auto result = shares(grid, averaging(Kernel::gaussian, width), {x_p, 0.5, 0.5});
  for (int cell = 0; cell < 20; ++cell) {
    const auto found = result.find(cell);
    EXPECT_NEAR(found == result.end() ? 0 : found->second, integral(cell, cell + 1) / all, 1e-9) << cell;
  }
}

TEST(KernelWeights, GaussianSecondMomentIsThatOfTheCutGaussian) {
  // On cells much smaller than the width, sum w (x_c - x_p)^2 = variance of the cut Gaussian + h^2/12, and
  // the cut Gaussian's variance is width^2 (1 - 2 c phi(c) / erf(c/sqrt 2)).
  const BulkGrid grid({0, 0, 0}, {1, 1, 1}, {400, 1, 1});
  const double width = 0.05, c = gaussian_cut;
  const double phi = std::exp(-0.5 * c * c) / std::sqrt(2 * std::acos(-1.0));
  const double variance = width * width * (1 - 2 * c * phi / std::erf(c / std::sqrt(2.0)));
  const Vec3 position{0.50125, 0.5, 0.5};
  double mean = 0, second = 0;
  for (const auto& [cell, share] : shares(grid, averaging(Kernel::gaussian, width), position)) {
    const double d = grid.cell_centre(grid.ijk(cell)).x - position.x;
    mean += share * d;
    second += share * d * d;
  }
  EXPECT_NEAR(mean, 0, 1e-12);
  EXPECT_NEAR(second / variance, 1, 3e-3);  // cells of 0.05 widths
  EXPECT_NEAR(second / (width * width), 1, 0.03);
}

TEST(KernelWeights, LinearAndGaussianAreContinuousInThePositionOfTheParticle) {
  const BulkGrid grid({0, 0, 0}, {1, 1, 1}, {10, 10, 10}, {false, false, true});
  const Vec3 from{-0.05, 0.93, -0.21}, path{1.13, -0.77, 1.37};  // through walls, faces and the periodic end
  for (const double width : {0.0, 0.027, 0.2})
    for (const Kernel kernel : {Kernel::linear, Kernel::gaussian}) {
      double largest = 0;
      const double step = 1e-3;
      auto before = shares(grid, averaging(kernel, width), from);
      for (double t = step; t < 1; t += step) {
        auto now = shares(grid, averaging(kernel, width), from + t * path);
        for (const auto& [cell, share] : now) largest = std::max(largest, std::abs(share - before[cell]));
        for (const auto& [cell, share] : before) largest = std::max(largest, std::abs(share - now[cell]));
        before = now;
      }
      // Along one axis a share rises at most as fast as the kernel is high: 1/h for the hat, the peak of the
      // Gaussian for the other.
      const double sigma = width > 0 ? width : 0.05;
      const double peak = kernel == Kernel::linear ? 10 : 0.4 / sigma;
      EXPECT_LE(largest, step * (1.13 + 0.77 + 1.37) * peak)
          << "kernel " << int(kernel) << " width " << width;
      // And nothing jumps where a cell is entered or left.
      double jump = 0;
      for (double x = 0; x <= 1.0001; x += 0.05)
        for (const double cut : {0.0, gaussian_cut * sigma}) {
          auto low = shares(grid, averaging(kernel, width), {x - cut - 1e-11, 0.31, 0.5});
          auto high = shares(grid, averaging(kernel, width), {x - cut + 1e-11, 0.31, 0.5});
          for (const auto& [cell, share] : low) jump = std::max(jump, std::abs(share - high[cell]));
          for (const auto& [cell, share] : high) jump = std::max(jump, std::abs(share - low[cell]));
        }
      EXPECT_LT(jump, 1e-8);
    }
}

TEST(KernelWeights, AnEvenSpreadUpToTheWallStaysEven) {
  // Particles at equal spacing d from wall to wall (the first at d/2): every cell must get the same.
  const BulkGrid grid({0, 0, 0}, {1, 1, 1}, {5, 1, 1});
  std::vector<Vec3> points;
  for (int i = 0; i < 1000; ++i) points.push_back({(i + 0.5) / 1000, 0.5, 0.5});
  const std::vector<double> ones(points.size(), 1.0);
  for (const Kernel kernel : all_kernels) {
    const KernelWeights weights = kernel_weights(grid, averaging(kernel, 0.13), points, radii(points, 0.31));
    FluidWeights all;
    all.set(weights);
    const auto sums = all.deposit<double>([](int) { return 1.0; });
    ASSERT_EQ(sums.size(), 5u);
    for (const double sum : sums) EXPECT_NEAR(sum, 200, 0.01) << "kernel " << int(kernel);
  }
}

struct Row {
  double a = 1, b = 2, c = 3, d = 4, e = 5, f = 6;  // sums start from 0 whatever these are
};

double dot(const Row& x, const Row& y) {
  return x.a * y.a + x.b * y.b + x.c * y.c + x.d * y.d + x.e * y.e + x.f * y.f;
}

TEST(FluidWeights, DepositKeepsTotalsAndSampleIsItsTranspose) {
  const BulkGrid grid({0, 0, 0}, {2, 1, 3}, {20, 10, 30}, {true, false, false});
  std::mt19937 random(11);
  std::uniform_real_distribution<> uniform(-1, 1);
  const auto any_row = [&] {
    Row row;
    for (double* number : {&row.a, &row.b, &row.c, &row.d, &row.e, &row.f}) *number = uniform(random);
    return row;
  };
  const std::vector<Vec3> points = awkward_points(grid);
  for (const Kernel kernel : all_kernels)
    for (const bool shared : {false, true}) {
      const KernelWeights kernels = kernel_weights(grid, averaging(kernel), points, radii(points, 0.13));
      std::vector<double> share;
      for (std::size_t c = 0; shared && c < kernels.cells().size(); ++c)
        share.push_back(std::max(0.0, uniform(random)));
      FluidWeights weights;
      weights.set(kernels, share);
      std::vector<Row> a, b;
      for (std::size_t i = 0; i < points.size(); ++i) a.push_back(any_row());
      for (std::size_t c = 0; c < kernels.cells().size(); ++c) b.push_back(any_row());
      const std::vector<Row> deposited = weights.deposit<Row>([&](int i) { return a[i]; });
      auto sampled = weights.samples(b);
      double given = 0, received = 0, left = 0, right = 0, size = 0;
      for (int i = 0; i < weights.particles(); ++i) {
        EXPECT_TRUE(shared || weights.reaches(i));
        given += weights.reaches(i) ? a[i].c : 0;
        size += std::sqrt(dot(a[i], a[i]));
        right += dot(a[i], sampled(i));
        double sum = 0, squares = 0;
        double mean_b = 0, mean_e = 0;
        weights.for_each_cell(i, [&](int slot, double weight) {
          EXPECT_TRUE(share.empty() || share[slot] > 0);
          sum += weight;
          squares += weight * weight;
          mean_b += weight * b[slot].b;
          mean_e += weight * b[slot].e;
        });
        EXPECT_NEAR(sampled(i).b, mean_b, 1e-15);
        EXPECT_NEAR(sampled(i).e, mean_e, 1e-15);
        EXPECT_NEAR(sum, weights.reaches(i) ? 1 : 0, 1e-14);
        EXPECT_NEAR(weights.squares(i), squares, 1e-15);
      }
      for (std::size_t c = 0; c < b.size(); ++c) {
        received += deposited[c].c;
        left += dot(deposited[c], b[c]);
      }
      EXPECT_NEAR(received, given, 1e-14 * size);
      EXPECT_NEAR(left, right, 1e-14 * size);
    }
}

}  // namespace
}  // namespace demvof
