// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Meshes on a bulk grid in all relations that occur, and one of them spread over the ranks of a communicator.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <random>
#include <string>

#include "coupler/transfer/remap.hpp"
#include "tests/support/meshes.hpp"

namespace demvof::test {

using Cells = std::vector<Polyhedron>;
using Field = std::function<double(const Vec3&)>;

inline const Vec3 zero{0, 0, 0}, one{1, 1, 1};

struct Case {
  std::string name;
  BulkGrid grid;
  Cells cells;
  bool nested = false;  // every fine cell lies in one bulk cell
  std::function<bool(const Vec3&)> contains = [](const Vec3& x) {
    return x.x > -1e-9 && x.x < 1 + 1e-9 && x.y > -1e-9 && x.y < 1 + 1e-9 && x.z > -1e-9 && x.z < 1 + 1e-9;
  };
};

/// Meshes of the unit box, or of a turned box in it, on n bulk cells per edge.
inline Case nested(int n) {
  Case c{"nested", BulkGrid(zero, one, {n, n, n}), hexahedra(zero, one, {2 * n, 3 * n, 2 * n})};
  c.nested = true;
  return c;
}
inline Case unaligned(int n) {
  return {"unaligned", BulkGrid(zero, one, {n, n, n}),
          hexahedra(zero, one, {n + n / 2, 2 * n - n / 5, 2 * n + n / 10})};
}
inline Case turned(int n) {  // cells are somewhat smaller than bulk cells
  const Vec3 middle{0.5, 0.5, 0.5}, axis{1, 2, 3};
  Case c{"turned", BulkGrid(zero, one, {n, n, n}),
         hexahedra({0.14, 0.14, 0.14}, {0.86, 0.86, 0.86}, {n, n + n / 5, n}, rotation(middle, axis, 0.25))};
  c.contains = [back = rotation(middle, axis, -0.25), middle](const Vec3& x) {
    const Vec3 y = back(x) - middle;
    return std::max({std::abs(y.x), std::abs(y.y), std::abs(y.z)}) < 0.36;
  };
  return c;
}
inline Case wobbly(int n) {  // faces that are not plane
  return {"wobbly", BulkGrid(zero, one, {n, n, n}),
          hexahedra(zero, one, {2 * n, 2 * n - 1, 2 * n}, wobble(0.3 / n))};
}
inline std::vector<Case> all_cases(int n) {
  return {nested(n), unaligned(n), turned(n), wobbly(n)};
}

/// A case on the ranks of a communicator, cells dealt out without any pattern.
struct Spread {
  MPI_Comm comm;
  BulkGrid grid;
  BulkPartition partition;
  std::vector<int> mine;  // numbers of this rank's cells
  FineMesh mesh;
  Remap remap;

  static int size(MPI_Comm comm) {
    int ranks;
    MPI_Comm_size(comm, &ranks);
    return ranks;
  }
  static std::vector<int> deal(MPI_Comm comm, std::size_t cells) {
    int rank;
    MPI_Comm_rank(comm, &rank);
    std::mt19937 random(5);
    std::vector<int> mine;
    for (std::size_t cell = 0; cell < cells; ++cell)
      if (static_cast<int>(random() % size(comm)) == rank) mine.push_back(static_cast<int>(cell));
    return mine;
  }
  static FineMesh part(const Cells& cells, const std::vector<int>& mine) {
    Cells own;
    for (const int cell : mine) own.push_back(cells[cell]);
    return fine_mesh(own);
  }
  Spread(MPI_Comm world, const Case& c, const MappingParameters& mapping = {})
      : comm(world),
        grid(c.grid),
        partition(grid.cells(), size(world)),
        mine(deal(world, c.cells.size())),
        mesh(part(c.cells, mine)),
        remap(world, grid, partition, mesh, mapping) {}

  double sum(double value) const {
    MPI_Allreduce(MPI_IN_PLACE, &value, 1, MPI_DOUBLE, MPI_SUM, comm);
    return value;
  }
  double max(double value) const {
    MPI_Allreduce(MPI_IN_PLACE, &value, 1, MPI_DOUBLE, MPI_MAX, comm);
    return value;
  }
  /// Sums over ranks of what each has per touched cell.
  std::vector<double> summed(const std::vector<double>& partial) const {
    return remap.cells().fetch_from_owners(remap.cells().sum_to_owners(partial), 0.0);
  }
  /// Integral over the fine mesh.
  double integral(const std::vector<double>& fine) const {
    double integral = 0;
    for (std::size_t cell = 0; cell < fine.size(); ++cell) integral += mesh.volume[cell] * fine[cell];
    return sum(integral);
  }
  /// Sum over bulk cells of values per touched cell.
  double total(const std::vector<double>& touched) const {
    const std::vector<CellId>& cells = remap.cells().cells();
    // Each bulk cell counts once however many ranks touch it.
    std::vector<double> count = summed(std::vector<double>(cells.size(), 1.0));
    double total = 0;
    for (std::size_t slot = 0; slot < cells.size(); ++slot) total += touched[slot] / count[slot];
    return sum(total);
  }
  /// Cell totals of a field: its integral over the fluid domain of each bulk cell, exact for linear fields.
  std::vector<double> totals(const Field& field) const {
    std::vector<double> partial(remap.cells().cells().size());
    for (const Subcell& subcell : remap.subcells())
      partial[subcell.slot] += subcell.volume * field(subcell.centroid);
    return summed(partial);
  }
  /// 1 for touched bulk cells whose 26 neighbours exist and lie inside the mesh, as far as corners tell.
  std::vector<char> inner(const std::function<bool(const Vec3&)>& in_mesh) const {
    const std::vector<CellId>& cells = remap.cells().cells();
    std::vector<char> inner(cells.size(), 1);
    for (std::size_t slot = 0; slot < cells.size(); ++slot)
      for (int step = 0; step < 64; ++step) {
        std::array<int, 3> corner = grid.ijk(cells[slot]);
        const int steps[] = {step % 4 - 1, step / 4 % 4 - 1, step / 16 - 1};
        for (int axis = 0; axis < 3; ++axis) corner[axis] += steps[axis];
        inner[slot] &= in_mesh(grid.cell_lower(corner));
      }
    return inner;
  }
  /// Errors against a field of the fine cells near the middle that lie in inner bulk cells alone, and how
  /// many those are.
  struct Error {
    double largest = 0, mean = 0, cells = 0;
  };
  Error inner_error(const std::vector<double>& fine, const Field& field,
                    const std::function<bool(const Vec3&)>& in_mesh) const {
    std::vector<char> counts(fine.size(), 1);
    const std::vector<char> in = inner(in_mesh);
    for (const Subcell& subcell : remap.subcells()) counts[subcell.fine] &= in[subcell.slot];
    Error error;
    double volume = 0;
    for (std::size_t cell = 0; cell < fine.size(); ++cell)
      if (counts[cell] && norm(mesh.centre[cell] - Vec3{0.5, 0.5, 0.5}) < 0.2) {
        const double e = std::abs(fine[cell] - field(mesh.centre[cell]));
        error.largest = std::max(error.largest, e);
        error.mean += e * mesh.volume[cell];
        volume += mesh.volume[cell];
        error.cells += 1;
      }
    return {max(error.largest), sum(error.mean) / sum(volume), sum(error.cells)};
  }
};

}  // namespace demvof::test
