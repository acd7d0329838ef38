// SPDX-License-Identifier: GPL-3.0-or-later
#include "foam_side/bulk_cut.hpp"

#include <algorithm>
#include <iterator>

#include "coupler/base/mpi_check.hpp"
#include "foam_side/fine_mesh.hpp"

namespace demvof {

namespace {

// A bulk cell is full of fluid mesh up to what the corners of a mesh, as written in its file, leave open.
constexpr double full = 1 - 1e-6;

}  // namespace

BulkCut::BulkCut(const Foam::fvMesh& mesh, const MappingParameters& mapping, const BulkGrid& grid,
                 const BulkPartition& partition, MPI_Comm world)
    : mesh_(mesh), mapping_(mapping), grid_(grid), partition_(partition), world_(world) {
  renew();
}

void BulkCut::renew() {
  remap_ = std::make_unique<Remap>(world_, grid_, partition_, fine_mesh(mesh_), mapping_);
  has_profiles_ = mapping_.to_bulk == Mapping::conservative &&
                  Foam::returnReduce(remap_->straddles(), Foam::orOp<bool>());
  find_active_subcells();
}

void BulkCut::activate(const std::vector<CellId>& cells) {
  active_ = cells;
  find_active_subcells();
}

void BulkCut::find_active_subcells() {
  const CellValues<double> marks{active_, std::vector<double>(active_.size(), 1.0)};
  const std::vector<double> active = cells().fetch_from_owners(marks, 0.0);
  subcells_.clear();
  std::copy_if(remap_->subcells().begin(), remap_->subcells().end(), std::back_inserter(subcells_),
               [&](const Subcell& subcell) { return active[subcell.slot] > 0; });
}

CellValues<double> BulkCut::open_shares() const {
  const Remap cut(world_, grid_, partition_, fine_mesh(mesh_), {Mapping::nearest, Mapping::conservative});
  std::vector<double> here(cut.cells().cells().size(), 0.0);
  for (const Subcell& subcell : cut.subcells()) here[subcell.slot] += subcell.volume;
  const CellValues<double> met = cut.cells().sum_to_owners(here);
  CellValues<double> open;
  int rank;
  check_mpi(MPI_Comm_rank(world_, &rank), "MPI_Comm_rank");
  std::size_t next = 0;
  for (CellId cell = partition_.begin(rank); cell < partition_.end(rank); ++cell) {
    const bool known = next < met.cells.size() && met.cells[next] == cell;
    const double share = known ? met.values[next++] / grid_.cell_volume() : 0.0;
    if (share >= full) continue;
    open.cells.push_back(cell);
    open.values.push_back(share);
  }
  return open;
}

}  // namespace demvof
