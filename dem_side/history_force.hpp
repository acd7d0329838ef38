// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>

#include "coupler/base/vec3.hpp"
#include "coupler/closures/history.hpp"
#include "dem_side/closure_count.hpp"
#include "dem_side/dem.hpp"

namespace demvof {

/// History force on the particles, in every DEM step, of their wetted share a:
///
///   F = B int d(a (u - v))/ds (t - s)^-1/2 ds
///
/// What becomes wet meets its whole slip at once; out of the liquid all is forgotten. A particle that begins
/// in the fluid begins with the slip of long ago. What it remembers goes with it, from rank to rank and from
/// run to run.
class HistoryForce {
 public:
  /// Gives the particles their memory, empty.
  explicit HistoryForce(Dem& dem);

  void begin_window() { count_ = {}; }
  void begin_step();

  /// What the past asks of local particle i in the present step: force + a inertia (du/dt - dv/dt), N.
  struct Memory {
    Vec3 force;          // N
    double inertia = 0;  // kg
  };
  Memory recall(int i, double diameter, double density, double viscosity, double slip);

  /// After the step's accelerations have been found. share: a, -; slip: u - v, m/s; relative: du/dt - dv/dt,
  /// m/s2.
  void remember(int i, double share, const Vec3& slip, const Vec3& relative);
  /// Out of the fluid.
  void forget(int i);

  const ClosureCount& count() const { return count_; }

 private:
  Dem& dem_;
  std::optional<HistoryKernel> kernel_;
  double step_ = 0;                // s, of kernel_
  double* const* rows_ = nullptr;  // of the local particles in this step
  ClosureCount count_;
};

}  // namespace demvof
