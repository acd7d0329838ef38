// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <vector>

#include "coupler/grid/bulk_cells.hpp"
#include "coupler/transfer/remap.hpp"
#include "foam_side/openfoam.hpp"

namespace demvof {

/// The fine mesh cut along the bulk grid, as it is now, and which of its subcells lie in active bulk cells:
/// those that the particles sent. All calls are collective over the fluid side.
class BulkCut {
 public:
  /// Refers to the mesh.
  BulkCut(const Foam::fvMesh& mesh, const MappingParameters& mapping, const BulkGrid& grid,
          const BulkPartition& partition, MPI_Comm world);

  /// Cuts anew, when the mesh has changed.
  void renew();

  /// cells: active from now on, of those owned by this rank.
  void activate(const std::vector<CellId>& cells);

  const Foam::fvMesh& mesh() const { return mesh_; }
  const BulkGrid& grid() const { return grid_; }
  const BulkPartition& partition() const { return partition_; }
  MPI_Comm world() const { return world_; }
  Mapping to_bulk() const { return mapping_.to_bulk; }
  const Remap& remap() const { return *remap_; }
  /// Bulk cells that this rank's fine cells touch, and the way to their owners.
  const TouchedCells& cells() const { return remap_->cells(); }
  /// In active bulk cells.
  const std::vector<Subcell>& subcells() const { return subcells_; }
  /// Subcells of a fine cell differ: the fine cells have a linear profile.
  bool has_profiles() const { return has_profiles_; }
  /// A bulk cell's particles are told another velocity than the mean of its subcells.
  bool shifts_velocity() const { return has_profiles_ || interpolates(mapping_.to_bulk); }

 private:
  void find_active_subcells();

  const Foam::fvMesh& mesh_;
  MappingParameters mapping_;
  BulkGrid grid_;
  BulkPartition partition_;
  MPI_Comm world_;
  std::unique_ptr<Remap> remap_;
  bool has_profiles_ = false;
  std::vector<CellId> active_;
  std::vector<Subcell> subcells_;
};

}  // namespace demvof
