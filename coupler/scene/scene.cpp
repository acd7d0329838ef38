// SPDX-License-Identifier: GPL-3.0-or-later
#include "coupler/scene/scene.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <tuple>

#include "coupler/base/errors.hpp"
#include "coupler/closures/drag_range.hpp"
#include "coupler/config/enum_names.hpp"

namespace demvof {
namespace {

/// One plan in the making: what is forced and known, and the decisions so far.
class Plan {
 public:
  Plan(const SceneParameters& forced, const SceneFacts& facts) : forced_(forced), facts_(facts) {}

  bool particles();
  bool interface_advection();
  bool surface_tension();
  PhaseInterchange interchange(PhaseInterchange chosen);
  bool porosity(PhaseInterchange interchange);
  bool turbulence(bool porosity);
  void forces(const ForceParameters& forces);
  void capillary_force(bool named, bool surface_tension);
  SuspensionViscosity suspension_viscosity(const ForceParameters& forces, bool porosity);
  void advise_on_no_force(const ForceParameters& forces);
  void advise_on_drag(DragLaw chosen);
  void advise_on_added_mass(const ForceParameters& forces);
  void advise_on_phases();
  void advise_on_dem_step();
  void empty_bulk_cells();
  bool moving_mesh();

  std::vector<Decision> decisions;
  std::vector<std::string> advice;
  std::string impossible;  // what the case file forces in vain, one line each

 private:
  void force_on_particles(const std::string& name, bool named);
  bool decide(const std::string& decision, bool on, const std::string& reason) {
    decisions.push_back({decision, on, reason});
    return on;
  }
  /// The case file's word, unless it asks for what cannot be; obstacle: why it cannot, or empty.
  bool force(const std::string& decision, const std::string& key, Switch how, const std::string& obstacle) {
    if (how == Switch::on && !obstacle.empty()) {
      impossible += fmt::format("{}{}: on is impossible: {}", impossible.empty() ? "" : "\n", key, obstacle);
      return false;
    }
    return decide(decision, how == Switch::on, fmt::format("The case file says {}: {}.", key, name_of(how)));
  }

  const SceneParameters& forced_;
  const SceneFacts& facts_;
  bool with_particles_ = false;
};

bool Plan::particles() {
  const std::string name = "particles";
  const std::string none = "the case has no particle script";
  with_particles_ = facts_.particles && forced_.particles != Switch::off;
  if (forced_.particles != Switch::automatic)
    return force(name, "scene.particles", forced_.particles, facts_.particles ? "" : none);
  if (!facts_.particles)
    return decide(name, false, "The case has no particle script: plain VOF, no partner.");
  return decide(name, true,
                fmt::format("The script gives {} particles at the start{}.", facts_.particle_count,
                            facts_.inserts_particles ? " and inserts more during the run" : ""));
}

void Plan::force_on_particles(const std::string& name, bool named) {
  if (!with_particles_)
    decide(name, false, "There are no particles.");
  else
    decide(name, named, named ? "It is named in forces." : "It is not named in forces.");
}

void Plan::forces(const ForceParameters& forces) {
  const bool drag = forces.drag != DragLaw::none;
  force_on_particles(drag ? "drag (" + name_of(forces.drag) + ")" : "drag", drag);
  force_on_particles("pressure-gradient force", forces.pressure_gradient);
  force_on_particles("own wake taken out of the velocity felt", forces.own_wake != OwnWake::none);
  force_on_particles("viscous stress on particles", forces.viscous_stress);
  const bool added_mass = forces.added_mass > 0;
  force_on_particles(added_mass ? fmt::format("added mass ({})", forces.added_mass) : "added mass",
                     added_mass);
  const bool lift = forces.lift != LiftLaw::none;
  force_on_particles(lift ? "lift (" + name_of(forces.lift) + ")" : "lift", lift);
  const bool spin_lift = forces.spin_lift != SpinLiftLaw::none;
  force_on_particles(spin_lift ? "lift by spin (" + name_of(forces.spin_lift) + ")" : "lift by spin",
                     spin_lift);
  force_on_particles("torque on particles", forces.torque);
  force_on_particles("history force", forces.history);
  const auto& films = forces.lubrication;
  force_on_particles(films ? fmt::format("lubrication, gaps of {:g} to {:g} radii{}", films->roughness,
                                         films->cut_off, films->suction ? "" : ", without suction")
                           : "lubrication",
                     films.has_value());
  force_on_particles("constant force on particles", norm(forces.constant) > 0);
}

void Plan::capillary_force(bool named, bool surface_tension) {
  const std::string name = "capillary force on particles";
  if (with_particles_ && named && !surface_tension)
    decide(name, false, "It is named in forces, but the run has no surface tension.");
  else
    force_on_particles(name, named);
}

SuspensionViscosity Plan::suspension_viscosity(const ForceParameters& forces, bool porosity) {
  const SuspensionViscosity law = forces.suspension_viscosity;
  const bool named = law != SuspensionViscosity::none;
  const std::string name = "viscosity of the suspension" + (named ? " (" + name_of(law) + ")" : "");
  if (named && with_particles_ && forces.viscous_stress)
    impossible += fmt::format(
        "{}forces: viscous_stress and suspension_viscosity cannot both be named: the second gives the fluid "
        "the whole stress, the particles' share included",
        impossible.empty() ? "" : "\n");
  if (named && with_particles_ && !porosity) {
    decide(name, false, "It is named in forces, but the run has no porosity.");
    return SuspensionViscosity::none;
  }
  force_on_particles(name, named);
  return with_particles_ ? law : SuspensionViscosity::none;
}

void Plan::advise_on_no_force(const ForceParameters& forces) {
  const bool any = forces.drag != DragLaw::none || forces.pressure_gradient || forces.viscous_stress ||
                   forces.added_mass > 0 || forces.lift != LiftLaw::none ||
                   forces.spin_lift != SpinLiftLaw::none || forces.torque || forces.history ||
                   forces.lubrication || forces.capillary;
  if (!with_particles_ || any) return;
  advice.emplace_back(
      "forces names nothing that the fluid does to particles: they neither float nor are carried along. "
      "Leave "
      "the key out for drag and pressure gradient, or name what acts (docs/warnings.md, No force of the "
      "fluid)");
}

// A law that is somewhat out of its range is the user's choice; one made for a single sphere in a bed is a
// mistake that nobody sees.
void Plan::advise_on_drag(DragLaw chosen) {
  constexpr double far_out = 0.1;  // of the void fraction
  if (!with_particles_ || chosen == DragLaw::none) return;
  const double bed = 1 - facts_.largest_solid_fraction;
  const double smallest = drag_range(chosen).smallest_void_fraction;
  if (bed > smallest - far_out) return;
  std::string known;
  for (const DragLaw law : {DragLaw::di_felice, DragLaw::rong, DragLaw::gidaspow, DragLaw::koch_hill}) {
    const DragRange range = drag_range(law);
    if (range.smallest_void_fraction <= bed)
      known +=
          fmt::format("{}{} (Re to {:g})", known.empty() ? "" : ", ", name_of(law), range.largest_reynolds);
  }
  if (known.empty()) known = "koch_hill (void fractions from 0.359 on)";
  advice.push_back(fmt::format(
      "forces.drag: {} was fitted for void fractions from {:g} on, and the bed has {} on the bulk grid: "
      "laws that know it are {}, e.g. forces: [{{drag: {}}}, pressure_gradient] (docs/warnings.md, Drag law)",
      name_of(chosen), smallest, bed > 0 ? fmt::format("{:.2g}", bed) : "more solid than room", known,
      known.substr(0, known.find(' '))));
}

// A particle lighter than the fluid is accelerated with the fluid around it, or too much.
void Plan::advise_on_added_mass(const ForceParameters& forces) {
  const double particle = facts_.lightest_particle,
               fluid = std::max(facts_.liquid_density, facts_.gas_density);
  if (!with_particles_ || forces.added_mass > 0 || particle <= 0 || particle >= fluid) return;
  advice.push_back(
      fmt::format("forces: without added_mass the lightest particles, {:.3g} kg/m3 in a fluid of {:.4g} "
                  "kg/m3, answer {:.2g} times "
                  "too quickly to what accelerates them: {{added_mass: 0.5}} (docs/warnings.md, Added mass)",
                  particle, fluid, 1 + 0.5 * fluid / particle));
}

void Plan::advise_on_phases() {
  if (!facts_.two_fluids || facts_.liquid_density >= facts_.gas_density) return;
  advice.push_back(fmt::format(
      "transportProperties: the first of 'phases' counts as the liquid, and with {:.4g} kg/m3 it is lighter "
      "than the other, {:.4g} kg/m3: liquid_volume, fronts, levels and the surface are those of the first "
      "(docs/warnings.md, Liquid and gas)",
      facts_.liquid_density, facts_.gas_density));
}

// Longer steps give energy to particles that touch.
void Plan::advise_on_dem_step() {
  constexpr double most_of_collision = 0.2, most_of_rayleigh = 0.5;
  if (!with_particles_) return;
  for (const auto& [name, time, most] :
       {std::tuple("a collision", facts_.collision_time, most_of_collision),
        std::tuple("a Rayleigh wave", facts_.rayleigh_time, most_of_rayleigh)})
    if (time > 0 && facts_.dem_time_step > most * time)
      advice.push_back(fmt::format(
          "the script's timestep, {:.3g} s, is {:.2g} of {} ({:.3g} s): contacts are not resolved and can "
          "give particles energy out of nothing; a tenth or less is usual: shorter steps, or softer contacts "
          "(docs/warnings.md, DEM step)",
          facts_.dem_time_step, facts_.dem_time_step / time, name, time));
}

bool Plan::interface_advection() {
  const std::string name = "interface transport";
  if (forced_.interface_advection != Switch::automatic)
    return force(name, "scene.interface", forced_.interface_advection, "");
  return facts_.two_fluids ? decide(name, true, "There are two fluids.")
                           : decide(name, false, "One fluid fills the domain and all inlets.");
}

bool Plan::surface_tension() {
  const std::string name = "surface tension";
  const std::string obstacle = facts_.surface_tension <= 0 ? "the fluid case's coefficient is 0"
                               : !facts_.two_fluids        ? "one fluid has no surface"
                                                           : "";
  if (forced_.surface_tension != Switch::automatic)
    return force(name, "scene.surface_tension", forced_.surface_tension, obstacle);
  if (facts_.surface_tension <= 0)
    return decide(name, false, "The fluid case's coefficient is 0: no curvature is computed.");
  if (!facts_.two_fluids) return decide(name, false, "One fluid has no surface: no curvature is computed.");
  return decide(name, true, fmt::format("The fluid case's coefficient is {} N/m.", facts_.surface_tension));
}

PhaseInterchange Plan::interchange(PhaseInterchange chosen) {
  const std::string name = "phase interchange";
  const auto none = [&](const std::string& reason) {
    decide(name, false, reason);
    return PhaseInterchange::none;
  };
  if (!with_particles_) return none("There are no particles.");
  if (!facts_.two_fluids) return none("One fluid has no interface to cross.");
  if (chosen == PhaseInterchange::none)
    return none("The case file says coupling.phase_interchange: none: no particle crosses the interface.");
  decide(name + " (" + name_of(chosen) + ")", true, "It is chosen in coupling.phase_interchange.");
  return chosen;
}

bool Plan::porosity(PhaseInterchange interchange) {
  const std::string name = "porosity";
  if (interchange == PhaseInterchange::volume_adding) {
    if (forced_.porosity == Switch::on)
      return force(name, "scene.porosity", Switch::on,
                   "volume_adding fills the particles' volume with liquid");
    return decide(name, false, "Phase interchange volume_adding fills the particles' volume with liquid.");
  }
  const double limit = forced_.dilute_limit, fraction = facts_.largest_solid_fraction;
  if (forced_.porosity != Switch::automatic)
    return force(name, "scene.porosity", forced_.porosity, with_particles_ ? "" : "there are no particles");
  if (!with_particles_) return decide(name, false, "There are no particles.");
  if (limit <= 0) return decide(name, true, "There are particles, and no scene.dilute_limit is stated.");
  if (facts_.inserts_particles)
    return decide(name, true,
                  "Particles are inserted during the run: scene.dilute_limit cannot be judged at the start.");
  return fraction < limit
             ? decide(name, false,
                      fmt::format("The largest solid fraction, {:.3g}, is below scene.dilute_limit, {:.3g}.",
                                  fraction, limit))
             : decide(
                   name, true,
                   fmt::format("The largest solid fraction, {:.3g}, is not below scene.dilute_limit, {:.3g}.",
                               fraction, limit));
}

void Plan::empty_bulk_cells() {
  decide("exchange of bulk cells without particles near them", false,
         with_particles_ ? "They are always left out: not averaged, not exchanged."
                         : "There are no particles: nothing is averaged or exchanged.");
}

bool Plan::moving_mesh() {
  const std::string name = "bulk grid met anew by a mesh that moves";
  if (!facts_.mesh_moves) return decide(name, false, "The fluid's mesh does not move.");
  return decide(name, with_particles_,
                with_particles_ ? "The fluid's mesh moves, and particles are told in each window where it is."
                                : "The fluid's mesh moves, but there are no particles.");
}

bool Plan::turbulence(bool porosity) {
  const std::string name = "turbulence model";
  if (!facts_.turbulent) return decide(name, false, "The fluid case is laminar.");
  return decide(name, true,
                porosity ? "The fluid case names one; beware: it knows neither particles nor porosity."
                         : "The fluid case names one.");
}

}  // namespace

Scene plan_scene(const SceneParameters& forced, const SceneFacts& facts, const ForceParameters& forces,
                 PhaseInterchange interchange) {
  Plan plan(forced, facts);
  Scene scene;
  scene.particles = plan.particles();
  scene.two_fluids = facts.two_fluids;
  plan.forces(forces);
  scene.interface_advection = plan.interface_advection();
  scene.surface_tension = plan.surface_tension();
  plan.capillary_force(forces.capillary, scene.surface_tension);
  scene.interchange = plan.interchange(interchange);
  scene.porosity = plan.porosity(scene.interchange);
  scene.suspension_viscosity = plan.suspension_viscosity(forces, scene.porosity);
  plan.advise_on_no_force(forces);
  plan.advise_on_drag(forces.drag);
  plan.advise_on_added_mass(forces);
  plan.advise_on_phases();
  plan.advise_on_dem_step();
  plan.empty_bulk_cells();
  scene.mesh_moves = plan.moving_mesh();
  scene.turbulence = plan.turbulence(scene.porosity);
  if (!plan.impossible.empty()) throw InputError(plan.impossible);
  scene.decisions = plan.decisions;
  scene.advice = plan.advice;
  for (const std::string& said : facts.advice)
    if (!said.empty()) scene.advice.push_back(said);
  return scene;
}

std::string scene_table(const std::vector<Decision>& decisions) {
  std::size_t width = 0;
  for (const Decision& d : decisions) width = std::max(width, d.decision.size());
  std::string table;
  for (const Decision& d : decisions)
    table += fmt::format("{:<3}  {:<{}}  {}\n", d.on ? "on" : "off", d.decision, width, d.reason);
  return table;
}

}  // namespace demvof
