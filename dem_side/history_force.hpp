// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>

#include "coupler/base/vec3.hpp"
#include "coupler/closures/history.hpp"
#include "dem_side/closure_count.hpp"
#include "dem_side/dem.hpp"

namespace demvof {

/// History force on the particles, in every DEM step. What a particle remembers of its past goes with it,
/// from rank to rank and from run to run.
class HistoryForce {
 public:
  /// Gives the particles their memory, empty.
  explicit HistoryForce(Dem& dem);

  void begin_window() { count_ = {}; }
  void begin_step();

  /// What the past asks of local particle i in the present step: force + inertia (du/dt - dv/dt), N.
  struct Memory {
    Vec3 force;          // N
    double inertia = 0;  // kg
  };
  Memory recall(int i, double diameter, double density, double viscosity, double slip);

  /// After the step's accelerations have been found. relative: du/dt - dv/dt, m/s2.
  void remember(int i, const Vec3& relative);
  /// Out of the fluid.
  void forget(int i);

  const ClosureCount& count() const { return count_; }

 private:
  Dem& dem_;
  std::optional<HistoryKernel> kernel_;
  double step_ = 0;                     // s, of kernel_
  double* const* integrals_ = nullptr;  // of the local particles in this step: I_k, m/s
  ClosureCount count_;
};

}  // namespace demvof
