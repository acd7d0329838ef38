// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "coupler/transfer/averaging.hpp"
#include "dem_side/dem.hpp"
#include "dem_side/forces.hpp"

namespace demvof {

/// Wall time of this rank since the start of the run, s.
struct WallSeconds {
  double dem = 0;        // DEM steps, forces included
  double averaging = 0;  // particles to bulk grid and back
  double exchange = 0;   // packing and moving data between the programs, waiting apart
  double waiting = 0;    // for the partner
};

/// Momentum of the moving particles at half steps, sum of m v + (dt/2) f (forces.hpp says why), over
/// all ranks, kg m/s. Collective.
Vec3 half_step_momentum(const Dem& dem);

/// What dem_side tells foam_side, and through it the user, about every window.
class Report {
 public:
  /// Takes the number of particles now as the start. Collective.
  explicit Report(const Dem& dem);

  /// The report of the window just done as JSON text. Collective; the same on every rank.
  ///
  ///   count, inserted, left, lost    particles now; put in, taken out by the script, and gone otherwise
  ///                                  since the start of the coupled run
  ///   waiting_for_fluid              particles that felt no fluid in this window
  ///   outside_bulk_grid              particles beyond its walls; they count in its nearest cells
  ///   mass, solid_volume             kg, m3; solid_volume_bulk: summed over the bulk grid
  ///   kinetic_energy                 of translation, J;  potential_energy  -m g.x, J
  ///   max_speed, solid_front         m/s; largest coordinates that a particle's surface reaches, m
  ///   momentum                       of the half steps (forces.hpp), kg m/s; changes by
  ///     drag_impulse + pressure_impulse + left_over_given + stress_impulse + constant_impulse - held_impulse
  ///     + contact_impulse + gravity_impulse
  ///   replaced_volume                of particles that are liquid on the fine mesh, m3: in solid_volume, not
  ///                                  in solid_volume_bulk
  ///   drag_impulse_bulk              the same as drag_impulse unless particles were lost, N s
  ///   left_over_unplaced             left-over impulse of cells without drag, given to nobody, N s
  ///   closures                       by name: evaluations in this window, and how many of them were outside
  ///                                  the range the closure was fitted for
  ///   relieved_cells, relieved_volume, unplaced_volume    of the solid limit (limit_solid.hpp)
  ///   steps                          DEM steps of this window
  ///   seconds                        dem, averaging, exchange, waiting: of rank 0, since the start
  ///   peak_memory_bytes              sum over ranks
  /// replaced_volume: of this rank.
  std::string window(const FluidForces& forces, const Averaging& averaging, double replaced_volume,
                     const WallSeconds& seconds);

  long lost() const { return lost_; }
  long count() const { return count_; }

 private:
  void count_changes(long now);

  const Dem& dem_;
  long count_ = 0;                           // at the end of the last window
  long inserted_before_ = 0;                 // by the script's insertions, before the coupled run
  long left_before_ = 0;                     // through the script's outlets, before the coupled run
  long inserted_ = 0, left_ = 0, lost_ = 0;  // since its start
};

}  // namespace demvof
