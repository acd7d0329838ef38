// SPDX-License-Identifier: GPL-3.0-or-later
#include "coupler/transfer/diffusion.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "coupler/base/mpi_check.hpp"

namespace demvof {

namespace {

// Of a cell's share, what comes to it from the open cells around: below this there is none of the fluid.
constexpr double nothing = 1e-200;

}  // namespace

RowDiffusion::RowDiffusion(int cells, double strength, bool periodic) : cells_(cells), periodic_(periodic) {
  const double s = 0.5 / strength, q = s + std::sqrt(s * (s + 2));
  lambda_ = 1 / (1 + q);
  one_minus_lambda_ = q / (1 + q);
  const double log_row = -cells * std::log1p(q);
  lambda_row_ = std::exp(log_row);
  beyond_ = -1 / std::expm1(periodic ? log_row : 2 * log_row);
}

void RowDiffusion::step(double* row, int width) const {
  const auto cell = [row, width](int i) { return row + std::size_t(i) * width; };
  // The sum that comes in from beyond the lower end: of the row itself again and again, or of its mirror
  // images, the nearest of which begins with its first cell.
  std::vector<double> sum(width, 0.0), mirrored(width, 0.0);
  for (int i = 0; i < cells_; ++i)
    for (int m = 0; m < width; ++m) sum[m] = cell(i)[m] + lambda_ * sum[m];
  if (!periodic_) {
    for (int i = cells_; i-- > 0;)
      for (int m = 0; m < width; ++m) mirrored[m] = cell(i)[m] + lambda_ * mirrored[m];
    for (int m = 0; m < width; ++m) sum[m] = mirrored[m] + lambda_row_ * sum[m];
  }
  for (double& value : sum) value *= beyond_;
  for (int i = 0; i < cells_; ++i)
    for (int m = 0; m < width; ++m) sum[m] = cell(i)[m] += lambda_ * sum[m];

  // Back again. At a wall the cell beyond the last one is its image.
  if (periodic_) {
    std::fill(sum.begin(), sum.end(), 0.0);
    for (int i = cells_; i-- > 0;)
      for (int m = 0; m < width; ++m) sum[m] = cell(i)[m] + lambda_ * sum[m];
    for (double& value : sum) value *= beyond_;
  } else {
    for (double& value : sum) value /= one_minus_lambda_;
  }
  const double scale = one_minus_lambda_ * one_minus_lambda_;
  for (int i = cells_; i-- > 0;)
    for (int m = 0; m < width; ++m) {
      sum[m] = cell(i)[m] + lambda_ * sum[m];
      cell(i)[m] = scale * sum[m];
    }
}

Diffusion::Diffusion(MPI_Comm world, const BulkGrid& grid, const BulkPartition& partition, double bandwidth)
    : world_(world), partition_(partition) {
  int rank;
  check_mpi(MPI_Comm_rank(world, &rank), "MPI_Comm_rank");
  const CellRange own = partition.block(rank);
  for (int axis = 0; axis < 3; ++axis) {
    const int n = grid.cells()[axis];
    if (n == 1) continue;  // nowhere to go
    const double strength =
        0.25 * std::pow(bandwidth / grid.spacing()[axis], 2) / diffusion_steps;  // tau / (n h^2)
    // Owners of the blocks in a row share the lines through it.
    const CellId share = partition.place_among_blocks(rank)[axis], of = partition.blocks()[axis];
    const int along[2] = {axis == 0 ? 1 : 0, axis == 2 ? 1 : 2};
    const CellId across = own.end[along[0]] - own.begin[along[0]],
                 lines = across * (own.end[along[1]] - own.begin[along[1]]);
    std::vector<CellId> cells;
    for (CellId line = lines * share / of; line < lines * (share + 1) / of; ++line) {
      std::array<int, 3> ijk{};
      ijk[along[0]] = own.begin[along[0]] + static_cast<int>(line % across);
      ijk[along[1]] = own.begin[along[1]] + static_cast<int>(line / across);
      for (ijk[axis] = 0; ijk[axis] < n; ++ijk[axis]) cells.push_back(grid.id(ijk));
    }
    std::vector<CellId> sorted = cells;
    std::sort(sorted.begin(), sorted.end());
    std::vector<int> place;
    place.reserve(cells.size());
    for (const CellId cell : cells)
      place.push_back(
          static_cast<int>(std::lower_bound(sorted.begin(), sorted.end(), cell) - sorted.begin()));
    axes_.push_back({RowDiffusion(n, strength, grid.periodic()[axis]),
                     std::move(place),
                     n,
                     grid.periodic()[axis],
                     strength,
                     axis,
                     {},
                     std::make_unique<TouchedCells>(world, partition, std::move(sorted))});
  }
}

void Diffusion::set_walls(const CellValues<BulkWalls>& walls) {
  int any = walls.cells.empty() ? 0 : 1;
  check_mpi(MPI_Allreduce(MPI_IN_PLACE, &any, 1, MPI_INT, MPI_MAX, world_), "MPI_Allreduce");
  walls_ = any > 0;
  for (Axis& axis : axes_) axis.wall.clear();
  if (!walls_) return;
  for (Axis& axis : axes_) {
    const std::vector<BulkWalls> here = axis.touched->fetch_from_owners(walls, BulkWalls{});
    for (const int place : axis.place) axis.wall.push_back(here[place].towards_lower(axis.along));
  }
}

void Diffusion::set_open_shares(const CellValues<double>& share) {
  int rank;
  check_mpi(MPI_Comm_rank(world_, &rank), "MPI_Comm_rank");
  CellValues<double> open{partition_.cells(rank), {}};
  open.values.assign(open.cells.size(), 1.0);
  for (std::size_t i = 0; i < share.cells.size(); ++i)
    open.values[partition_.place(share.cells[i])] = share.values[i];
  // As gather goes: the sum of what comes of a deposit.
  per_reached_ = diffused(open, walls_).values;
  for (double& value : per_reached_) value = value > nothing ? 1 / value : 0;
  open_ = std::move(open.values);
}

/// wall: below each cell of the row; nullptr: none anywhere.
void Diffusion::diffuse_row(const Axis& axis, const char* wall, std::vector<double>& row, int width) {
  const int n = axis.cells;
  const bool walled =
      wall && std::any_of(wall + (axis.periodic ? 0 : 1), wall + n, [](char w) { return w != 0; });
  if (!walled) {
    for (int step = 0; step < diffusion_steps; ++step) axis.row.step(row.data(), width);
    return;
  }
  // A periodic row begins at one of its walls.
  const int begin = axis.periodic
                        ? static_cast<int>(std::find_if(wall, wall + n, [](char w) { return w != 0; }) - wall)
                        : 0;
  std::rotate(row.begin(), row.begin() + std::ptrdiff_t(begin) * width, row.end());
  for (int first = 0; first < n;) {
    int last = first + 1;
    while (last < n && !wall[(begin + last) % n]) ++last;
    if (last - first > 1) {
      const RowDiffusion part(last - first, axis.strength, false);
      for (int step = 0; step < diffusion_steps; ++step) part.step(&row[std::size_t(first) * width], width);
    }
    first = last;
  }
  std::rotate(row.begin(), row.end() - std::ptrdiff_t(begin) * width, row.end());
}

void Diffusion::diffuse(const Axis& axis, double* values, int width) {
  std::vector<double> row(std::size_t(axis.cells) * width);
  for (std::size_t line = 0; line < axis.place.size(); line += axis.cells) {
    const int* place = &axis.place[line];
    bool empty = true;
    for (int i = 0; i < axis.cells; ++i) {
      const double* from = values + std::size_t(place[i]) * width;
      empty = empty && std::all_of(from, from + width, [](double value) { return value == 0; });
      std::copy_n(from, width, &row[std::size_t(i) * width]);
    }
    if (empty) continue;
    diffuse_row(axis, axis.wall.empty() ? nullptr : &axis.wall[line], row, width);
    for (int i = 0; i < axis.cells; ++i)
      std::copy_n(&row[std::size_t(i) * width], width, values + std::size_t(place[i]) * width);
  }
}

}  // namespace demvof
