// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Forces of the fluid on the particles, in every DEM step:
//
//   F_drag     = sum_k a_k beta_k (u_k - v), integrated implicitly (implicit_drag.hpp)
//   F_pressure = -V sum_k a_k grad p_k      grad p of the total pressure: buoyancy is inside it
//   F_left     = M_i / window    impulse still owed from the exchange of the last window
//   F_stress   = V (div tau + sigma kappa grad alpha), each part when it is named
//   F_lift     = lift.hpp, and of a particle that spins spin_lift.hpp
//   F_added    = sum_k m_ak (Du_k/Dt - dv/dt), m_ak = a_k C_m rho_k V, implicit with the drag
//   F_entry    = (u_1 - v) dm_a/dt while the particle enters the liquid: what it takes along starts at the
//                liquid's velocity. So (m + m_a) v is kept, v+/v- = (m + m_a-)/(m + m_a+)    (von Karman
//                1929)
//   F_history  = history.hpp, of the liquid or the only fluid; the present step's part as an added mass
//   F_constant the case file's
//   F_film     between particles, and particles and walls (lubrication.hpp), as part of what contacts do
//   F_overdue  of a particle that came into being in a window and was told of no fluid before the next: for
//   as
//                long again as it has waited F_pressure + F_stress + m_a (Du/Dt - g) once more; drag is not
//                made up for
//
// and a torque (fluid_torque.hpp).
//
// k: liquid, gas; a_k: share of the particle's volume that lies in it, of the sphere and the surface's plane
// at its present place (coupler/transfer/bulk_surface.hpp); without a surface a_1 = 1. The parts in the two
// fluids see each its own fluid: velocity, density, viscosity, pressure gradient and void fraction are not
// mixed.
//
// u and its derivatives, grad p, rho, mu and M_i are constant over a window, beta and v are not. What the
// fluid gets back through the exchange is the reaction to drag, lift, added mass and what is overdue: they
// make up the drag impulse. Pressure and stress are the particle's share of terms that stand in the fluid's
// equation.
//
// Time levels. LIGGGHTS integrates by velocity Verlet. When it asks for forces at step n, it holds
// x(n) and v(n-1/2), and the force found takes v to n+1/2. The momentum of these half steps,
//
//   P = sum of m v(n+1/2) = sum of m v(n) + (dt/2) f(n),
//
// therefore changes over a window by exactly the sum of dt f over its steps: the impulses below,
// drag + pressure + left-over + stress + constant - held + contact + gravity, add up to its change to
// round-off. LIGGGHTS takes the first half step of a run with the forces of its set-up, which knows no fluid:
// first_half_step() puts the fluid in, and counts what it gives as the first window's: what a particle gains
// the fluid loses. One that no force moves gains nothing.

#include <algorithm>
#include <array>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "coupler/base/sphere.hpp"
#include "coupler/closures/force_parameters.hpp"
#include "coupler/closures/size_mix.hpp"
#include "coupler/exchange/support.hpp"
#include "coupler/grid/bulk_cells.hpp"
#include "coupler/transfer/fluid_at_particle.hpp"
#include "coupler/transfer/wake_width.hpp"
#include "dem_side/carried_fluid.hpp"
#include "dem_side/closure_count.hpp"
#include "dem_side/dem.hpp"
#include "dem_side/fluid_torque.hpp"
#include "dem_side/history_force.hpp"
#include "dem_side/implicit_drag.hpp"
#include "dem_side/lubrication.hpp"

namespace demvof {

/// The fluids at each local particle at the start of a window: liquid and gas, or one fluid and nothing more.
struct FluidsAtParticles {
  std::function<FluidAtParticle(int)> fluid[2];  // of local particle i
  std::function<SeenSurface(int)> surface;       // likewise; empty: one fluid
};

/// Impulses of one window on this rank's particles, N s.
struct WindowImpulses {
  Vec3 drag, pressure, left_over, stress;  // on all particles; drag with lift and added mass
  Vec3 held;                        // of these what went to particles that no force moves, and Dem::Stream
  Vec3 contact, gravity, constant;  // on the particles that forces move; contact with films

  static const std::array<Vec3 WindowImpulses::*, 8> parts;
};
inline constexpr std::array<Vec3 WindowImpulses::*, 8> WindowImpulses::parts = {
    &WindowImpulses::drag, &WindowImpulses::pressure, &WindowImpulses::left_over, &WindowImpulses::stress,
    &WindowImpulses::held, &WindowImpulses::contact,  &WindowImpulses::gravity,   &WindowImpulses::constant};

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

  /// Starts a window with the fluids at each local particle. window: s.
  void begin_window(const FluidsAtParticles& fluids, double window);
  /// The same with one fluid everywhere.
  void begin_window(const std::vector<FluidAtParticle>& fluid, double window) {
    begin_window(FluidsAtParticles{{[&fluid](int i) { return fluid[i]; }, {}}, {}}, window);
  }
  /// After that, for a drag law that asks for them (knows_sizes): the sizes in fluid k around each local
  /// particle.
  void tell_sizes(int k, const std::vector<SizeMix>& sizes);

  /// Adds the fluid's forces to those of Dem::set_up(). Once, after the first begin_window() of a run that is
  /// not continued.
  void first_half_step();

  /// Sets what the surface makes of local particles that felt no fluid yet: at the start, and when they are
  /// new.
  void see_surface(const std::function<SeenSurface(int)>& surface);
  /// For local particles i that reach fluid k alone on the bulk grid: what of them lies in the other one
  /// counts in k, and what they received from that in the window.
  auto keep_to(int k) const;  // a function of i

  /// What local particle i adds to the bulk grid at the end of the window in fluid k, before weighting. To be
  /// asked for before the next DEM step.
  auto contributions(int k = 0) const;  // a function of i
  /// The same for a window that has not been simulated yet: the drag that the fluid of its start asks for, as
  /// a reference velocity, so that the particles are owed what the fluid gets. After first_half_step().
  std::function<BulkParticles(int)> expected_contributions(int k = 0) const;

  /// The same of what holds it.
  auto support(int k = 0) const;

  /// Share of the window that local particle i was in contact, -; 0 of one that no force moves.
  double touching_share(int i) const { return moved_by_forces(i) ? held_share(carried(i), true) : 0; }
  /// n beta of fluid k over the window, kg/s, with the share of i that lies in it.
  double drag_tangent(int i, int k) const { return mean_drag_tangent(carried(i), k); }
  double window() const { return window_; }  // s; 0 before the first one
  /// State of local particle i.
  const CarriedRow& carried(int i) const;
  /// -V sum_k a_k grad p_k on it, N.
  Vec3 pressure_force(int i) const;
  /// Drag, lift and added mass of both fluids in this window, N s.
  Vec3 drag_impulse(int i) const;
  WindowImpulses impulses() const;
  /// The closures in use by name, with their counts in this window on this rank.
  std::vector<std::pair<std::string, ClosureCount>> closures() const;
  /// Of this window on this rank, when the fluid has a torque on the particles.
  std::optional<SpinImpulses> spin_impulses() const;
  /// Local particles that feel no fluid: new ones, and those where there is none.
  long waiting_for_fluid() const;
  /// DEM steps done in this window.
  int steps() const { return steps_; }

 private:
  template <class Drag>
  void attach(const Drag& drag_law);
  template <bool with_gradients, class Drag>
  void add_forces(const Drag& drag_law, const ParticleArrays& particles, double* const* added);

  /// One DEM step, or the first half of one.
  struct DemStep {
    const ParticleArrays& particles;
    double length;                       // s
    Vec3 gravity = {}, of_script = {};   // m/s2
    double* const* rows = nullptr;       // of the particles
    double* const* gradients = nullptr;  // likewise
    FluidTorque* torque = nullptr;
    HistoryForce* history = nullptr;
    double* const* added = nullptr;  // where what is given is noted; nullptr: nowhere
    WindowImpulses sums = {};        // of this step alone: fewer numbers in one sum, less round-off
    void give(int i, const Vec3& force) const {
      for (int axis = 0; axis < 3; ++axis) particles.force[i][axis] += force[axis];
      if (added) std::copy_n(&force.x, 3, added[i]);
    }
  };
  /// What a step has found of a particle before its acceleration is known.
  struct Found {
    bool moves = false;     // by the forces on it
    bool touches = false;   // something
    bool in_fluid = false;  // is told of one that acts in this step
    struct Part {
      double beta = 0, added = 0;
      Vec3 slip, across, overdue;
    };
    std::optional<Part> parts[2];                // in the fluids that it feels
    double beta = 0, added = 0;                  // sums
    Vec3 pull;                                   // sum of beta slip
    Vec3 steady;                                 // of the fluid, constant in the step
    Vec3 own;                                    // to be added without any fluid
    Vec3 others;                                 // than drag
    Vec3 drag(double mass, double step) const {  // mean of the step, as what they make a particle do
      return moves && beta > 0 ? implicit_drag(beta, pull, others, mass + added, step) : pull;
    }
    Vec3 mean_drag, acceleration;  // that, and what all of it makes
  };
  template <bool with_gradients, class Drag>
  Found find_forces(const Drag& drag_law, DemStep& step, int i);
  void bear_films(DemStep& step, std::vector<Found>& all);
  void move_as_clumps(DemStep& step, std::vector<Found>& all);
  static void turn_clumps(const ParticleArrays& particles, const std::vector<Vec3>& given);
  static void require_known_for_clumps(const ForceParameters& parameters);  // InputError
  template <class Drag>
  void act_on_each_lone(const Drag& drag_law, DemStep& step);
  template <class Drag>
  void act_on_lone(const Drag& drag_law, DemStep& step);
  template <class Drag>
  void act_on_lone_wide(const Drag& drag_law, DemStep& step);
  template <bool with_gradients, class Drag>
  void act_on_any(const Drag& drag_law, DemStep& step, int i);
  template <bool with_gradients>
  void move_alone(const DemStep& step, int i, Found& found);
  /// What is to be added to LIGGGHTS's force, N.
  template <bool with_gradients>
  Vec3 force_on(DemStep& step, int i, const Found& found);

  template <class Drag>
  double drag_factor(const Drag& law, CarriedFluid& fluid, double diameter, double slip);
  template <class Drag>
  double new_drag_factor(const Drag& law, CarriedFluid& fluid, double diameter, double slip);
  Vec3 lift(const CarriedFluid& fluid, const CarriedGradients& gradients, double diameter, const Vec3& slip);
  Vec3 spin_lift(const CarriedFluid& fluid, const CarriedGradients& gradients, double diameter,
                 const Vec3& spin, const Vec3& slip);
  static double mean_drag_factor(const CarriedRow& row, int k) {
    return row.contacts.evaluations > 0 ? row.fluid[k].drag_factor_sum / row.contacts.evaluations : 0;
  }
  static double mean_drag_tangent(const CarriedRow& row, int k) {
    return row.fluid[k].drag_exponent * mean_drag_factor(row, k);
  }
  bool moved_by_forces(int i) const;  // local particle i, at present
  bool moved_by_forces(const ParticleArrays& particles, int i) const {
    return (particles.in_clump(i) || dem_.integrates_sphere(particles.mask[i])) && !dem_.stream(i).carries;
  }
  static double held_share(const CarriedRow& row, bool moved) {  // of the window, in contact
    const CarriedContacts& contacts = row.contacts;
    return moved && contacts.evaluations > 0 ? contacts.touching / contacts.evaluations : 1;
  }
  double added_mass(const CarriedRow& row, int k, double volume) const {  // kg
    return parameters_.added_mass * row.share(k) * row.fluid[k].density * volume;
  }
  double* const* gradient_rows() const;  // nullptr when no force needs them

  Dem& dem_;
  ForceParameters parameters_;
  std::optional<WakeWidth> own_wake_width_;
  bool begun_ = false;         // a window; before it is Dem::set_up()
  bool half_step_ = false;     // in first_half_step()
  double window_ = 0;          // s; 0 before the first one
  int steps_ = 0;              // done in this window
  WindowImpulses force_sums_;  // N, summed over the steps of this window
  ClosureCount drag_count_, lift_count_, spin_lift_count_;
  std::optional<FluidTorque> torque_;
  std::optional<HistoryForce> history_;
  std::optional<Lubrication> lubrication_;
};

}  // namespace demvof

#include "dem_side/deposit_rows.hpp"
