// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <mpi.h>

#include <optional>
#include <vector>

#include "coupler/grid/bulk_cells.hpp"
#include "coupler/grid/touched_cells.hpp"
#include "coupler/transfer/averaging_parameters.hpp"
#include "coupler/transfer/diffusion.hpp"
#include "coupler/transfer/fluid_at_particle.hpp"
#include "coupler/transfer/kernel_weights.hpp"
#include "coupler/transfer/limit_solid.hpp"

namespace demvof {

/// Parameters in which the bandwidth is a length: 0 stands for six of the largest diameters at the start, m.
/// Throws InputError when there is no particle yet to take it from.
AveragingParameters with_bandwidth(AveragingParameters parameters, double largest_diameter);

/// Particles to bulk grid at the end of a window, and the bulk fluid back to the particles at the
/// start of the next, with the same weights: no particle moves in between.
class Averaging {
 public:
  /// parameters: with_bandwidth(). Collective.
  Averaging(MPI_Comm world, const BulkGrid& grid, const BulkPartition& partition,
            const AveragingParameters& parameters);

  /// Cells of this rank that the fluid mesh does not fill, with the fluid's share in their volume: particles
  /// count in that share only. Collective.
  void set_open_shares(CellValues<double> open_share);

  /// Sums the particles' contributions into the bulk cells they reach; what is above the largest
  /// solid fraction of a cell moves to its neighbours. Collective.
  /// positions and radii (m), contributions: one per local particle. Returned: this rank's cells.
  const CellValues<BulkParticles>& deposit(const std::vector<Vec3>& positions,
                                           const std::vector<double>& radii,
                                           const std::vector<BulkParticles>& contributions);

  /// Records of the local particles of the last deposit, summed into the bulk cells with its weights; nothing
  /// moves out of full cells. Collective. Returned: this rank's cells.
  template <class T>
  CellValues<T> deposit_records(const std::vector<T>& records) const {
    std::vector<T> touched(weights_.cells.size());
    demvof::deposit(weights_, reinterpret_cast<const double*>(records.data()), row_width<T>(),
                    reinterpret_cast<double*>(touched.data()));
    CellValues<T> owned = touched_->sum_to_owners(touched);
    return diffusion_ ? diffusion_->spread(std::move(owned)) : owned;
  }

  /// The fluid at each local particle of the last deposit. Collective. owned: this rank's cells of
  /// that deposit. Cells without fluid do not count in the mean; a particle that reaches no other
  /// gets density 0. gradients: of the same cells, when a force needs them.
  std::vector<FluidAtParticle> sample(const CellValues<BulkFluid>& owned,
                                      const CellValues<BulkFluidGradients>* gradients = nullptr);

  /// Records of this rank's cells at each local particle: their mean with the weights of the last
  /// deposit, cells without a record counting as T{}. Collective.
  template <class T>
  std::vector<T> sample_records(const CellValues<T>& owned) const {
    const std::vector<T> cells = touched_->fetch_from_owners(owned, T{});
    std::vector<T> means(weights_.particles());
    demvof::sample(weights_, reinterpret_cast<const double*>(cells.data()), row_width<T>(),
                   reinterpret_cast<double*>(means.data()));
    return means;
  }

  const CellValues<BulkParticles>& deposited() const { return deposited_; }
  /// Local particles of the last deposit that lay outside the bulk grid: they count in its nearest cells.
  long outside() const { return outside_; }
  /// What had to be moved out of full cells in the last deposit.
  const SolidRelief& relief() const { return relief_; }
  /// Largest solid fraction of a bulk cell in the last deposit, -. Collective.
  double largest_solid_fraction() const;
  /// Left-over impulse that came for cells without drag in the last sample, this rank, N s: given
  /// to nobody.
  const Vec3& unplaced_left_over() const { return unplaced_left_over_; }

 private:
  void sample_gradients(const CellValues<BulkFluid>& owned, const CellValues<BulkFluidGradients>& gradients,
                        std::vector<FluidAtParticle>& at_particles);

  MPI_Comm world_;
  BulkGrid grid_;
  BulkPartition partition_;
  AveragingParameters parameters_;
  CellValues<double> open_share_;  // this rank's cells that are not all open
  bool all_open_ = true;           // on all ranks
  std::optional<Diffusion> diffusion_;
  KernelWeights weights_;
  std::optional<TouchedCells> touched_;
  CellValues<BulkParticles> deposited_;
  long outside_ = 0;
  SolidRelief relief_;
  Vec3 unplaced_left_over_;
};

}  // namespace demvof
