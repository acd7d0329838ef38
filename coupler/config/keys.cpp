// SPDX-License-Identifier: GPL-3.0-or-later
#include "coupler/config/keys.hpp"

#include <algorithm>

#include "coupler/config/enum_names.hpp"
#include "coupler/config/parameter_values.hpp"
#include "coupler/config/quantities.hpp"

namespace demvof {
namespace {

// Rules.

using Form = ValueRule::Form;

ValueRule text() {
  return {};
}
ValueRule number(const std::string& unit) {
  ValueRule rule;
  rule.form = Form::number;
  rule.unit = unit;
  return rule;
}
ValueRule integer(double lowest, double highest) {
  ValueRule rule;
  rule.form = Form::integer;
  rule.lowest = lowest;
  rule.highest = highest;
  return rule;
}
ValueRule flag() {
  ValueRule rule;
  rule.form = Form::flag;
  return rule;
}
template <class E>
ValueRule one_of() {
  ValueRule rule;
  rule.form = Form::choice;
  for (const auto& item : enum_names<E>) rule.choices.push_back(item.second);
  return rule;
}
ValueRule history_quantity() {
  ValueRule rule;
  rule.form = Form::choice;
  for (const Quantity& quantity : known_quantities) rule.choices.emplace_back(quantity.name);
  return rule;
}
ValueRule table(int columns, const std::string& unit) {
  ValueRule rule;
  rule.form = Form::table;
  rule.list_length = columns;
  rule.unit = unit;
  return rule;
}
ValueRule above(double bound, ValueRule rule) {
  rule.lowest = bound;
  rule.lowest_excluded = true;
  return rule;
}
ValueRule at_least(double bound, ValueRule rule) {
  rule.lowest = bound;
  return rule;
}
ValueRule at_most(double bound, ValueRule rule) {
  rule.highest = bound;
  return rule;
}
ValueRule list_of(int length, ValueRule rule) {
  rule.list_length = length;
  return rule;
}

/// at: the parameter, as an access that works on const and mutable CaseParameters.
template <class Access>
Key key(const std::string& path, const ValueRule& rule, const std::string& doc, Access at) {
  Key key;
  key.path = path;
  key.rule = rule;
  key.doc = doc;
  key.get = [at](const CaseParameters& c) { return to_json_value(at(c)); };
  key.set = [at](CaseParameters& c, const Json& value) { from_json_value(value, at(c)); };
  return key;
}
Key required(Key key) {
  key.required = true;
  return key;
}
Key changes_no_result(Key key) {
  key.changes_results = false;
  return key;
}

#define DEMVOF_AT(member) \
  [](auto& c) -> auto& {  \
    return c.member;      \
  }

std::vector<Key> make_keys() {
  constexpr double many_ranks = 100000, many_cells = 1000000;
  constexpr int any = ValueRule::any_length;
  return {
      required(key("fluid.case", text(), "Folder of the OpenFOAM case, counted from the case file's folder.",
                   DEMVOF_AT(fluid.case_folder))),
      changes_no_result(
          key("fluid.ranks", integer(1, many_ranks), "MPI ranks of foam_side.", DEMVOF_AT(fluid.ranks))),
      key("fluid.prepare", list_of(any, text()),
          "OpenFOAM commands that make mesh and fields, run in the copied case in this order.",
          DEMVOF_AT(fluid.prepare)),

      key("fluid.refinement.levels", integer(1, 5), "How often a cell of the case's mesh may be halved.",
          DEMVOF_AT(fluid.refinement->levels)),
      key("fluid.refinement.buffer", integer(1, 20),
          "Rings of fine cells around the interface, which never comes within half a cell of coarser ones.",
          DEMVOF_AT(fluid.refinement->buffer)),
      key("fluid.refinement.particles", flag(), "Fine wherever there are particles.",
          DEMVOF_AT(fluid.refinement->particles)),
      key("fluid.refinement.porosity_jump", at_least(0, at_most(1, number("-"))),
          "Fine where the void fraction of two neighbour cells differs by more; 0: not asked.",
          DEMVOF_AT(fluid.refinement->porosity_jump)),
      key("fluid.refinement.max_cells", integer(1, 2e9), "No finer once the mesh has so many cells.",
          DEMVOF_AT(fluid.refinement->max_cells)),
      key("fluid.refinement.max_imbalance", at_least(1, number("-")),
          "Cells move between the ranks when one has more than this times the mean number.",
          DEMVOF_AT(fluid.refinement->max_imbalance)),

      required(key("particles.script", text(),
                   "The LIGGGHTS input script, counted from the case file's folder.",
                   DEMVOF_AT(particles->script))),
      changes_no_result(key("particles.ranks", integer(1, many_ranks), "MPI ranks of dem_side.",
                            DEMVOF_AT(particles->ranks))),
      key("particles.unseen_surfaces", list_of(any, text()),
          "Fixes of the script that move surfaces which the fluid does not see: it flows through them, and "
          "no wall of it has to move along.",
          DEMVOF_AT(particles->unseen_surfaces)),

      required(key("bulk_grid.lower", list_of(3, number("m")), "Lower corner of the bulk grid.",
                   DEMVOF_AT(bulk_grid->lower))),
      required(key("bulk_grid.upper", list_of(3, number("m")),
                   "Upper corner; above the lower one in every direction.", DEMVOF_AT(bulk_grid->upper))),
      required(key("bulk_grid.cells", list_of(3, integer(1, many_cells)),
                   "Number of bulk cells in each direction.", DEMVOF_AT(bulk_grid->cells))),

      required(key(
          "gravity.table", at_least(-1e9, at_most(1e9, table(4, "s, m/s2"))),
          "Rows [t, g_x, g_y, g_z] of the whole of gravity in the frame of the walls, linear in between and "
          "constant before the first and after the last; a file has a row in each line, and # begins a "
          "comment.",
          DEMVOF_AT(gravity->rows))),

      required(key(
          "coupling.end_time", above(0, number("s")),
          "Simulated time at the end of the run, a whole number of windows (of DEM time steps where windows "
          "have their own lengths). It counts from 0, as the fluid's controlDict does.",
          DEMVOF_AT(coupling.end_time))),
      required(key("coupling.window", above(0, number("s")),
                   "Both sides advance by one window between exchanges; a whole number of DEM time steps.",
                   DEMVOF_AT(coupling.window))),
      required(key("coupling.window.tolerance", above(0, number("m/s")),
                   "Change of a particle's velocity by the fluid that it may hear of a window late.",
                   DEMVOF_AT(coupling.adaptive_window->tolerance))),
      required(key("coupling.window.shortest", above(0, number("s")),
                   "No window is shorter, but for those that end at an output with equal parts; the first "
                   "one has this "
                   "length.",
                   DEMVOF_AT(coupling.adaptive_window->shortest))),
      required(key("coupling.window.longest", above(0, number("s")), "No window is longer.",
                   DEMVOF_AT(coupling.adaptive_window->longest))),
      key("coupling.schedule", one_of<Schedule>(),
          "Who advances when; staggered: the particles, then the fluid; concurrent: both at the same time, "
          "each with what the other did in the window before.",
          DEMVOF_AT(coupling.schedule)),
      key("coupling.exchange", one_of<ExchangeScheme>(), "How momentum passes between particles and fluid.",
          DEMVOF_AT(coupling.exchange)),
      key("coupling.order", integer(1, 2),
          "Order in the window of what the particles are told; 1: the fluid of the window's start; 2: of its "
          "middle, continued from the window before where that is stable.",
          DEMVOF_AT(coupling.order)),
      key("coupling.sharing", one_of<Sharing>(), "How a bulk cell's source is shared among its fine cells.",
          DEMVOF_AT(coupling.sharing)),
      key("coupling.phase_interchange", one_of<PhaseInterchange>(),
          "How particles cross the interface; porous: the void fraction stands in the alpha equation; "
          "volume_adding: liquid fills the particles' volume; replacement: a particle that hits the "
          "interface "
          "becomes a drop of liquid on the fine mesh; none: no particle crosses it.",
          DEMVOF_AT(coupling.phase_interchange)),
      key("coupling.interchange_speed", at_least(0, number("m/s")),
          "With replacement: a particle that closes in on the interface no faster than this stays a "
          "particle; "
          "at most bulk spacing / window (the longest).",
          DEMVOF_AT(coupling.interchange_speed)),
      changes_no_result(key("coupling.time_out", above(0, number("s")),
                            "A side that hears nothing from its partner for so long gives up (exit code 4).",
                            DEMVOF_AT(coupling.time_out))),

      key("coupling.averaging.kernel", one_of<Kernel>(), "Weights of a particle in the bulk cells around it.",
          DEMVOF_AT(coupling.averaging.kernel)),
      key("coupling.averaging.width", at_least(0, number("m")),
          "Standard deviation of the gaussian kernel; 0: half a bulk cell.",
          DEMVOF_AT(coupling.averaging.width)),
      key("coupling.averaging.bandwidth", at_least(0, number("m")),
          "Bandwidth b of the diffusion kernel, sqrt(2) standard deviations; 0: six of the largest particle "
          "diameters at the start.",
          DEMVOF_AT(coupling.averaging.bandwidth)),
      key("coupling.averaging.maximum_solid_fraction", above(0, at_most(1, number("-"))),
          "Of a bulk cell; what is above moves to the neighbours, and is counted.",
          DEMVOF_AT(coupling.averaging.maximum_solid_fraction)),

      key("coupling.mapping.to_fine", one_of<Mapping>(),
          "The void fraction, from the bulk grid to the fine mesh; nearest and conservative keep the solid "
          "volume. Forces are always shared without loss.",
          DEMVOF_AT(coupling.mapping.to_fine)),
      key("coupling.mapping.to_bulk", one_of<Mapping>(),
          "The fluid, from the fine mesh to the bulk grid: means over a bulk cell (nearest, conservative), "
          "or "
          "values at its centre.",
          DEMVOF_AT(coupling.mapping.to_bulk)),

      key("forces.drag", one_of<DragLaw>(),
          "Drag law, written {drag: law}; docs/theory.md says for which range each was fitted.",
          DEMVOF_AT(forces.drag)),
      key("forces.pressure_gradient", flag(),
          "-V grad p on each particle (buoyancy included), written as the bare word.",
          DEMVOF_AT(forces.pressure_gradient)),
      key("forces.own_wake", one_of<OwnWake>(),
          "Takes the particle's own wake out of the fluid velocity it feels, written {own_wake: oseen}.",
          DEMVOF_AT(forces.own_wake)),
      key("forces.viscous_stress", flag(), "V div(tau) on each particle, written as the bare word.",
          DEMVOF_AT(forces.viscous_stress)),
      key("forces.added_mass", at_least(0, number("-")),
          "Coefficient of the added mass, 0.5 for a single sphere, written {added_mass: 0.5}.",
          DEMVOF_AT(forces.added_mass)),
      key("forces.lift", one_of<LiftLaw>(), "Lift law, written {lift: law}.", DEMVOF_AT(forces.lift)),
      key("forces.spin_lift", one_of<SpinLiftLaw>(),
          "Lift law of a particle that spins against its fluid, written {spin_lift: law}.",
          DEMVOF_AT(forces.spin_lift)),
      key("forces.torque", flag(),
          "Torque on a particle that spins against its fluid, written as the bare word.",
          DEMVOF_AT(forces.torque)),
      key("forces.history", flag(),
          "History (Basset) force, of what the particle's slip has been, written as the bare word.",
          DEMVOF_AT(forces.history)),
      key("forces.capillary", flag(),
          "V sigma kappa grad alpha on each particle, its share of the surface force, written as the bare "
          "word.",
          DEMVOF_AT(forces.capillary)),
      key("forces.suspension_viscosity", one_of<SuspensionViscosity>(),
          "The particles make the fluid's stress larger, by this law of the solid fraction; written "
          "{suspension_viscosity: law}.",
          DEMVOF_AT(forces.suspension_viscosity)),
      key("forces.constant", list_of(3, number("N")),
          "The same force from outside on each particle, written {constant: [x, y, z]}.",
          DEMVOF_AT(forces.constant)),

      key("forces.lubrication.cut_off", above(0, at_most(1, number("-"))),
          "Widest film, over the mean radius of its two spheres, or the radius of the sphere at a wall; the "
          "formula is that of narrow films.",
          DEMVOF_AT(forces.lubrication->cut_off)),
      key("forces.lubrication.roughness", above(0, at_most(1, number("-"))),
          "Narrowest film, likewise: there asperities touch, and the fluid gets out between them.",
          DEMVOF_AT(forces.lubrication->roughness)),
      key("forces.lubrication.suction", flag(),
          "The film resists surfaces that part as well; false: it cavitates.",
          DEMVOF_AT(forces.lubrication->suction)),

      key("scene.particles", one_of<Switch>(), "Particles; off: the run is made without them.",
          DEMVOF_AT(scene.particles)),
      key("scene.surface_tension", one_of<Switch>(),
          "Curvature and surface tension; auto: on when a coefficient is above 0.",
          DEMVOF_AT(scene.surface_tension)),
      key("scene.interface", one_of<Switch>(),
          "Transport of the liquid fraction; auto: on when there are two fluids.",
          DEMVOF_AT(scene.interface_advection)),
      key("scene.porosity", one_of<Switch>(),
          "Void fraction in the fluid equations; auto: on with particles above the dilute limit.",
          DEMVOF_AT(scene.porosity)),
      key("scene.dilute_limit", at_least(0, at_most(1, number("-"))),
          "With porosity auto: left out while the largest solid fraction on the bulk grid is below this.",
          DEMVOF_AT(scene.dilute_limit)),

      key("output.interval", at_least(0, number("s")), "Time between field outputs; 0: only at the end.",
          DEMVOF_AT(output.interval)),
      key("output.history_interval", at_least(0, number("s")),
          "Time between rows of history.csv; 0: every window.", DEMVOF_AT(output.history_interval)),
      key("output.history", list_of(any, history_quantity()),
          "Quantities in history.csv; an empty list: all that the scene has.", DEMVOF_AT(output.history)),
      key("output.pictures", list_of(any, at_least(0, number("s"))),
          "Times shown in report.html; an empty list: begin, four between, end; times after the end are left "
          "out.",
          DEMVOF_AT(output.pictures)),
      changes_no_result(key("output.states", integer(1, 1000),
                            "States that the run can be continued from: so many, the newest, are kept.",
                            DEMVOF_AT(output.states))),

      key("limits.books", above(0, number("-")), "Largest conservation.exchange and conservation.momentum.",
          DEMVOF_AT(limits.books)),
      key("limits.volume", above(0, number("-")),
          "Largest conservation.solid_volume and conservation.liquid_volume.", DEMVOF_AT(limits.volume)),
      key("limits.courant", above(0, number("-")), "Most cells that the fluid may cross in a step.",
          DEMVOF_AT(limits.courant)),
      key("limits.lost_particles", at_least(0, at_most(1, number("-"))),
          "Largest share of the particles that leave the box where the script has no outlet.",
          DEMVOF_AT(limits.lost_particles)),
  };
}

#undef DEMVOF_AT

}  // namespace

const std::vector<Key>& case_keys() {
  static const std::vector<Key> keys = make_keys();
  return keys;
}
const Key* find_key(const std::string& path) {
  const auto found = std::find_if(case_keys().begin(), case_keys().end(),
                                  [&path](const Key& key) { return key.path == path; });
  return found == case_keys().end() ? nullptr : &*found;
}

std::string parent_of(const std::string& path) {
  const std::size_t dot = path.rfind('.');
  return dot == std::string::npos ? "" : path.substr(0, dot);
}
std::string name_of_key(const std::string& path) {
  return path.substr(path.rfind('.') + 1);
}

CaseParameters default_parameters() {
  CaseParameters parameters;
  for (const Section& section : case_sections()) section.create(parameters);
  return parameters;
}

}  // namespace demvof
