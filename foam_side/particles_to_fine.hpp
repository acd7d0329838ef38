// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "coupler/config/parameters.hpp"
#include "coupler/exchange/crossing.hpp"
#include "coupler/exchange/momentum_exchange.hpp"
#include "coupler/exchange/owed_pressure.hpp"
#include "coupler/exchange/solid_in_fluids.hpp"
#include "foam_side/bulk_cut.hpp"
#include "foam_side/flow.hpp"
#include "foam_side/surface_to_bulk.hpp"

namespace demvof {

/// What the particles did in a window, on the fine mesh: void fraction and momentum sources of the flow. All
/// calls are collective over the fluid side.
class ParticlesToFine {
 public:
  ParticlesToFine(Flow& flow, const BulkCut& cut, SurfaceToBulk& surface, const CouplingParameters& coupling);

  /// The coming window's length, s; from the start that of coupling.window.
  void set_window(double window) { window_ = window; }

  /// When the mesh has been cut anew.
  void renew() { distribute(); }

  /// What the particles did in one of the fluids: cells owned by this rank, active in the cut.
  struct InFluid {
    CellValues<BulkParticles> particles;
    // Velocity that they were told, minus the mean that the exchange works on, m/s.
    CellValues<Vec3> felt_shift;
    CellValues<Vec3> ahead;     // of the fluid of the window's start, in what they were told, m/s
    CellValues<double> before;  // solid volume of what was taken the time before, m3; take() fills it in
  };
  /// One entry per fluid: liquid, gas.
  void take(std::vector<InFluid> particles);

  const CellValues<BulkParticles>& particles(int k) const { return state_[k].particles; }

  /// Solid volume of the bulk grid as void fraction of each fine cell, with the surface as it is now: what is
  /// wet in the liquid, what is dry in the gas. part: of the window, 0 to 1. Throws RunError where the
  /// particles leave no room for the fluid. At 0 less what has become liquid since.
  scalarField void_fraction(double part = 1);
  /// What became liquid, or took its place back, at the begin of the present window.
  void note(const std::vector<Droplet>& droplets) { droplets_ = droplets; }
  /// What the last void fraction came to, over all ranks.
  struct Spread {
    double solid_volume = 0;  // on the fine mesh, m3
    long negative_cells = 0;  // fine cells in which an interpolation went below zero: they got none
    long full_cells = 0;      // fine cells with more solid than leaves room for the fluid: they got less
    double moved_volume = 0;  // that found no room in its own fluid of a bulk cell: it is in the other, m3
  };
  const Spread& spread() const { return spread_; }

  /// Solid fraction that one particle gives to each fine cell, with the kernel of coupling.averaging.
  scalarField solid_fraction_of(const Vec3& position, double volume) const;

  /// Solid volume times velocity of the particles, per volume of each fine cell, m/s (phase interchange
  /// `volume_adding`).
  Foam::vectorField solid_flux_density() const;

  /// Mean velocity of the particles in each fine cell, m/s; 0 where there are none.
  Foam::vectorField solid_velocity() const;

  /// Sets the flow's source fields from the particles taken, shared among the fine cells of a bulk cell with
  /// the weights of sharing_weights.hpp, as they are now. In every fluid step. Of a bulk cell that the mesh
  /// has left, what the fluid gets whatever its velocity is goes to the fluid nearest to it.
  void spread_sources();
  /// What went there in the present window, or will, over all ranks.
  struct Beside {
    long cells = 0;
    double impulse = 0, whole = 0;  // N s, summed by its size in each bulk cell: of these cells; of all
    bool matters() const { return impulse > 1e-6 * whole; }
  };
  const Beside& beside() const { return beside_; }

  /// What the implicit part of the sources took from the fluid of each bulk cell since begin_window or the
  /// last call, N s: cells owned by this rank; none where nobody is owed anything. Before each change of the
  /// mesh, because new cells cannot tell which bulk cell it came from.
  std::vector<CellValues<Vec3>> collect_impulse();

  /// True when what the implicit part took is handed back to the particles.
  bool hands_back() const;
  /// The fluid got an impulse (N s) from the particles in another way, which they are owed like the rest.
  void count_given(const Vec3& impulse) { collected_sum_ += impulse; }
  /// What the pressure of the step just done left to the particles of each bulk cell, by fluid: cells owned
  /// by this rank. Where the surface cuts a bulk cell, with the weight of that fluid in place of the
  /// mixture's of its fine cells, and without the stress that is not that fluid's (stress_of_other.hpp), as
  /// it is told (fluid_to_bulk.cpp); smeared_weight: what that adds, of this rank, N s. gradient: grad p, per
  /// fine cell.
  struct LeftToParticles {
    std::vector<CellValues<OwedPressure::Left>> by_fluid;
    Vec3 smeared_weight;
  };
  LeftToParticles left_to_particles(const Foam::vectorField& gradient) const;

  /// The window's impulses are complete.
  void end_window();

  /// Impulses of the window just simulated, sums over all ranks, N s.
  struct Impulses {
    Vec3 explicit_part, implicit_part;
  };
  Impulses impulses() const;

  /// What lives from one window to the next.
  const std::vector<InFluid>& state() const { return state_; }
  /// Goes on from the state at the end of a window. After the particles of that time have been taken.
  void go_on_from(std::vector<InFluid> state);

 private:
  void give_to_fluid_beside(int k, const std::vector<CellId>& with_fluid, std::vector<FluidSource>& sources);
  /// Of the window, at the end of the present step, -.
  double done() const { return 1 - (flow_.clock.window_end - flow_.time.value()) / window_; }
  /// Volume, m3, and flux, m4/s, of solid.
  struct Solid {
    double volume = 0;
    Vec3 flux;
  };
  std::vector<Solid> solid() const;
  std::vector<Vec3> own_shape() const;
  void distribute();
  std::vector<double> solid_fraction(const std::vector<std::vector<double>>& volumes);
  /// Solid of each subcell, m3: what solid_fraction is made of where the mapping is none that interpolates.
  struct SolidInSubcells {
    std::vector<std::vector<double>> by_fluid;
    double moved = 0;  // to the other fluid (SolidInFluids), this rank
  };
  SolidInSubcells solid_in_subcells(const std::vector<std::vector<double>>& volumes) const;
  void keep_in_main_fluid(std::vector<double>& rise, const std::vector<double>& mean,
                          const std::vector<SolidInFluids>& inside, const std::vector<double>& liquid,
                          const std::vector<double>& gas) const;
  /// Solid volume of each touched cell, by fluid, m3. part: of the window, -.
  std::vector<std::vector<double>> solid_volumes(double part) const;

  Flow& flow_;
  const BulkCut& cut_;
  SurfaceToBulk& surface_;
  const CouplingParameters& coupling_;
  double window_;       // s
  bool taken_ = false;  // something, before
  // By fluid:
  std::vector<InFluid> state_;                         // as received
  std::vector<std::vector<BulkParticles>> touched_;    // per touched cell of the cut
  std::vector<std::vector<Vec3>> felt_shift_here_;     // per touched cell; where the mapping makes one
  std::vector<std::vector<Vec3>> ahead_here_;          // per touched cell; where they are told of order 2
  std::vector<std::vector<double>> coefficient_part_;  // per subcell of the cut: its part of the fine cell's
                                                       // coefficient, -
  std::vector<Droplet> droplets_;
  Spread spread_;
  Beside beside_;
  Vec3 collected_sum_, implicit_impulse_;  // what the fine cells got, this rank, N s: so far; in the window
};

/// Of each bulk cell, m3.
CellValues<double> solid_volume(const CellValues<BulkParticles>& particles);

}  // namespace demvof
