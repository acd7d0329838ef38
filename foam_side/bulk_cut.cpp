// SPDX-License-Identifier: GPL-3.0-or-later
#include "foam_side/bulk_cut.hpp"

#include <algorithm>
#include <iterator>

#include "foam_side/fine_mesh.hpp"

namespace demvof {

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

}  // namespace demvof
