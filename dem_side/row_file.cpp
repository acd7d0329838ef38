// SPDX-License-Identifier: GPL-3.0-or-later
// What demvof keeps of each particle, for the run that goes on: by its number, in pieces that need no room.
// In LIGGGHTS's own restart file it would go through one buffer for all particles. The first line names the
// columns: the run that goes on may have other forces, and with them other ones.

#include <algorithm>
#include <fstream>
#include <sstream>
#include <unordered_map>

#include "atom.h"
#include "coupler/base/errors.hpp"
#include "coupler/base/mpi_check.hpp"
#include "dem_side/dem.hpp"
#include "lammps.h"

namespace demvof {
namespace {

constexpr int in_a_piece = 4096;      // particles
constexpr const char* number = "id";  // the first column

template <class Columns>
int width_of(const Columns& columns) {
  int width = 1;  // its number
  for (const auto& column : columns) width += column.width;
  return width;
}

template <class Columns>
std::string first_line(const Columns& columns) {
  std::ostringstream line;
  line << number;
  for (const auto& column : columns) line << ' ' << column.name << ' ' << column.width;
  return line.str();
}

/// Those of a file, each with its place in this run; nowhere: this run has no such column. One that the file
/// has not stays as it is for a new particle.
template <class Columns>
Columns columns_of(const std::string& line, const Columns& here) {
  Columns all;
  std::istringstream words(line);
  std::string first;
  if (!(words >> first) || first != number) return {};
  for (typename Columns::value_type one{}; words >> one.name >> one.width; all.push_back(one)) {
    one.of = nullptr;
    for (const auto& own : here)
      if (own.name == one.name && own.width == one.width) one.of = own.of;
  }
  return all;
}

/// Of rank 0, for all.
std::string tell_all(std::string text, MPI_Comm comm) {
  int length = static_cast<int>(text.size());
  check_mpi(MPI_Bcast(&length, 1, MPI_INT, 0, comm), "MPI_Bcast");
  text.resize(static_cast<std::size_t>(length));
  check_mpi(MPI_Bcast(text.data(), length, MPI_CHAR, 0, comm), "MPI_Bcast");
  return text;
}

}  // namespace

std::vector<Dem::Columns> Dem::columns() const {
  std::vector<Columns> all = {{"force", 3, liggghts_->atom->f}, {"torque", 3, liggghts_->atom->torque}};
  for (const auto& [name, width] : kept_rows_) all.push_back({name, width, particle_rows(name)});
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
  if (rank == 0) to << first_line(kept) << '\n';
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
  std::ifstream from;
  if (rank == 0) from.open(rows_file(restart_file_), std::ios::binary);
  std::string line;
  std::getline(from, line);
  const std::vector<Columns> kept = columns_of(tell_all(line, world_), columns());
  if (kept.empty())
    throw InputError("--continue: " + rows_file(restart_file_).string() +
                     " does not begin with the names of what it holds: it is not there, or of an earlier "
                     "version of demvof; go on with that version, or start a new run");
  const int width = width_of(kept);
  std::unordered_map<int, int> place;
  for (int i = 0; i < atom.nlocal; ++i) place.emplace(atom.tag[i], i);
  std::vector<double> piece(static_cast<std::size_t>(in_a_piece * width));
  for (int length = 1; length > 0;) {
    if (rank == 0) {
      from.read(reinterpret_cast<char*>(piece.data()), static_cast<long>(piece.size() * sizeof(double)));
      length = static_cast<int>(from.gcount() / static_cast<long>(sizeof(double)));
    }
    check_mpi(MPI_Bcast(&length, 1, MPI_INT, 0, world_), "MPI_Bcast");
    if (length % width != 0)
      throw InputError("--continue: " + rows_file(restart_file_).string() + " ends within a particle");
    check_mpi(MPI_Bcast(piece.data(), length, MPI_DOUBLE, 0, world_), "MPI_Bcast");
    for (const double* row = piece.data(); row != piece.data() + length; row += width) {
      const auto found = place.find(static_cast<int>(row[0]));
      if (found == place.end()) continue;
      const double* value = row + 1;
      for (const Columns& column : kept) {
        if (column.of) std::copy_n(value, column.width, column.of[found->second]);
        value += column.width;
      }
      place.erase(found);
    }
  }
  if (!place.empty())
    throw InputError("--continue: " + rows_file(restart_file_).string() + " does not know all particles of " +
                     restart_file_.string());
}

}  // namespace demvof
