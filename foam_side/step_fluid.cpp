// SPDX-License-Identifier: GPL-3.0-or-later
#include "foam_side/step_fluid.hpp"

#include <algorithm>

#include "coupler/link/run_stage.hpp"
#include "foam_side/accelerating_walls.hpp"
#include "foam_side/extras.hpp"

namespace demvof {
namespace {

/// How much of the window has passed at a time (s), -.
double part_of_window(const Clock& clock, double time) {
  return (time - clock.window_begin) / (clock.window_end - clock.window_begin);
}

/// What the flux of this step serves: the coming step's. Beyond the window's end the particles go on as they
/// did.
scalarField void_fraction_after_next_step(const Flow& flow, ParticlesToFine& to_fine) {
  const double now = flow.time.value(), next = now + flow.time.deltaTValue();
  const double part = part_of_window(flow.clock, next), step = part - part_of_window(flow.clock, now);
  if (part < 1 + 0.5 * step) return to_fine.void_fraction(std::min(part, 1.0));
  const scalarField before = to_fine.void_fraction(1 - step), end = to_fine.void_fraction(1);
  return end + (end - before);
}

/// The surface, or drops, have moved since the goal was set: it is that of now, and the rate has what is left
/// of the coming step. Before a change of the mesh, or new cells would get that with their profile, at once.
void catch_up_with_surface(Flow& flow, ParticlesToFine& to_fine) {
  const double step = flow.time.deltaTValue(), now = flow.time.value() - step;
  const scalarField goal = to_fine.void_fraction(part_of_window(flow.clock, now));
  flow.porosity->rate.field() += (flow.porosity->goal.field() - goal) / step;
  flow.porosity->goal.field() = goal;
}

/// The mesh moves through the bulk grid, and through what the particles prescribe there.
void move_with_particles(Flow& flow, Bridge* bridge) {
  if (bridge) bridge->collect_impulse();
  move_under_particles(flow);
  if (bridge) bridge->remap();
  if (!flow.porosity) return;
  if (!bridge) return move_porosity(flow, flow.porosity->goal, flow.porosity->goal);
  ParticlesToFine& to_fine = bridge->particles_to_fine();
  set_solid_velocity(flow, to_fine.solid_velocity());
  const double now = flow.time.value(), step = flow.time.deltaTValue();
  const scalarField begin = to_fine.void_fraction(part_of_window(flow.clock, now - step));
  move_porosity(flow, begin, to_fine.void_fraction(part_of_window(flow.clock, now)));
}

}  // namespace

bool step_fluid(Flow& flow, Bridge* bridge) {
  if (!advance_clock(flow)) return false;
  run_stage().set("fluid step", flow.time.value());
  const auto before_change = [bridge, &flow] {
    if (!bridge) return;
    bridge->collect_impulse();
    if (flow.porosity && flow.scene.two_fluids) catch_up_with_surface(flow, bridge->particles_to_fine());
  };
  const bool moves = extras(flow).motion != MeshMotion::never;
  if (moves && flow.source) move_with_particles(flow, bridge);
  if (!moves && refine_mesh(flow, before_change)) {
    if (bridge) bridge->remap();
    if (bridge && flow.porosity) {
      set_solid_velocity(flow, bridge->particles_to_fine().solid_velocity());
      renew_porosity(flow, bridge->particles_to_fine().void_fraction(0),
                     bridge->particles_to_fine().void_fraction(1));
    }
    settle_flux(flow);
  }
  update_porosity(flow);
  if (bridge) bridge->particles_to_fine().spread_sources();
  while (outer_corrector(flow)) {
    if (!flow.source) move_mesh(flow);
    advect_interface(flow);
    if (bridge && flow.porosity && flow.scene.two_fluids && !moves)
      follow_surface(flow, void_fraction_after_next_step(flow, bridge->particles_to_fine()));
    if (flow.pimple.frozenFlow()) continue;
    predict_momentum(flow);
    if (moves && flow.source) let_pressure_accelerate_walls(flow);
    while (pressure_corrector(flow)) correct_pressure(flow);
  }
  end_step(flow);
  if (bridge) bridge->collect_pressure();
  if (bridge && flow.scene.two_fluids)
    bridge->collect_impulse();  // before the surface moves on to other fine cells
  return true;
}

}  // namespace demvof
