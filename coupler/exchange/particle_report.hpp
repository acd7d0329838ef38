// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>

#include "coupler/base/vec3.hpp"

namespace demvof {

/// What dem_side tells foam_side, and through it the user, about every window and about the start. Sums are
/// over all particles and ranks. Travels as a row of doubles.
struct ParticleReport {
  // Particles now; put in, taken out by the script, and gone otherwise since the start of the coupled run.
  double count = 0, inserted = 0, left = 0, lost = 0;
  double waiting_for_fluid = 0;  // particles inside the mesh that felt no fluid in this window
  // In contact, and of these on springs that the drag outruns; windows that would not, s
  // (dem_side/soft_contacts.hpp).
  double touching = 0, on_soft_springs = 0, holding_window = 0, mild_window = 0;
  double outside_fluid = 0;  // particles outside the fluid's mesh: they displace nothing and feel nothing

  double mass = 0, solid_volume = 0;  // kg, m3
  double solid_volume_bulk = 0;       // summed over the bulk grid, m3
  double replaced_volume = 0;   // of particles that are liquid on the fine mesh, m3: in solid_volume, not
                                // in solid_volume_bulk
  double kinetic_energy = 0;    // of translation, J
  double potential_energy = 0;  // -m g.x, J
  double max_speed = 0;         // m/s
  Vec3 solid_front;             // largest coordinates that a particle's surface reaches, m; without
                                // particles it says nothing

  // Momentum of the half steps (dem_side/forces.hpp), kg m/s. It changes by drag + pressure + left_over +
  // stress + constant - held + contact + gravity, the impulses of the window, N s.
  Vec3 momentum;
  Vec3 drag_impulse, pressure_impulse, left_over_given, stress_impulse, constant_impulse;
  Vec3 held_impulse, contact_impulse, gravity_impulse;
  Vec3 drag_impulse_bulk;   // the same as drag_impulse unless particles were lost, N s
  Vec3 left_over_unplaced;  // left-over impulse of cells without drag, given to nobody, N s

  // Spin momentum of the half steps, sum of I w, kg m2/s, when the fluid has a torque on the particles, else
  // 0. It changes by the angular impulses of fluid and contacts, N m s.
  Vec3 spin_momentum, torque_impulse, contact_torque_impulse;

  // Of the solid limit (coupler/transfer/limit_solid.hpp): cells, m3, m3.
  double relieved_cells = 0, relieved_volume = 0, unplaced_volume = 0;

  double steps = 0;  // DEM steps of this window
  // Wall time of rank 0 since the start, s: WallSeconds of dem_side.
  double dem_seconds = 0, averaging_seconds = 0, exchange_seconds = 0, waiting_seconds = 0;
  double peak_memory_bytes = 0;  // sum over ranks

  /// Evaluations of a closure in this window, and how many of them were outside the range it was fitted for.
  struct Closure {
    double evaluations = 0, outside = 0;
  };
  std::array<Closure, 8> closures = {};  // in the order of the names that dem_side's facts state
};

}  // namespace demvof
