// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "coupler/grid/bulk_grid.hpp"
#include "coupler/transfer/averaging_parameters.hpp"

namespace demvof {

/// The share w_ic of each particle i in each bulk cell c it reaches. The shares of one particle add
/// up to 1, also at walls, where the weight that would leave the grid goes back to the cells inside.
struct KernelWeights {
  std::vector<CellId> cells;   // touched cells, sorted, without repeats
  std::vector<int> first;      // particle i has entries first[i] .. first[i+1]-1
  std::vector<int> slot;       // entry -> index into cells
  std::vector<double> weight;  // entry -> w_ic
  int particles() const { return static_cast<int>(first.size()) - 1; }
};

/// Weights of the given particles. kernel width as in AveragingParameters; positions beyond a wall count as
/// on the wall. radii: m, one per particle, of which only the volume kernel takes notice. The diffusion
/// kernel's weights are those before diffusion (diffusion.hpp). storage: weights no longer needed, moved in
/// so that their memory is used again.
KernelWeights kernel_weights(const BulkGrid& grid, const AveragingParameters& averaging,
                             const std::vector<Vec3>& positions, const std::vector<double>& radii,
                             KernelWeights storage = {});

/// Makes cells count by their share that is open to the fluid (per touched cell, 0 to 1):
///   w_ic <- w_ic share_c / sum over c of w_ic share_c
/// so that a bed beside a wall across the grid is as dense as inside. A particle that reaches no open cell
/// keeps its weights.
void count_open_shares(const std::vector<double>& share, KernelWeights& weights);

}  // namespace demvof
