// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <map>
#include <memory>
#include <vector>

#include "coupler/config/parameters.hpp"
#include "coupler/exchange/crossing.hpp"
#include "coupler/exchange/momentum_exchange.hpp"
#include "coupler/grid/bulk_cells.hpp"
#include "coupler/transfer/remap.hpp"
#include "foam_side/flow.hpp"
#include "foam_side/sample_fluid.hpp"

namespace demvof {

/// The fluid side of the coupling: averages the fine mesh onto the bulk grid, and spreads what the
/// particles did in a window over the fine mesh. Only active bulk cells (those that the particles
/// sent) are averaged. All calls are collective over the fluid side.
class Bridge {
 public:
  Bridge(Flow& flow, const CaseParameters& parameters, const BulkGrid& grid, const BulkPartition& partition,
         MPI_Comm world);

  /// Builds the way to the bulk grid anew, when the mesh has changed.
  void remap();

  /// Bulk cells owned by this rank that the mesh does not fill, and the mesh's share in their volume.
  CellValues<double> open_shares() const;

  /// Takes what the particles sent at the end of their window; these cells are active from now on.
  /// Left-over impulse that the particles have run away from goes back to the fluid of its cell.
  /// particles: cells owned by this rank.
  void take(CellValues<BulkParticles> particles);

  /// Solid volume of the bulk grid as void fraction of each fine cell. Throws RunError where the
  /// particles leave no room for the fluid.
  scalarField void_fraction() { return void_fraction_of(solid_volume_, spread_); }
  /// What became liquid, or took its place back, at the begin of the present window.
  void note(const std::vector<Droplet>& droplets) { droplets_ = droplets; }
  /// What the last void fraction came to, over all ranks.
  struct Spread {
    double solid_volume = 0;  // on the fine mesh, m3
    long negative_cells = 0;  // fine cells in which an interpolation went below zero: they got none
  };
  const Spread& spread() const { return spread_; }
  /// The void fraction from what was taken the time before, less what has become liquid since: at the begin
  /// of the present window.
  scalarField void_fraction_before() const;

  /// Sets the flow's source fields from the particles taken, shared among the fine cells of a bulk
  /// cell as coupling.sharing says, with the mass that is in them now. In every fluid step.
  void spread_sources();

  /// Notes what the implicit part of the sources gave the fluid of each bulk cell since begin_window or the
  /// last call: it is owed to the particles. Before each change of the mesh, because new cells cannot tell
  /// which bulk cell it came from.
  void collect_impulse();

  /// The rest of the window's, and then what is owed as a whole.
  void end_window();

  /// The fluid on the active bulk cells owned by this rank, and the impulse owed to their particles,
  /// which is theirs from now on.
  CellValues<BulkFluid> bulk_fluid();

  /// Derivatives on the same cells, after bulk_fluid; only when a force needs them (need_gradients).
  CellValues<BulkFluidGradients> bulk_fluid_gradients();
  /// Solid volume times velocity of the particles, per volume of each fine cell, m/s (phase interchange
  /// `volume_adding`).
  Foam::vectorField solid_flux_density() const;

  /// The interface in the active bulk cells owned by this rank (phase interchange `replacement`).
  CellValues<BulkInterface> bulk_interface() const;

  /// Solid fraction that one particle gives to each fine cell, with the kernel of coupling.averaging.
  scalarField solid_fraction_of(const Vec3& position, double volume) const;

  /// Impulses of the window just simulated, sums over all ranks, N s.
  struct Impulses {
    Vec3 explicit_part, implicit_part;
  };
  Impulses impulses() const;

  CellId active_cells() const;  // over all ranks

  /// Where the last bulk_fluid told the particles a relaxed fluid, over all ranks.
  struct Relaxed {
    double smallest = 1;  // relaxation factor, -
    long cells = 0;       // with a factor below 1
  };
  Relaxed relaxed() const;

  /// Impulse owed to the particles of a bulk cell, and how much of them it came from.
  struct LeftOver {
    Vec3 impulse;             // N s
    double solid_volume = 0;  // sum of w V, m3
  };
  /// What the particles of a bulk cell were last told of the fluid (coupler/exchange/relaxation.hpp).
  struct Told {
    Vec3 velocity, pressure_gradient, acceleration;  // m/s, Pa/m, m/s2
  };
  /// What lives from one window to the next, on the bulk cells owned by this rank.
  struct State {
    CellValues<BulkParticles> particles;
    CellValues<LeftOver> left_over;
    CellValues<Vec3> felt_shift;
    CellValues<Told> told;
  };
  State state() const { return {owned_, left_over_, felt_shift_, told_}; }
  /// Goes on from the state at the end of a window. After the particles of that time have been taken.
  void go_on_from(State state);

 private:
  void return_left_over(CellValues<BulkParticles>& particles);
  void relax(CellValues<BulkFluid>& fluid);
  void distribute();
  scalarField void_fraction_of(const CellValues<double>& solid_volume, Spread& spread) const;
  void sample_points(const Foam::vectorField& gradient, const scalarField& viscosity,
                     CellValues<BulkFluid>& fluid) const;
  std::vector<double> fine_weights() const;
  double eps(int cell) const { return flow_.porosity ? flow_.porosity->eps[cell] : 1.0; }
  double density(int cell) const;  // of the fluid between the particles, kg/m3

  Flow& flow_;
  const CaseParameters& parameters_;
  MPI_Comm world_;
  BulkGrid grid_;
  BulkPartition partition_;
  std::unique_ptr<Remap> remap_;
  std::unique_ptr<FluidSampler> sampler_;  // only for a mapping to the bulk grid that takes values at points
  bool reconstructs_ = false;              // pieces of a fine cell differ: a linear profile in the fine cells
  CellValues<BulkParticles> owned_;        // as received
  std::map<CellId, Vec3> collected_;       // owned cells: impulse owed from this window so far, N s
  Vec3 collected_sum_, implicit_impulse_;  // what the fine cells got, this rank, N s: so far; in the window
  CellValues<LeftOver> left_over_;         // owned cells; not handed over yet
  CellValues<double> solid_volume_;        // of these, m3
  CellValues<double> solid_volume_before_;
  std::vector<Droplet> droplets_;
  std::vector<BulkParticles> touched_;    // per touched cell of the remap
  std::vector<Piece> pieces_;             // those in active bulk cells
  std::vector<double> coefficient_part_;  // per piece: its part of the fine cell's coefficient, -
  // Velocity told to the particles minus the sharing's mean, m/s: last told; told to those that owned_ is
  // of, per owned and per touched cell.
  CellValues<Vec3> shift_, felt_shift_;
  std::vector<Vec3> felt_shift_here_;
  CellValues<Told> told_;           // cells of the last bulk_fluid
  std::vector<double> relaxation_;  // of these, -
  Relaxed relaxed_;                 // this rank
  Spread spread_;
};

}  // namespace demvof
