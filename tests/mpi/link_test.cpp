// SPDX-License-Identifier: GPL-3.0-or-later
#include "coupler/link/link.hpp"

#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <random>

#include "both_sides.hpp"
#include "coupler/base/errors.hpp"
#include "world_user.hpp"

namespace demvof {
namespace {

using test::on_fluid_side;
using test::world;

constexpr double time_out = 60;

double now() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

double cpu_seconds() {
  rusage usage;
  getrusage(RUSAGE_SELF, &usage);
  const auto seconds = [](const timeval& t) { return static_cast<double>(t.tv_sec) + 1e-6 * t.tv_usec; };
  return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

// A record whose every number says where it comes from.
BulkParticles record_of(CellId cell, int round) {
  BulkParticles record;
  auto* numbers = reinterpret_cast<double*>(&record);
  for (int i = 0; i < row_width<BulkParticles>(); ++i)
    numbers[i] = static_cast<double>(cell) + 0.001 * i + 1e6 * round;
  return record;
}

std::vector<CellId> random_cells(CellId count, double share, unsigned seed) {
  std::mt19937 random(seed);
  std::bernoulli_distribution active(share);
  std::vector<CellId> cells;
  for (CellId cell = 0; cell < count; ++cell)
    if (active(random)) cells.push_back(cell);
  return cells;
}

// The part of all active cells that a rank owns.
CellValues<BulkParticles> part(const std::vector<CellId>& all, const BulkPartition& partition, int rank,
                               int round) {
  CellValues<BulkParticles> mine;
  for (CellId cell : all)
    if (partition.owner(cell) == rank) {
      mine.cells.push_back(cell);
      mine.values.push_back(record_of(cell, round));
    }
  return mine;
}

void expect_equal(const CellValues<BulkParticles>& got, const CellValues<BulkParticles>& expected) {
  ASSERT_EQ(got.cells, expected.cells);
  ASSERT_EQ(got.values.size(), expected.values.size());
  for (std::size_t i = 0; i < got.values.size(); ++i)
    EXPECT_EQ(std::memcmp(&got.values[i], &expected.values[i], sizeof(BulkParticles)), 0)
        << "cell " << got.cells[i];
}

TEST(OwnWorld, HoldsTheRanksOfOneProgramOnly) {
  EXPECT_EQ(world().size() + world().partner_size(), static_cast<int>(world().pair().processes.size()));
  int size = 0, rank = 0;
  MPI_Comm_size(MPI_COMM_WORLD, &size);
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  EXPECT_EQ(size, world().size());
  EXPECT_EQ(rank, world().rank());
  // Only ranks of this side take part in a reduction over "the world".
  int sum = 0;
  const int one = 1;
  MPI_Allreduce(&one, &sum, 1, MPI_INT, MPI_SUM, MPI_COMM_WORLD);
  EXPECT_EQ(sum, world().size());
  const Process& leader = world().pair().processes[world().partner_leader()];
  EXPECT_NE(leader.side, world().side());
  EXPECT_EQ(leader.rank, 0);
}

TEST(OwnWorld, IsTheWorldOfASharedLibrary) {
  EXPECT_EQ(world_user_size(), world().size());
  EXPECT_EQ(world_user_sum(1), world().size());
  EXPECT_EQ(world_user_largest_rank(), world().size() - 1);
  EXPECT_THROW(world_user_gives_up(), SolverStopped);
}

TEST(OwnWorld, LibrariesMayInitialiseAgain) {
  EXPECT_EQ(MPI_Init(nullptr, nullptr), MPI_SUCCESS);
  int provided = -1;
  EXPECT_EQ(MPI_Init_thread(nullptr, nullptr, MPI_THREAD_SINGLE, &provided), MPI_SUCCESS);
  EXPECT_GE(provided, MPI_THREAD_SINGLE);
}

TEST(OwnWorld, UnannouncedEndsBecomeExceptions) {
  EXPECT_THROW(MPI_Finalize(), SolverStopped);
  EXPECT_THROW(MPI_Abort(MPI_COMM_WORLD, 1), SolverStopped);
}

TEST(Link, ExchangesRandomActiveCells) {
  for (const std::array<int, 3> cells :
       {std::array{1, 1, 1}, {3, 1, 1}, {1, 1, 7}, {10, 10, 10}, {20, 1, 9}}) {
    Link link(world(), cells, time_out);
    const CellId count = link.mine().cell_count();
    for (int round = 0; round < 5; ++round) {
      const auto from_particles = random_cells(count, 0.3, 17 * round),
                 to_particles = random_cells(count, 0.7, round);
      const auto expected =
          part(on_fluid_side() ? from_particles : to_particles, link.mine(), world().rank(), round);
      const auto owned =
          part(on_fluid_side() ? to_particles : from_particles, link.mine(), world().rank(), round);
      link.send(owned);
      expect_equal(link.receive<BulkParticles>(), expected);
    }
    link.close();
  }
}

TEST(Link, SendsEachActiveCellOnceAndNothingElse) {
  constexpr std::array<int, 3> grid{20, 10, 25};
  constexpr int width = row_width<BulkParticles>();
  for (const double share : {0.0, 0.02, 0.4}) {
    Link link(world(), grid, time_out);
    const auto active = random_cells(link.mine().cell_count(), share, 5);
    link.send(part(active, link.mine(), world().rank(), 0));
    link.receive<BulkParticles>();
    const double bytes = test::sum_over_both(static_cast<double>(link.statistics().bytes_sent));
    const double cells = test::sum_over_both(static_cast<double>(link.statistics().cells_sent));
    EXPECT_EQ(cells, 2.0 * active.size());
    // A cell is its number and its row; a message between two ranks adds 16 bytes, and of so few ranks there
    // are fewer pairs than ranks.
    const double rows = 2.0 * active.size() * 8 * (1 + width);
    EXPECT_GE(bytes, rows);
    EXPECT_LE(bytes, rows + 16 * 2 * (world().size() + world().partner_size() - 1));
    EXPECT_EQ(bytes, test::sum_over_both(static_cast<double>(link.statistics().bytes_received)));
    link.close();
  }
}

TEST(Link, RefusesCellsOfOtherRanks) {
  Link link(world(), {4, 5, 5}, time_out);
  const int other = (world().rank() + 1) % world().size();
  CellValues<double> foreign{{world().size() == 1 ? CellId{100} : link.mine().cells(other).at(3)}, {1.0}};
  EXPECT_THROW(link.send(foreign), std::logic_error);
  link.close();
}

TEST(Link, SwapsTexts) {
  Link link(world(), {10, 1, 1}, time_out);
  for (const std::size_t length : {0, 1, 7, 8, 100000}) {
    const std::string mine(length, on_fluid_side() ? 'f' : 'p');
    EXPECT_EQ(link.swap_text(mine), std::string(length, on_fluid_side() ? 'p' : 'f'));
  }
  link.close();
}

TEST(Link, AnyRankCanEndBothSides) {
  Link link(world(), {10, 1, 1}, time_out);
  EXPECT_TRUE(link.agree_to_continue(Continue::run));
  const bool last_of_particles = !on_fluid_side() && world().rank() == world().size() - 1;
  EXPECT_FALSE(link.agree_to_continue(last_of_particles ? Continue::stop_requested : Continue::run));
  EXPECT_EQ(link.agreement(), Continue::stop_requested);
  const bool first_of_fluid = on_fluid_side() && world().rank() == 0;
  EXPECT_FALSE(link.agree_to_continue(first_of_fluid ? Continue::failed : Continue::stop_requested));
  EXPECT_EQ(link.agreement(), Continue::failed);
  EXPECT_TRUE(link.agree_to_continue(Continue::run));
  link.close();
}

TEST(Handshake, AgreesWithinTolerances) {
  Link link(world(), {10, 1, 1}, time_out);
  const std::string window = on_fluid_side() ? "2e-4" : "0.00020000000001";
  const std::string own = on_fluid_side() ? "fluid only" : "particles only";
  const std::string facts = on_fluid_side() ? R"({"cells": 48000})" : R"({"particles": 3883})";
  EXPECT_EQ(link.handshake(
                {{"coupling.window", window, 1e-9}, {own, "anything"}, {"gravity", "0 0 -9.81", 0}}, facts),
            on_fluid_side() ? R"({"particles": 3883})" : R"({"cells": 48000})");
  link.close();
}

TEST(Handshake, DisagreementIsTheSameErrorEverywhere) {
  Link link(world(), {10, 1, 1}, time_out);
  const auto here = [](const char* fluid, const char* particles) {
    return on_fluid_side() ? fluid : particles;
  };
  const std::vector<HandshakeItem> items = {{"coupling.window", here("2e-4", "1e-4"), 1e-9},
                                            {"gravity", here("0 0 -9.81", "0 -9.81 0"), 1e-9},
                                            {"hash", here("0011", "11"), -1},
                                            {"version", here("1", "1.0"), 1e-9}};
  try {
    link.handshake(items, "{}");
    FAIL() << "the handshake should have failed";
  } catch (const InputError& error) {
    const std::string text = error.what();
    for (const char* line : {"coupling.window: foam_side has '2e-4', dem_side has '1e-4'",
                             "gravity: foam_side has '0 0 -9.81', dem_side has '0 -9.81 0'",
                             "hash: foam_side has '0011', dem_side has '11'"})
      EXPECT_NE(text.find(line), std::string::npos) << text;
    EXPECT_EQ(text.find("version"), std::string::npos) << text;
  }
  link.close();
}

TEST(Handshake, NumbersOfBulkCellsMustAgree) {
  Link link(world(), {20, 20, on_fluid_side() ? 15 : 120}, time_out);
  EXPECT_THROW(link.handshake({}, "{}"), InputError);
  link.close();
}

TEST(Waiting, WaitingCostsNoCore) {
  Link link(world(), {10, 6, 10}, time_out);
  test::meet();
  constexpr double pause = 2;
  if (!on_fluid_side()) {
    usleep(static_cast<useconds_t>(1e6 * pause));
    link.send(part({}, link.mine(), world().rank(), 0));
  } else {
    const double cpu = cpu_seconds(), begin = now();
    link.receive<BulkParticles>();
    EXPECT_GT(now() - begin, 0.8 * pause);
    EXPECT_LT((cpu_seconds() - cpu) / (now() - begin), 0.1);  // 2 % on an idle machine, 5 % on a crowded one
    EXPECT_GT(link.statistics().waiting_seconds, 0.8 * pause);
    EXPECT_LT(link.statistics().exchange_seconds, 0.1 * pause);
    RecordProperty("cpu_share_percent", static_cast<int>(100 * (cpu_seconds() - cpu) / (now() - begin)));
  }
  link.close();
}

TEST(Waiting, TimeOutSaysWhoWaitsForWhat) {
  Link link(world(), {10, 6, 10}, on_fluid_side() ? 0.3 : time_out);
  link.agree_to_continue(Continue::run);  // before the end of the first window signs of life count, too
  if (on_fluid_side()) {
    try {
      link.receive<BulkParticles>();
      FAIL() << "nothing was sent";
    } catch (const PartnerLost& error) {
      const std::string text = error.what();
      for (const char* words :
           {"foam_side rank ", "waited 0.3 s", "bulk cells from dem_side rank ", "time_out"})
        EXPECT_NE(text.find(words), std::string::npos) << text;
    }
  }
  link.close();
}

TEST(Waiting, AFailingRankIsHeardByTheOthers) {
  Link link(world(), {10, 6, 10}, time_out);
  test::meet();
  const bool fails = !on_fluid_side() && world().rank() == world().size() - 1;
  if (fails) {
    link.signal_failure("the beads have left the box");
  } else if (on_fluid_side()) {
    try {
      link.receive<BulkParticles>();
      FAIL() << "nothing was sent";
    } catch (const PartnerLost& error) {
      const std::string text = error.what();
      EXPECT_NE(text.find("the beads have left the box"), std::string::npos) << text;
      EXPECT_NE(text.find("dem_side rank " + std::to_string(world().partner_size() - 1)), std::string::npos)
          << text;
    }
  } else {
    EXPECT_THROW(link.receive<BulkParticles>(), RunError);
  }
  test::meet();
}

// Not a check of a bound that other processes on the machine could break, but a number to look at.
TEST(Link, LatencyOfAWindow) {
  constexpr int windows = 300;
  Link link(world(), {10, 6, 10}, time_out);
  const auto owned = part(random_cells(600, 1.0, 1), link.mine(), world().rank(), 0);
  test::meet();
  const double begin = now();
  for (int window = 0; window < windows; ++window) {
    if (on_fluid_side()) {
      link.send(owned);
      link.receive<BulkParticles>();
    } else {
      link.receive<BulkParticles>();
      link.send(owned);
    }
    link.swap_text(R"({"worst_courant": 0.3, "time": 0.1})");
    link.agree_to_continue(Continue::run);
  }
  const double seconds = (now() - begin) / windows;
  if (on_fluid_side() && world().rank() == 0)
    std::printf(
        "one window (600 cells each way, reports, agreement): %.0f us, of it packing and moving %.0f us\n",
        1e6 * seconds, 1e6 * link.statistics().exchange_seconds / windows);
  EXPECT_LT(seconds, 0.1);
  link.close();
}

}  // namespace
}  // namespace demvof

int main(int argc, char** argv) {
  return demvof::test::run_both_sides(argc, argv);
}
