// SPDX-License-Identifier: GPL-3.0-or-later
#include "coupler/transfer/limit_solid.hpp"

#include <algorithm>
#include <array>
#include <numeric>
#include <utility>

#include "coupler/base/mpi_check.hpp"
#include "coupler/grid/touched_cells.hpp"

namespace demvof {
namespace {

// Cells this close above the limit (relative to it) are at the limit.
constexpr double tolerance = 1e-12;
// Excess in the middle of a full region of n cells across takes some n^2 rounds to get out.
constexpr int most_rounds = 10000;

/// What a cell above the limit gives to each face neighbour.
struct Gift {
  double share = 0;        // m3
  double to_everyone = 0;  // 1: no neighbour is below the limit, all receive
};

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
  check_mpi(MPI_Allreduce(MPI_IN_PLACE, &excess.cells, 4, MPI_DOUBLE, MPI_SUM, world), "MPI_Allreduce");
  return excess;
}

/// All cells of one rank, and the cells of other ranks beside them.
class Neighbourhood {
 public:
  Neighbourhood(MPI_Comm world, const BulkGrid& grid, const BulkPartition& partition, int rank,
                const CellValues<BulkWalls>& walls)
      : own_(partition.end(rank) - partition.begin(rank)),
        touched_(world, partition, around(grid, partition, rank)) {
    std::iota(own_.begin(), own_.end(), partition.begin(rank));
    const std::vector<BulkWalls> beside_walls = touched_.fetch_from_owners(walls, BulkWalls{});
    for (const CellId cell : own_) {
      Beside& cell_beside = beside_.emplace_back();
      for (int face = 0; face < 6; ++face) {
        const CellId other = grid.neighbour(grid.ijk(cell), face / 2, face % 2 ? 1 : -1);
        const BulkWalls* own = find(walls, cell);
        const bool upper = face % 2 == 1;
        const bool wall = other >= 0 && (upper ? beside_walls[slot(other)].towards_lower(face / 2)
                                               : own && own->towards_lower(face / 2));
        cell_beside[face] = other < 0 || wall ? -1 : slot(other);
      }
    }
  }
  /// Slots of the face neighbours of each own cell, -1 beyond a wall.
  using Beside = std::array<int, 6>;
  const std::vector<Beside>& beside() const { return beside_; }
  /// Values of own cells to values by slot.
  template <class T>
  std::vector<T> share(std::vector<T> own_values) const {
    return touched_.fetch_from_owners(CellValues<T>{own_, std::move(own_values)}, T{});
  }

 private:
  static std::vector<CellId> around(const BulkGrid& grid, const BulkPartition& partition, int rank) {
    std::vector<CellId> cells;
    for (CellId cell = partition.begin(rank); cell < partition.end(rank); ++cell)
      for (int face = 0; face < 6; ++face) {
        const CellId other = grid.neighbour(grid.ijk(cell), face / 2, face % 2 ? 1 : -1);
        if (other >= 0) cells.push_back(other);
      }
    std::sort(cells.begin(), cells.end());
    cells.erase(std::unique(cells.begin(), cells.end()), cells.end());
    return cells;
  }
  int slot(CellId cell) const {
    const std::vector<CellId>& cells = touched_.cells();
    return static_cast<int>(std::lower_bound(cells.begin(), cells.end(), cell) - cells.begin());
  }
  std::vector<CellId> own_;
  TouchedCells touched_;
  std::vector<Beside> beside_;
};

/// One round: every cell above the limit gives, and every cell adds up what its neighbours give to it in the
/// order of its faces, wherever they are stored: hence the same sums on any number of ranks.
void pass_on(const Neighbourhood& around, const std::vector<double>& limit, std::vector<double>& volume) {
  std::vector<double> room(volume.size());
  for (std::size_t c = 0; c < volume.size(); ++c) room[c] = limit[c] - volume[c];
  const std::vector<double> beside_room = around.share(room);
  std::vector<Gift> gifts(volume.size());
  for (std::size_t c = 0; c < volume.size(); ++c) {
    if (volume[c] <= limit[c] * (1 + tolerance)) continue;
    int with_room = 0, all = 0;
    for (const int slot : around.beside()[c])
      if (slot >= 0) {
        ++all;
        with_room += beside_room[slot] > 0;
      }
    if (all > 0) gifts[c] = {-room[c] / (with_room > 0 ? with_room : all), with_room > 0 ? 0.0 : 1.0};
  }
  const std::vector<Gift> beside_gift = around.share(gifts);
  for (std::size_t c = 0; c < volume.size(); ++c) {
    const bool has_room = room[c] > 0;
    if (gifts[c].share > 0) volume[c] = limit[c];
    for (const int slot : around.beside()[c])
      if (slot >= 0 && (has_room || beside_gift[slot].to_everyone > 0)) volume[c] += beside_gift[slot].share;
  }
}

}  // namespace

SolidRelief limit_solid(MPI_Comm world, const BulkGrid& grid, const BulkPartition& partition,
                        double maximum_solid_fraction, const CellValues<double>& open_share,
                        CellValues<BulkParticles>& owned, const CellValues<BulkWalls>& walls) {
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
  if (relief.cells == 0) return relief;

  int rank;
  check_mpi(MPI_Comm_rank(world, &rank), "MPI_Comm_rank");
  const CellId begin = partition.begin(rank);
  std::vector<double> volume(partition.end(rank) - begin, 0.0);
  limit.assign(volume.size(), whole);
  for (std::size_t i = 0; i < owned.cells.size(); ++i) volume[owned.cells[i] - begin] = given[i];
  for (std::size_t i = 0; i < open_share.cells.size(); ++i)
    limit[open_share.cells[i] - begin] *= open_share.values[i];
  excess = total_excess(world, volume, limit);
  if (excess.total > excess.room) return {relief.cells, 0, excess.volume};

  const Neighbourhood around(world, grid, partition, rank, walls);
  for (int round = 0; excess.cells > 0 && round < most_rounds; ++round) {
    pass_on(around, limit, volume);
    excess = total_excess(world, volume, limit);
  }
  relief.not_placed = excess.volume;
  relief.volume -= excess.volume;

  CellValues<BulkParticles> relieved;
  std::size_t known = 0;
  for (std::size_t c = 0; c < volume.size(); ++c) {
    const bool was_active = known < owned.cells.size() && owned.cells[known] == begin + CellId(c);
    if (!was_active && volume[c] == 0) continue;
    relieved.cells.push_back(begin + CellId(c));
    relieved.values.push_back(was_active ? owned.values[known++] : BulkParticles{});
    relieved.values.back().solid_volume = volume[c];
  }
  owned = std::move(relieved);
  return relief;
}

}  // namespace demvof
