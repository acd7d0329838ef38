// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <vector>

#include "coupler/config/parameters.hpp"
#include "coupler/link/own_world.hpp"
#include "coupler/link/particle_end.hpp"
#include "coupler/transfer/averaging.hpp"
#include "dem_side/fallback_results.hpp"
#include "dem_side/forces.hpp"
#include "dem_side/output.hpp"
#include "dem_side/replacement.hpp"
#include "dem_side/report.hpp"

namespace demvof {

/// What the particles of a pair do before, in and after each window. Calls are collective over dem_side.
class PairedParticles {
 public:
  /// The particles are set up; what they displace is found on the bulk grid.
  PairedParticles(Dem& dem, FluidForces& forces, const BulkGrid& grid, const AveragingParameters& averaging,
                  const CaseParameters& parameters, ParticleEnd& link, const OwnWorld& world);

  /// Of a bulk cell, -.
  double largest_solid_fraction() const { return averaging_.largest_solid_fraction(); }

  /// All windows, from the start or from where an earlier run has ended (at time continued_from, s), to the
  /// plan's end or until one side asks for a stop. After the handshake and the plan. folder: of the run.
  void run(Replacement* replacement, const std::filesystem::path& folder,
           std::optional<double> continued_from, FallbackResults& fallback);

 private:
  void weigh();
  std::function<SeenSurface(int)> surface_at_particles() const;
  std::vector<CellValues<BulkParticles>> deposit();
  /// The fluid of the coming window.
  void feel(const FluidMessage& fluid);
  /// Of the first window, before its steps: concurrent, the fluid starts with that.
  void say_what_to_expect();
  int steps_of_window() const;
  void step(int steps);
  ParticleMessage done();

  Dem& dem_;
  FluidForces& forces_;
  BulkGrid grid_;
  const CaseParameters& parameters_;
  ParticleEnd& link_;
  const OwnWorld& world_;
  Averaging averaging_;
  Replacement* replacement_ = nullptr;   // where particles become drops
  std::vector<double> radii_of_wholes_;  // where there are clumps
  double replaced_volume_ = 0;           // at the last deposit, of this rank, m3
  WallSeconds seconds_;
};

}  // namespace demvof
