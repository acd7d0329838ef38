// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <mpi.h>

#include <functional>
#include <optional>
#include <vector>

#include "coupler/grid/bulk_cells.hpp"
#include "coupler/grid/touched_cells.hpp"
#include "coupler/transfer/averaging_parameters.hpp"
#include "coupler/transfer/bulk_walls.hpp"
#include "coupler/transfer/diffusion.hpp"
#include "coupler/transfer/fluid_at_particle.hpp"
#include "coupler/transfer/fluid_weights.hpp"
#include "coupler/transfer/limit_solid.hpp"

namespace demvof {

/// Particles to the bulk grid and back in one of the fluids, with the same weights both ways: sampling is the
/// transpose of depositing. Calls are collective.
class AveragingInFluid {
 public:
  /// parameters: with_bandwidth().
  AveragingInFluid(MPI_Comm world, const BulkGrid& grid, const BulkPartition& partition,
                   const AveragingParameters& parameters);

  /// share: of this fluid in the volume of those of this rank's cells that are not all its own, -. Particles
  /// count in that share only.
  void set_shares(CellValues<double> share);
  /// Faces of this rank's cells that nothing goes through.
  void set_walls(const CellValues<BulkWalls>& walls);
  /// Where the particles are from here on: weights before shares, their cells, and radii. outside: 1 for a
  /// particle without fluid around it; it leaves its impulse, displaces nothing and is told of no fluid. All
  /// of them must outlive this.
  void weigh(const KernelWeights& weights, const TouchedCells& touched, const std::vector<char>& outside,
             const double* radii);
  /// True for a particle that reaches a cell with this fluid.
  bool reached_by(int particle) const { return weights_.reaches(particle); }

  /// Sums the particles' contributions into the bulk cells they reach; what is above the largest solid
  /// fraction of a cell counts in its neighbours, with all that it brings, and is told of the fluid there
  /// (limit_solid.hpp). contribution: BulkParticles of a local particle. Returned: this rank's cells.
  template <class Contribution>
  const CellValues<BulkParticles>& deposit(const Contribution& contribution) {
    deposited_ = sum_up<BulkParticles>([&](int i) { return in_fluid(i, contribution(i)); });
    if (relocation_.empty()) find_relocation();
    if (!relocation_.empty()) deposited_ = relocation_.spread(deposited_);
    return deposited_;
  }
  /// The same with more of each particle, in one go; contribution: With<More> of a local particle.
  template <class More>
  struct With {
    BulkParticles particles;
    More more;
  };
  template <class More, class Contribution>
  CellValues<More> deposit_with(const Contribution& contribution) {
    const CellValues<With<More>> sums = sum_up<With<More>>([&](int i) {
      With<More> here = contribution(i);
      here.particles = in_fluid(i, here.particles);
      return here;
    });
    deposited_ = {sums.cells, {}};
    CellValues<More> more{sums.cells, {}};
    for (const With<More>& sum : sums.values) {
      deposited_.values.push_back(sum.particles);
      more.values.push_back(sum.more);
    }
    if (relocation_.empty()) find_relocation();
    if (relocation_.empty()) return more;
    deposited_ = relocation_.spread(deposited_);
    return relocation_.spread(more);
  }
  /// Any records in the same way, after the first deposit() at these places. record(i): a T of local particle
  /// i.
  template <class T, class Record>
  CellValues<T> deposit_records(const Record& record) {
    CellValues<T> owned = sum_up<T>(record);
    return relocation_.empty() ? owned : relocation_.spread(owned);
  }

  /// This fluid at each local particle. owned: this rank's cells of the last deposit. Cells without fluid do
  /// not count in the mean; a particle that reaches no other gets density 0. gradients: of the same cells,
  /// when a force needs them. Returned: the fluid at local particle i, to be asked for before the next
  /// weigh().
  std::function<FluidAtParticle(int)> sample(const CellValues<BulkFluid>& owned,
                                             const CellValues<BulkFluidGradients>* gradients = nullptr);
  /// Records of this rank's cells at a local particle: their mean, cells without a record counting as T{}.
  template <class T>
  auto sample_records(CellValues<T> owned) const {
    return weights_.samples(fetch(std::move(owned)));
  }

  const CellValues<BulkParticles>& deposited() const { return deposited_; }
  CellValues<BulkParticles>& deposited() { return deposited_; }
  /// What had to be moved out of full cells with the particles where they are.
  const SolidRelief& relief() const { return relief_; }
  /// Left-over impulse that came for cells without drag in the last sample, this rank, N s: given to nobody.
  const Vec3& unplaced_left_over() const { return unplaced_left_over_; }

 private:
  template <class T>
  std::vector<T> fetch(CellValues<T> owned) const {
    if (!relocation_.empty()) owned = relocation_.gather(owned);
    if (diffusion_) owned = diffusion_->gather(std::move(owned));
    return touched_->fetch_from_owners(owned, T{});
  }
  template <class T, class Record>
  CellValues<T> sum_up(const Record& record) const {
    CellValues<T> owned = touched_->sum_to_owners(weights_.deposit<T>(record));
    return diffusion_ ? diffusion_->spread(std::move(owned)) : owned;
  }
  BulkParticles in_fluid(int particle, const BulkParticles& contribution) const {
    if (!outside_[particle]) return contribution;
    BulkParticles left;
    left.drag_impulse = contribution.drag_impulse;  // of the window in which it left
    return left;
  }
  void find_relocation();
  double around(int particle, double void_fraction) const;

  MPI_Comm world_;
  BulkGrid grid_;
  BulkPartition partition_;
  double maximum_solid_fraction_;
  CellValues<double> share_;  // this rank's cells that are not all this fluid's
  bool everywhere_ = true;    // on all ranks no such cells
  std::optional<Diffusion> diffusion_;
  CellValues<BulkWalls> walls_;
  FluidWeights weights_;
  const char* outside_ = nullptr;
  const double* radii_ = nullptr;  // m
  const TouchedCells* touched_ = nullptr;
  CellValues<BulkParticles> deposited_;
  Relocation relocation_;  // out of full cells, with the particles where they are
  SolidRelief relief_;
  Vec3 unplaced_left_over_;
};

}  // namespace demvof
