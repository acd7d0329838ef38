// SPDX-License-Identifier: GPL-3.0-or-later
// Messages to a few ranks that do, or do not, know that they come; and how many messages a rank sends and
// receives.
#include "coupler/grid/sparse_exchange.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <random>
#include <thread>

#include "coupler/grid/bring_to_owners.hpp"
#include "coupler/grid/touched_cells.hpp"

namespace {

std::atomic<int> sent{0}, dense{0};  // messages to one rank; collectives that move something per rank

}  // namespace

// Counted on their way to MPI.
extern "C" {
int MPI_Isend(const void* data, int count, MPI_Datatype type, int to, int tag, MPI_Comm comm,
              MPI_Request* request) {
  ++sent;
  return PMPI_Isend(data, count, type, to, tag, comm, request);
}
int MPI_Issend(const void* data, int count, MPI_Datatype type, int to, int tag, MPI_Comm comm,
               MPI_Request* request) {
  ++sent;
  return PMPI_Issend(data, count, type, to, tag, comm, request);
}
int MPI_Alltoall(const void* out, int out_count, MPI_Datatype out_type, void* in, int in_count,
                 MPI_Datatype in_type, MPI_Comm comm) {
  ++dense;
  return PMPI_Alltoall(out, out_count, out_type, in, in_count, in_type, comm);
}
int MPI_Alltoallv(const void* out, const int* out_counts, const int* out_starts, MPI_Datatype out_type,
                  void* in, const int* in_counts, const int* in_starts, MPI_Datatype in_type, MPI_Comm comm) {
  ++dense;
  return PMPI_Alltoallv(out, out_counts, out_starts, out_type, in, in_counts, in_starts, in_type, comm);
}
int MPI_Allgather(const void* out, int out_count, MPI_Datatype out_type, void* in, int in_count,
                  MPI_Datatype in_type, MPI_Comm comm) {
  ++dense;
  return PMPI_Allgather(out, out_count, out_type, in, in_count, in_type, comm);
}
}

namespace demvof {
namespace {

int rank_, ranks_;

/// What `from` sends to `to` in a round: nothing for most of them, no number at all for some.
std::vector<double> letter(int from, int to, int round) {
  std::mt19937 random(static_cast<unsigned>(1 + from + 100 * to + 10000 * round));
  if (random() % 3 != 0) return {};
  std::vector<double> numbers(random() % 50);
  for (double& number : numbers) number = from + 1e3 * to + 1e6 * round;
  numbers.push_back(static_cast<double>(random()));
  return numbers;
}

TEST(SparseExchange, EveryParcelArrivesOnceInRoundsWithoutAPause) {
  for (int round = 0; round < 300; ++round) {
    if ((round + rank_) % 37 == 0) std::this_thread::sleep_for(std::chrono::milliseconds(2));
    std::vector<Parcel> parcels;
    for (int to = ranks_; to-- > 0;)
      if (const auto numbers = letter(rank_, to, round); !numbers.empty()) parcels.push_back({to, numbers});
    const std::vector<Parcel> received = exchange_with_unknown(MPI_COMM_WORLD, parcels);
    std::size_t next = 0;
    for (int from = 0; from < ranks_; ++from) {
      const auto expected = letter(from, rank_, round);
      if (expected.empty()) continue;
      ASSERT_LT(next, received.size());
      ASSERT_EQ(received[next].rank, from);
      ASSERT_EQ(received[next].numbers, expected) << "round " << round;
      ++next;
    }
    ASSERT_EQ(next, received.size());
  }
}

TEST(SparseExchange, KnownRowsArriveWhereTheyBelong) {
  // Each rank has one row for itself, two for the next and three for the one after that.
  std::vector<RowsOfRank> to, from;
  std::size_t out_rows = 0, in_rows = 0;
  const auto add = [](std::vector<RowsOfRank>& list, int rank, std::size_t count, std::size_t& total) {
    list.push_back({rank, total, count});
    total += count;
  };
  for (int step = 0; step < std::min(3, ranks_); ++step) {
    add(to, (rank_ + step) % ranks_, static_cast<std::size_t>(step) + 1, out_rows);
    add(from, (rank_ - step + ranks_) % ranks_, static_cast<std::size_t>(step) + 1, in_rows);
  }
  for (const int width : {1, 7}) {
    std::vector<double> out(out_rows * width), in(in_rows * width, -1);
    for (std::size_t i = 0; i < out.size(); ++i) out[i] = 1000.0 * rank_ + static_cast<double>(i);
    exchange_with_known(MPI_COMM_WORLD, to, out.data(), from, in.data(), width);
    for (std::size_t n = 0; n < from.size(); ++n)
      for (std::size_t i = 0; i < from[n].count * width; ++i)
        EXPECT_EQ(in[from[n].first * width + i],
                  1000.0 * from[n].rank + static_cast<double>(to[n].first * width + i));
  }
}

/// The block of a rank and a layer around it.
CellRange with_layer(const BulkGrid& grid, const BulkPartition& partition) {
  CellRange cells = partition.block(rank_);
  for (int axis = 0; axis < 3 && rank_ < partition.owners(); ++axis) {
    cells.begin[axis] = std::max(0, cells.begin[axis] - 1);
    cells.end[axis] = std::min(grid.cells()[axis], cells.end[axis] + 1);
  }
  return cells;
}

TEST(SparseExchange, ARankTalksToItsNeighboursOnlyHoweverManyThereAre) {
  exchange_with_unknown(MPI_COMM_WORLD, {});  // the communicator of its own is made once
  for (const std::array<int, 3>& cells : {std::array{3, 3, 4 * ranks_}, {12, 12, 12}}) {
    const BulkGrid grid({0, 0, 0}, {1, 1, 1}, cells);
    const BulkPartition partition(cells, ranks_);
    const CellRange reached = with_layer(grid, partition);
    std::vector<CellId> touches;
    for (int k = reached.begin[2]; k < reached.end[2]; ++k)
      for (int j = reached.begin[1]; j < reached.end[1]; ++j)
        for (int i = reached.begin[0]; i < reached.end[0]; ++i) touches.push_back(grid.id({i, j, k}));
    sent = dense = 0;
    const TouchedCells touched(MPI_COMM_WORLD, partition, touches);
    const auto sums = touched.sum_to_owners(std::vector<double>(touches.size(), 1.0));
    touched.fetch_from_owners(sums, 0.0);
    bring_to_owners(MPI_COMM_WORLD, partition,
                    CellValues<double>{touches, std::vector<double>(touches.size())});
    const int owners = static_cast<int>(partition.owners_within(reached).size());
    EXPECT_EQ(sent, 4 * std::max(0, owners - 1));  // cells, sums, values, records
    EXPECT_EQ(dense, 0);
  }
}

}  // namespace
}  // namespace demvof

int main(int argc, char** argv) {
  MPI_Init(&argc, &argv);
  MPI_Comm_rank(MPI_COMM_WORLD, &demvof::rank_);
  MPI_Comm_size(MPI_COMM_WORLD, &demvof::ranks_);
  testing::InitGoogleTest(&argc, argv);
  const int failed = RUN_ALL_TESTS();
  MPI_Finalize();
  return failed;
}
