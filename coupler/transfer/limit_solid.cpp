// SPDX-License-Identifier: GPL-3.0-or-later
#include "coupler/transfer/limit_solid.hpp"

#include <cmath>
#include <utility>

#include "coupler/base/mpi_check.hpp"

namespace demvof {
namespace {

// Cells this close to the limit (relative to it) are at the limit.
constexpr double tolerance = 1e-12;
// Excess in the middle of a full region of n cells across takes some n^2 rounds to get out.
constexpr int most_rounds = 10000;

/// What a cell above the limit gives to each face neighbour.
struct Offer {
  double share = 0;        // of its volume, -
  double to_everyone = 0;  // 1: no neighbour is below the limit, all receive
};

// Rounds after which it is looked again who can still get rid of something.
constexpr std::size_t rounds_between_looks = 50;

/// Over all ranks. Plain row of doubles.
struct Excess {
  double cells = 0;   // above the limit
  double volume = 0;  // that is too much in them, m3
  double total = 0;   // solid volume of all cells, m3
  double room = 0;    // most that they can hold, m3
};
Excess total_excess(MPI_Comm world, const std::vector<double>& volume, const std::vector<double>& limit) {
  Excess excess;
  for (std::size_t c = 0; c < volume.size(); ++c) {
    excess.total += volume[c];
    excess.room += limit[c];
    if (volume[c] <= limit[c] * (1 + tolerance)) continue;
    excess.cells += 1;
    excess.volume += volume[c] - limit[c];
  }
  check_mpi(MPI_Allreduce(MPI_IN_PLACE, &excess.cells, row_width<Excess>(), MPI_DOUBLE, MPI_SUM, world),
            "MPI_Allreduce");
  return excess;
}

bool in_any_rank(MPI_Comm world, bool here) {
  int any = here;
  check_mpi(MPI_Allreduce(MPI_IN_PLACE, &any, 1, MPI_INT, MPI_MAX, world), "MPI_Allreduce");
  return any > 0;
}

/// Cells from which there is a way to one with room, through cells that have this fluid (limit > 0): all
/// others would give for ever.
std::vector<char> can_give(MPI_Comm world, const CellNeighbourhood& around, const std::vector<double>& limit,
                           const std::vector<double>& volume) {
  std::vector<double> leads(volume.size());  // 1: to room, or has it
  for (std::size_t c = 0; c < volume.size(); ++c) leads[c] = volume[c] < limit[c] * (1 - tolerance);
  std::vector<char> gives;
  for (bool more = true; more;) {
    const std::vector<double> beside = around.share(leads);
    gives.assign(volume.size(), 0);
    more = false;
    for (std::size_t c = 0; c < volume.size(); ++c) {
      for (const int slot : around.beside()[c])
        if (slot >= 0 && beside[slot] > 0) gives[c] = 1;
      if (!gives[c] || leads[c] > 0 || limit[c] == 0) continue;
      leads[c] = 1;
      more = true;
    }
    more = in_any_rank(world, more);
  }
  return gives;
}

/// Every cell above the limit gives, and every cell counts what its neighbours give to it in the order of its
/// faces, wherever they are stored: hence the same sums on any number of ranks.
Relocation::Round next_round(const CellNeighbourhood& around, const std::vector<double>& limit,
                             const std::vector<double>& volume, const std::vector<char>& gives) {
  struct Place {
    double room = 0;  // m3; 0 at the limit
    double open = 0;  // 1: has this fluid
  };
  std::vector<Place> places(volume.size());
  for (std::size_t c = 0; c < volume.size(); ++c) {
    places[c].open = limit[c] > 0;
    if (std::abs(limit[c] - volume[c]) > limit[c] * tolerance) places[c].room = limit[c] - volume[c];
  }
  const std::vector<Place> beside_place = around.share(places);
  Relocation::Round round;
  std::vector<Offer> offers(volume.size());
  for (std::size_t c = 0; c < volume.size(); ++c) {
    if (places[c].room >= 0 || !gives[c]) continue;
    unsigned with_room = 0, all = 0;
    for (int face = 0; face < 6; ++face)
      if (const int slot = around.beside()[c][face]; slot >= 0 && beside_place[slot].open > 0) {
        all |= 1u << face;
        with_room |= unsigned{beside_place[slot].room > 0} << face;
      }
    const unsigned receivers = with_room ? with_room : all;
    offers[c] = {-places[c].room / volume[c] / __builtin_popcount(receivers), with_room ? 0.0 : 1.0};
    round.gifts.push_back({static_cast<int>(c), offers[c].share, receivers});
  }
  const std::vector<Offer> beside = around.share(offers);
  for (std::size_t c = 0; c < volume.size(); ++c)
    for (const int slot : around.beside()[c])
      if (slot >= 0 && places[c].open > 0 && beside[slot].share > 0 &&
          (places[c].room > 0 || beside[slot].to_everyone > 0))
        round.receipts.push_back({static_cast<int>(c), slot, beside[slot].share});
  return round;
}

std::vector<double> volumes(const CellNeighbourhood& around, const CellValues<BulkParticles>& owned) {
  std::vector<double> volume(around.cells().size());
  for (std::size_t i = 0; i < owned.cells.size(); ++i)
    volume[around.place(owned.cells[i])] = owned.values[i].solid_volume;
  return volume;
}

}  // namespace

LimitedSolid limit_solid(MPI_Comm world, const BulkGrid& grid, const BulkPartition& partition,
                         double maximum_solid_fraction, const CellValues<double>& open_share,
                         const CellValues<BulkParticles>& owned, const CellValues<BulkWalls>& walls) {
  const double whole = maximum_solid_fraction * grid.cell_volume();
  std::vector<double> given, limit(owned.cells.size(), whole);
  for (const BulkParticles& cell : owned.values) given.push_back(cell.solid_volume);
  for (std::size_t i = 0, next = 0; i < open_share.cells.size(); ++i) {
    while (next < owned.cells.size() && owned.cells[next] < open_share.cells[i]) ++next;
    if (next < owned.cells.size() && owned.cells[next] == open_share.cells[i])
      limit[next] *= open_share.values[i];
  }
  Excess excess = total_excess(world, given, limit);
  SolidRelief relief{static_cast<CellId>(excess.cells), excess.volume, 0};
  if (relief.cells == 0) return {relief, {}};

  const auto around = std::make_shared<const CellNeighbourhood>(world, grid, partition, walls);
  std::vector<double> volume = volumes(*around, owned);
  limit.assign(volume.size(), whole);
  for (std::size_t i = 0; i < open_share.cells.size(); ++i)
    limit[around->place(open_share.cells[i])] *= open_share.values[i];
  excess = total_excess(world, volume, limit);
  if (excess.total > excess.room) return {{relief.cells, 0, excess.volume}, {}};

  std::vector<Relocation::Round> rounds;
  for (std::vector<char> gives; rounds.size() < most_rounds;) {
    if (rounds.size() % rounds_between_looks == 0) gives = can_give(world, *around, limit, volume);
    Relocation::Round round = next_round(*around, limit, volume, gives);
    if (!in_any_rank(world, !round.gifts.empty())) break;
    rounds.push_back(std::move(round));
    const CellValues<double> now =
        Relocation(around, {rounds.back()}).spread(CellValues<double>{around->cells(), std::move(volume)});
    volume = now.values;
  }
  excess = total_excess(world, volume, limit);
  relief.not_placed = excess.volume;
  relief.volume -= excess.volume;
  return {relief, Relocation(around, std::move(rounds))};
}

}  // namespace demvof
