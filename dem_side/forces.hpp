// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Forces of the fluid on the particles, in every DEM step:
//
//   F_drag     = beta (u - v), integrated implicitly (implicit_drag.hpp)
//   F_pressure = -V grad p       grad p of the total pressure: buoyancy is inside it
//   F_left     = M_i / window    impulse still owed from the exchange of the last window
//   F_stress   = V (div tau + sigma kappa grad alpha), each part when it is named
//   F_lift     = lift.hpp
//   F_added    = m_a (Du/Dt - dv/dt), m_a = C_m rho V, implicit with the drag
//   F_constant the case file's
//
// u and its derivatives, grad p, rho, mu and M_i are constant over a window, beta and v are not. What the
// fluid gets back through the exchange is the reaction to drag, lift and added mass: they make up the
// drag impulse. Pressure and stress are the particle's share of terms that stand in the fluid's equation.
//
// Time levels. LIGGGHTS integrates by velocity Verlet. When it asks for forces at step n, it holds
// x(n) and v(n-1/2), and the force found takes v to n+1/2. The momentum of these half steps,
//
//   P = sum of m v(n+1/2) = sum of m v(n) + (dt/2) f(n),
//
// therefore changes over a window by exactly the sum of dt f over its steps: the impulses below,
// drag + pressure + left-over + stress + constant - held + contact + gravity, add up to its change to
// round-off.

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "coupler/closures/force_parameters.hpp"
#include "coupler/exchange/support.hpp"
#include "coupler/grid/bulk_cells.hpp"
#include "coupler/transfer/fluid_at_particle.hpp"
#include "coupler/transfer/wake_width.hpp"
#include "dem_side/dem.hpp"

namespace demvof {

/// What a particle carries through a window, from rank to rank: what it feels and what it received.
/// All zero for a particle that came into being during the window: no fluid acts on it yet.
struct CarriedFluid {
  Vec3 velocity;               // u, m/s
  double density = 0;          // rho, kg/m3; 0: no fluid
  double viscosity = 0;        // mu, Pa s
  double void_fraction = 1;    // eps, -
  Vec3 pressure_force;         // N
  Vec3 left_over_force;        // N
  Vec3 drag_impulse;           // received in this window, lift and added mass included, N s
  double drag_factor_sum = 0;  // sum of beta over the steps of this window, kg/s
  double drag_exponent = 1;    // n at the start of this window (implicit_drag.hpp), -
  double contact_steps = 0;    // steps of this window with a force other than gravity
  Vec3 contact_impulse;        // received from contacts in this window, N s
};

/// What it carries besides when a force needs the fluid's derivatives.
struct CarriedGradients {
  Vec3 stress_force;   // N
  Vec3 acceleration;   // Du/Dt, m/s2
  Vec3 vorticity;      // 1/s
  Vec3 other_impulse;  // of the drag impulse, what lift and added mass gave, N s
};

/// Impulses of one window on this rank's particles, N s.
struct WindowImpulses {
  Vec3 drag, pressure, left_over, stress;  // on all particles; drag with lift and added mass
  Vec3 held;                               // the part of these that went to particles which no force moves
  Vec3 contact, gravity, constant;         // on the particles that forces move
};

/// How often a closure was evaluated, and how often outside the range it was fitted for.
struct ClosureCount {
  double evaluations = 0, outside = 0;
};

class FluidForces {
 public:
  /// Attaches itself to the DEM, which must outlive it.
  FluidForces(Dem& dem, const ForceParameters& parameters);
  FluidForces(const FluidForces&) = delete;
  FluidForces& operator=(const FluidForces&) = delete;

  /// From here on drag goes by the slip that is left when the particle's own disturbance is taken out of the
  /// fluid velocity (closures/own_wake.hpp). width: over which that is spread.
  /// Throws InputError when that is less than the largest diameter; begin_window() does for later particles.
  void take_out_own_wake(const WakeWidth& width, double largest_diameter);

  /// For a run that goes on: what the particles carry is of a window (s) with so many DEM steps.
  void go_on_from(double window, int steps);

  /// Starts a window with the fluid at each local particle. window: s.
  void begin_window(const std::vector<FluidAtParticle>& fluid, double window);

  /// What each local particle adds to the bulk grid at the end of the window, before weighting.
  std::vector<BulkParticles> contributions() const;

  /// The same of what holds it.
  std::vector<Support> support() const;

  /// State of local particle i.
  const CarriedFluid& carried(int i) const;
  WindowImpulses impulses() const;
  /// The closures in use by name, with their counts in this window on this rank.
  std::vector<std::pair<std::string, ClosureCount>> closures() const;
  /// Local particles that feel no fluid: new ones, and those where there is none.
  long waiting_for_fluid() const;
  /// DEM steps done in this window.
  int steps() const { return steps_; }

 private:
  template <class Drag>
  void attach(const Drag& drag_law);
  template <bool with_gradients, class Drag>
  void add_forces(const Drag& drag_law, const ParticleArrays& particles, double* const* external);
  Vec3 lift(const CarriedFluid& fluid, const CarriedGradients& gradients, double diameter, const Vec3& slip);
  double mean_drag_factor(const CarriedFluid& fluid) const;
  double mean_drag_tangent(const CarriedFluid& fluid) const;
  double added_mass(const CarriedFluid& fluid, double radius) const {  // kg
    return parameters_.added_mass * fluid.density * sphere_volume(radius);
  }

  Dem& dem_;
  ForceParameters parameters_;
  std::optional<WakeWidth> own_wake_width_;
  bool begun_ = false;         // a window; before it is Dem::set_up()
  double window_ = 0;          // s; 0 before the first one
  int steps_ = 0;              // done in this window
  WindowImpulses force_sums_;  // N, summed over the steps of this window
  ClosureCount drag_count_, lift_count_;
};

}  // namespace demvof
