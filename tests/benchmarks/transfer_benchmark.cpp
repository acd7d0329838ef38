// SPDX-License-Identifier: GPL-3.0-or-later

// Times of averaging, sampling and mapping at the size of the three-phase dam break: 3900 particles,
// 20 x 10 x 30 bulk cells, 48k and 384k fine cells. Run by hand: transfer_benchmark.

#include <benchmark/benchmark.h>
#include <mpi.h>

#include <random>

#include "coupler/transfer/diffusion.hpp"
#include "coupler/transfer/fluid_weights.hpp"
#include "coupler/transfer/remap.hpp"
#include "tests/support/meshes.hpp"

namespace demvof {
namespace {

const BulkGrid grid({0, 0, 0}, {0.2, 0.1, 0.3}, {20, 10, 30});
const int particle_count = 3900;
const std::vector<double> radii(particle_count, 1.35e-3);

std::vector<Vec3> bed() {  // lower 40 % of the box
  std::mt19937 random(1);
  std::uniform_real_distribution<> uniform(0, 1);
  std::vector<Vec3> positions;
  for (int i = 0; i < particle_count; ++i)
    positions.push_back({0.2 * uniform(random), 0.1 * uniform(random), 0.12 * uniform(random)});
  return positions;
}

AveragingParameters kernel(const benchmark::State& state) {
  AveragingParameters averaging;
  averaging.kernel = static_cast<Kernel>(state.range(0));
  return averaging;
}

void make_weights(benchmark::State& state) {
  const auto positions = bed();
  KernelWeights weights(grid);
  for (auto _ : state) find_kernel_weights(grid, kernel(state), positions, radii, weights);
}
BENCHMARK(make_weights)->ArgName("kernel")->DenseRange(0, 4)->Unit(benchmark::kMillisecond);

void deposit_rows(benchmark::State& state) {
  const KernelWeights kernels = kernel_weights(grid, kernel(state), bed(), radii);
  FluidWeights weights;
  weights.set(kernels);
  for (auto _ : state)
    benchmark::DoNotOptimize(weights.deposit<BulkParticles>([](int) { return BulkParticles{1}; }));
}
BENCHMARK(deposit_rows)->ArgName("kernel")->DenseRange(0, 4)->Unit(benchmark::kMillisecond);

void sample_rows(benchmark::State& state) {
  const KernelWeights kernels = kernel_weights(grid, kernel(state), bed(), radii);
  FluidWeights weights;
  weights.set(kernels);
  const std::vector<BulkParticles> cells(kernels.cells().size());
  for (auto _ : state) {
    auto sampled = weights.samples(cells);
    for (int i = 0; i < particle_count; ++i) benchmark::DoNotOptimize(sampled(i));
  }
}
BENCHMARK(sample_rows)->ArgName("kernel")->DenseRange(0, 4)->Unit(benchmark::kMillisecond);

/// What the diffusion kernel adds to a deposit, and again to a sample.
void diffuse_rows(benchmark::State& state) {
  const Diffusion diffusion(MPI_COMM_SELF, grid, BulkPartition(grid.cells(), 1), 6 * 2.7e-3);
  CellValues<BulkParticles> cells;
  for (CellId cell = 0; cell < 2400; ++cell) {  // the bed
    cells.cells.push_back(cell);
    cells.values.emplace_back().solid_volume = 1e-7;
  }
  for (auto _ : state) benchmark::DoNotOptimize(diffusion.spread(cells));
}
BENCHMARK(diffuse_rows)->Unit(benchmark::kMillisecond);

/// Fine mesh with range(0) cells per bulk cell edge; range(1): turned by 0.3 rad about the box's centre.
FineMesh mesh(const benchmark::State& state) {
  const int n = static_cast<int>(state.range(0));
  test::Map map = [](const Vec3& x) { return x; };
  if (state.range(1)) map = test::rotation({0.1, 0.05, 0.15}, {1, 2, 3}, 0.3);
  return test::fine_mesh(test::hexahedra(grid.lower(), grid.upper(), {20 * n, 10 * n, 30 * n}, map));
}
Remap remap(const FineMesh& mesh) {
  return Remap(MPI_COMM_SELF, grid, BulkPartition(grid.cells(), 1), mesh, MappingParameters());
}

void build_remap(benchmark::State& state) {
  const FineMesh fine = mesh(state);
  for (auto _ : state) benchmark::DoNotOptimize(remap(fine));
}
BENCHMARK(build_remap)
    ->ArgNames({"fine_per_edge", "turned"})
    ->Args({1, 0})
    ->Args({2, 0})
    ->Args({4, 0})
    ->Args({2, 1})
    ->Unit(benchmark::kMillisecond);

void to_fine(benchmark::State& state) {
  const Remap way = remap(mesh(state));
  std::vector<double> totals(way.cells().cells().size() * 8);
  for (std::size_t i = 0; i < totals.size(); ++i) totals[i] = 1e-6 * (1 + std::sin(0.01 * i));
  for (auto _ : state) benchmark::DoNotOptimize(way.to_fine(totals, 8));
}
BENCHMARK(to_fine)
    ->ArgNames({"fine_per_edge", "turned"})
    ->Args({1, 0})
    ->Args({2, 0})
    ->Args({4, 0})
    ->Unit(benchmark::kMillisecond);

void to_bulk(benchmark::State& state) {
  const FineMesh fine = mesh(state);
  const Remap way = remap(fine);
  const std::vector<double> values(fine.volume.size() * 9, 1.0), weight(fine.volume.size(), 0.5);
  for (auto _ : state) benchmark::DoNotOptimize(way.partial_sums(values, 9, weight));
}
BENCHMARK(to_bulk)
    ->ArgNames({"fine_per_edge", "turned"})
    ->Args({1, 0})
    ->Args({2, 0})
    ->Args({4, 0})
    ->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace demvof

int main(int argc, char** argv) {
  MPI_Init(&argc, &argv);
  benchmark::Initialize(&argc, argv);
  benchmark::RunSpecifiedBenchmarks();
  MPI_Finalize();
}
