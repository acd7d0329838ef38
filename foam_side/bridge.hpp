// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "coupler/config/parameters.hpp"
#include "coupler/exchange/left_over.hpp"
#include "coupler/exchange/owed_pressure.hpp"
#include "coupler/exchange/seen_fluid.hpp"
#include "coupler/exchange/window_rule.hpp"
#include "foam_side/bulk_cut.hpp"
#include "foam_side/fluid_to_bulk.hpp"
#include "foam_side/openings_to_bulk.hpp"
#include "foam_side/particles_to_fine.hpp"

namespace demvof {

/// The fluid side of the coupling: what the particles are told of the fluid of the fine mesh, and what they
/// did in a window on it, both by way of the bulk grid. Only active bulk cells (those that the particles
/// sent) are told of. All calls are collective over the fluid side.
class Bridge {
 public:
  Bridge(Flow& flow, const CaseParameters& parameters, const BulkGrid& grid, const BulkPartition& partition,
         MPI_Comm world);

  const BulkCut& cut() const { return cut_; }
  SurfaceToBulk& surface_to_bulk() { return surface_; }
  const SurfaceToBulk& surface_to_bulk() const { return surface_; }
  OpeningsToBulk& openings_to_bulk() { return openings_; }
  const OpeningsToBulk& openings_to_bulk() const { return openings_; }
  const FluidToBulk& fluid_to_bulk() const { return fluid_to_bulk_; }
  ParticlesToFine& particles_to_fine() { return particles_to_fine_; }

  /// Builds the way to the bulk grid anew, when the mesh has changed.
  void remap();

  /// Takes what the particles sent at the end of their window; these cells are active from now on.
  /// Left-over impulse that the particles have run away from goes back to the fluid of its cell.
  /// particles: cells owned by this rank, by fluid.
  void take(std::vector<CellValues<BulkParticles>> particles);

  /// Notes what is owed to the particles so far. Before each change of the mesh.
  void collect_impulse();

  /// The fluid got an impulse (N s) at a place from the particles there: their bulk cell owes it to them with
  /// the opposite sign. False, and nothing is noted, when nobody there has drag or nothing is handed back.
  /// The same on every rank. After take().
  bool owe(const Vec3& position, const Vec3& impulse);

  /// Notes what the pressure of the step just done left to the particles, and of order 2 what the step adds
  /// to the means over the window.
  void collect_pressure();

  /// The rest of the window's, and then what is owed as a whole.
  void end_window();

  /// Where windows have their own lengths: what the window came to, over all ranks, after end_window; and the
  /// length of the next one, s, before bulk_fluids. largest_speed: of a particle at its end, m/s.
  WindowChange change(double largest_speed);
  void set_window(double window);

  /// Gravity of the coming window; before bulk_fluids.
  void follow_gravity(const Vec3& gravity);

  /// The fluid on the active bulk cells owned by this rank, relaxed, and the impulse owed to their particles,
  /// which is theirs from now on.
  std::vector<CellValues<BulkFluid>> bulk_fluids();

  /// Derivatives on the same cells, after bulk_fluids; only when a force needs them (need_gradients).
  std::vector<CellValues<BulkFluidGradients>> bulk_fluid_gradients();

  /// Of what the fluid owes at the end of a window, that which could not be handed over in it, N s. Over all
  /// ranks.
  Vec3 kept_left_over() const;
  /// Of the pressure, over all ranks, N s: told to the particles in the window (to those that feel none: left
  /// to them), owed to them at its end, and gone back to the fluid in it; surface tension that acted on their
  /// share of the fine cells in place of them; and what they got beyond what the fluid left to them, the
  /// weight of what they displace in fine cells that hold both fluids.
  struct PressureImpulses {
    Vec3 seen, owed, returned, tension, smeared_weight;
    double turnover = 0;  // of what went back, summed by its size in each bulk cell
    OwedPressure::HeldBack held_back;
  };
  PressureImpulses pressure_impulses() const;
  /// Over all ranks.
  CellId active_cells() const;
  SeenFluid::Relaxed relaxed() const;

  /// What lives from one window to the next, on the bulk cells owned by this rank.
  struct State {
    CellValues<BulkParticles> particles;
    CellValues<LeftOver::Owed> left_over;
    CellValues<Vec3> felt_shift;
    CellValues<double> solid_volume_before;
    CellValues<SeenFluid::Cell> seen;
    OwedPressure::State owed_pressure;
  };
  std::vector<State> state() const;  // by fluid
  /// Goes on from the state at the end of a window. After the particles of that time have been taken.
  void go_on_from(std::vector<State> state);

 private:
  Flow& flow_;
  bool owes_pressure_;  // the fluid has a void fraction and its particles feel the pressure
  bool tells_jump_;     // of the surface: with the capillary force
  bool of_order_two_;   // in the window
  bool accelerates_;    // a force needs Du/Dt
  MPI_Comm world_;
  double window_;                  // s
  double pace_ = 1;                // at which owed pressure is returned (owed_pressure.hpp), -
  Vec3 tension_, smeared_weight_;  // in this window, this rank, N s
  Vec3 unclaimed_;                 // what the pressure left to particles that feel none, likewise
  BulkCut cut_;
  OpeningsToBulk openings_;
  SurfaceToBulk surface_;
  FluidToBulk fluid_to_bulk_;
  ParticlesToFine particles_to_fine_;
  std::vector<FluidToBulk::Means> means_;  // of the end of the window, as far as they are known already
  // By fluid:
  std::vector<LeftOver> left_over_;
  std::vector<SeenFluid> seen_;
  std::vector<OwedPressure> owed_pressure_;
  std::vector<CellValues<Vec3>> shift_;  // velocity last told minus the mean that the exchange works on, m/s
};

}  // namespace demvof
