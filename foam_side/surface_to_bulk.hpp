// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "coupler/grid/bulk_cells.hpp"
#include "coupler/transfer/bulk_surface.hpp"
#include "foam_side/bulk_cut.hpp"
#include "foam_side/flow.hpp"

namespace demvof {

/// Which part of a bulk cell is liquid (fluid 0) and which gas (1), and the surface between them
/// (coupler/transfer/bulk_surface.hpp). With one fluid everything is fluid 0. All calls but share are
/// collective over the fluid side.
class SurfaceToBulk {
 public:
  /// Refers to both.
  SurfaceToBulk(const Flow& flow, const BulkCut& cut);

  int fluids() const { return flow_.scene.two_fluids ? 2 : 1; }

  /// Takes the fine mesh's alpha as it is now.
  void look();

  /// Share of a subcell's volume that counts as fluid k, -: alpha or 1 - alpha where the surface cuts the
  /// bulk cell, else all or nothing.
  double share(int k, const Subcell& subcell) const;
  bool is_cut(int slot) const {
    return fluids() > 1 && liquid_[slot] > least_seen_share && liquid_[slot] < 1 - least_seen_share;
  }
  /// Sum over the subcells of each touched bulk cell of share times volume, over all ranks, m3.
  std::vector<double> volumes(int k) const;

  /// The surface in the cells owned by this rank: where it is now, and where it was at the last call and is
  /// no more. The first time all cells that hold liquid.
  CellValues<BulkSurface> news();

  /// What the particles know after that: all cells that hold liquid, owned by this rank. For a run that goes
  /// on, which begins with it.
  const CellValues<BulkSurface>& seen() const { return seen_; }
  void go_on_from(CellValues<BulkSurface> seen);

 private:
  const Flow& flow_;
  const BulkCut& cut_;
  std::vector<double> liquid_;    // of the fluid in each touched bulk cell, -
  CellValues<BulkSurface> seen_;  // cells owned by this rank that held liquid at the last call
  bool first_ = true;
};

}  // namespace demvof
