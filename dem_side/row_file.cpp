// SPDX-License-Identifier: GPL-3.0-or-later
// What demvof keeps of each particle, for the run that goes on: by its number, in pieces that need no room.
// In LIGGGHTS's own restart file it would go through one buffer for all particles.

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <unordered_map>

#include "atom.h"
#include "coupler/base/errors.hpp"
#include "coupler/base/mpi_check.hpp"
#include "dem_side/dem.hpp"
#include "lammps.h"

namespace demvof {
namespace {

constexpr int in_a_piece = 4096;  // particles

template <class Columns>
int width_of(const Columns& columns) {
  int width = 1;  // its number
  for (const auto& column : columns) width += column.width;
  return width;
}

/// Throws InputError where the file is not that of so many particles with so many numbers each.
void require_size(const std::filesystem::path& file, double particles, int width) {
  std::error_code absent;
  const auto size = std::filesystem::file_size(file, absent);
  if (absent)
    throw InputError(fmt::format(
        "--continue: there is no {}: the state was written by a version of demvof that kept this elsewhere; "
        "go on with that version, or start a new run",
        file.string()));
  if (static_cast<double>(size) != particles * width * sizeof(double))
    throw InputError(fmt::format(
        "--continue: {} has {} bytes, and {:.0f} particles with {} numbers each make {:.0f}: it was written "
        "by another version of demvof, or with other forces; go on with these, or start a new run",
        file.string(), size, particles, width, particles * width * sizeof(double)));
}

}  // namespace

std::vector<Dem::Columns> Dem::columns() const {
  std::vector<Columns> all = {{liggghts_->atom->f, 3}, {liggghts_->atom->torque, 3}};
  for (const auto& [name, width] : kept_rows_) all.push_back({particle_rows(name), width});
  return all;
}

void Dem::write_rows(const std::filesystem::path& file) const {
  const LAMMPS_NS::Atom& atom = *liggghts_->atom;
  int rank, ranks;
  check_mpi(MPI_Comm_rank(world_, &rank), "MPI_Comm_rank");
  check_mpi(MPI_Comm_size(world_, &ranks), "MPI_Comm_size");
  std::ofstream to;
  if (rank == 0) to.open(file, std::ios::binary);
  const std::vector<Columns> kept = columns();
  for (int from = 0; from < ranks; ++from) {
    int count = atom.nlocal;
    check_mpi(MPI_Bcast(&count, 1, MPI_INT, from, world_), "MPI_Bcast");
    for (int first = 0; first < count; first += in_a_piece) {
      const int last = std::min(first + in_a_piece, count);
      std::vector<double> piece;
      for (int i = first; i < last && rank == from; ++i) {
        piece.push_back(atom.tag[i]);
        for (const Columns& column : kept)
          piece.insert(piece.end(), column.of[i], column.of[i] + column.width);
      }
      piece.resize(static_cast<std::size_t>((last - first) * width_of(kept)));
      const int length = static_cast<int>(piece.size());
      if (from != 0 && rank == from)
        check_mpi(MPI_Send(piece.data(), length, MPI_DOUBLE, 0, 0, world_), "MPI_Send");
      if (from != 0 && rank == 0)
        check_mpi(MPI_Recv(piece.data(), length, MPI_DOUBLE, from, 0, world_, MPI_STATUS_IGNORE), "MPI_Recv");
      if (rank == 0)
        to.write(reinterpret_cast<const char*>(piece.data()), length * static_cast<long>(sizeof(double)));
    }
  }
}

void Dem::read_rows() {
  const LAMMPS_NS::Atom& atom = *liggghts_->atom;
  int rank;
  check_mpi(MPI_Comm_rank(world_, &rank), "MPI_Comm_rank");
  const std::filesystem::path file = rows_file(restart_file_);
  const std::vector<Columns> kept = columns();
  const int width = width_of(kept);
  std::ifstream from;
  if (rank == 0) {
    require_size(file, static_cast<double>(atom.natoms), width);
    from.open(file, std::ios::binary);
  }
  std::unordered_map<int, int> place;
  for (int i = 0; i < atom.nlocal; ++i) place.emplace(atom.tag[i], i);
  std::vector<double> piece(static_cast<std::size_t>(in_a_piece * width));
  for (int length = 1; length > 0;) {
    if (rank == 0) {
      from.read(reinterpret_cast<char*>(piece.data()), static_cast<long>(piece.size() * sizeof(double)));
      length = static_cast<int>(from.gcount() / static_cast<long>(sizeof(double)));
    }
    check_mpi(MPI_Bcast(&length, 1, MPI_INT, 0, world_), "MPI_Bcast");
    check_mpi(MPI_Bcast(piece.data(), length, MPI_DOUBLE, 0, world_), "MPI_Bcast");
    for (const double* row = piece.data(); row != piece.data() + length; row += width) {
      const auto found = place.find(static_cast<int>(row[0]));
      if (found == place.end()) continue;
      const double* value = row + 1;
      for (const Columns& column : kept) {
        std::copy_n(value, column.width, column.of[found->second]);
        value += column.width;
      }
      place.erase(found);
    }
  }
  if (!place.empty())
    throw InputError("--continue: " + file.string() + " does not know all particles of " +
                     restart_file_.string());
}

}  // namespace demvof
