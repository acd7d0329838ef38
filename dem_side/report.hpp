// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "coupler/exchange/particle_report.hpp"
#include "coupler/transfer/averaging.hpp"
#include "dem_side/contact_stiffness.hpp"
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

  /// The report of the window just done. Collective; the same on every rank. replaced_volume: of this rank.
  ParticleReport window(const FluidForces& forces, const Averaging& averaging, double replaced_volume,
                        const WallSeconds& seconds);

  long lost() const { return lost_; }
  long count() const { return count_; }

 private:
  void count_changes(long now);

  const Dem& dem_;
  ContactStiffness contact_stiffness_;
  double outside_before_ = 0;                // particles outside the fluid at the end of the window before
  long count_ = 0;                           // at the end of the last window
  long inserted_before_ = 0;                 // by the script's insertions, before the coupled run
  long left_before_ = 0;                     // through the script's outlets, before the coupled run
  long inserted_ = 0, left_ = 0, lost_ = 0;  // since its start
};

}  // namespace demvof
