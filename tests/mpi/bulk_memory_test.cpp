// SPDX-License-Identifier: GPL-3.0-or-later
// What the averaging holds on the rank that holds most, on more and more ranks for one bulk grid: an array of
// the whole grid, or of all ranks, on any of them.
#include <gtest/gtest.h>
#include <malloc.h>

#include <algorithm>
#include <atomic>
#include <cstdlib>
#include <new>

#include "coupler/transfer/averaging.hpp"
#include "tests/support/mpi_main.hpp"

namespace {

std::atomic<long> held{0}, most{0};

}  // namespace

void* operator new(std::size_t size) {
  void* memory = std::malloc(size);
  if (!memory) throw std::bad_alloc();
  const long now = held += static_cast<long>(malloc_usable_size(memory));
  most = std::max(most.load(), now);
  return memory;
}
void operator delete(void* memory) noexcept {
  held -= static_cast<long>(malloc_usable_size(memory));
  std::free(memory);
}
void operator delete(void* memory, std::size_t) noexcept {
  operator delete(memory);
}

namespace demvof {
namespace {

/// Most bytes at any time of a window, particles apart, on the rank of the first ones that has most of them.
long bytes_in_a_window(int ranks, Kernel kernel) {
  int me;
  MPI_Comm_rank(MPI_COMM_WORLD, &me);
  MPI_Comm comm;
  MPI_Comm_split(MPI_COMM_WORLD, me < ranks ? 0 : MPI_UNDEFINED, me, &comm);
  long bytes = 0;
  if (comm != MPI_COMM_NULL) {
    const BulkGrid grid({0, 0, 0}, {1, 1, 1}, {48, 48, 48});
    const BulkPartition partition(grid.cells(), ranks);
    std::vector<Vec3> positions;
    for (const CellId cell : partition.cells(me)) positions.push_back(grid.cell_centre(grid.ijk(cell)));
    const std::vector<double> radii(positions.size(), 0.004);
    const long before = held;
    most = before;
    {
      AveragingParameters parameters;
      parameters.kernel = kernel;
      parameters.bandwidth = 0.1;
      Averaging averaging(comm, grid, partition, parameters);
      averaging.weigh(positions, radii);
      const CellValues<BulkParticles>& sums = averaging.in(0).deposit([](int) {
        BulkParticles one;
        one.solid_volume = one.drag_factor = 1e-9;
        return one;
      });
      CellValues<BulkFluid> fluid{sums.cells, std::vector<BulkFluid>(sums.cells.size())};
      averaging.in(0).sample(fluid);
    }
    bytes = most - before;
    MPI_Comm_free(&comm);
  }
  MPI_Allreduce(MPI_IN_PLACE, &bytes, 1, MPI_LONG, MPI_MAX, MPI_COMM_WORLD);
  return bytes;
}

/// A rank holds its block and a layer around it, or its part of the rows of cells.
TEST(BulkMemory, OfARankFallsWithTheNumberOfRanks) {
  int all, me;
  MPI_Comm_size(MPI_COMM_WORLD, &all);
  MPI_Comm_rank(MPI_COMM_WORLD, &me);
  for (const Kernel kernel : {Kernel::gaussian, Kernel::diffusion}) {
    const long alone = bytes_in_a_window(1, kernel);
    for (int ranks = 1; ranks <= all; ranks *= 2) {
      const double share = static_cast<double>(bytes_in_a_window(ranks, kernel)) / static_cast<double>(alone);
      if (me == 0)
        std::printf("%s, %d ranks: %.0f bytes per cell alone, 1/%.2f of that on the fullest rank\n",
                    kernel == Kernel::gaussian ? "gaussian" : "diffusion", ranks,
                    static_cast<double>(alone) / (48 * 48 * 48), 1 / share);
      EXPECT_LT(share * ranks, 1.6) << ranks << " ranks";
    }
  }
}

}  // namespace
}  // namespace demvof
