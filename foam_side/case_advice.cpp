// SPDX-License-Identifier: GPL-3.0-or-later
#include "foam_side/case_advice.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "coupler/base/errors.hpp"
#include "foam_side/balance_mesh.hpp"
#include "foam_side/case_numbers.hpp"
#include "foam_side/case_sources.hpp"
#include "foam_side/divided_cells.hpp"
#include "foam_side/first_look.hpp"
#include "foam_side/mesh_ends.hpp"
#include "foam_side/pressure_solver.hpp"
#include "foam_side/replacement.hpp"
#include "foam_side/scene_facts.hpp"
#include "foam_side/step_limits.hpp"

namespace demvof {
namespace {

void add_unless_empty(std::vector<std::string>& advice, const std::string& said) {
  if (!said.empty()) advice.push_back(said);
}

void require_refinement_to_fit(const Flow& flow) {
  const PhaseInterchange interchange = flow.scene.interchange;
  if (interchange != PhaseInterchange::volume_adding && interchange != PhaseInterchange::replacement) return;
  throw InputError(
      "constant/dynamicMeshDict: dynamicRefineFvMesh: coupling.phase_interchange: volume_adding needs a mesh "
      "that "
      "stays as it is, replacement one that is fine wherever a particle may become liquid: remove the file, "
      "and for "
      "the latter write a section fluid.refinement with particles: true");
}

std::string long_steps_for_waves(const Flow& flow, double surface_tension, double step) {
  const double wave = capillary_step(flow, surface_tension);
  if (wave <= 0 || step <= wave) return {};
  return fmt::format(
      "surface tension is explicit: where the surface is in the mesh's smallest cells, waves of their size "
      "grow in "
      "steps longer than {:.2g} s, and a step may have {:.2g} s. Give controlDict maxDeltaT {:.2g} "
      "(docs/warnings.md, Surface tension)",
      wave, step, wave);
}

}  // namespace

std::vector<std::string> fluid_advice(const Flow& flow, const MeshRefinement& refinement, bool paired,
                                      bool continues, const Vec3& gravity, double surface_tension,
                                      double step, int ranks) {
  const std::string forget = sources_that_forget(flow);
  if (continues && !forget.empty()) throw InputError("--continue: " + forget + "; start a new run");
  std::vector<std::string> advice;
  add_unless_empty(advice, slope_without_effect(flow.mesh, flow.gravity));
  add_unless_empty(advice, gravity_that_jumps(gravity, flow.gravity, flow.time.startTime().value()));
  add_unless_empty(advice, slow_pressure_solver(flow));
  if (flow.scene.surface_tension) add_unless_empty(advice, long_steps_for_waves(flow, surface_tension, step));
  add_unless_empty(advice, pimple_by_default(flow.mesh));
  if (paired) add_unless_empty(advice, forget);
  if (paired) add_unless_empty(advice, unknown_sources(flow));
  if (refinement.parameters && ranks > 1 && cells_stay(flow.mesh))
    advice.emplace_back(
        "fluid.refinement: the mesh has cyclic patches, and cells stay on their ranks, however many of them "
        "there are (max_imbalance)");
  if (refinement.by_case) {
    require_refinement_to_fit(flow);
    advice.push_back(refined_as_of_case(*refinement.parameters));
  }
  return advice;
}

std::vector<std::string> pair_advice(const Flow& flow, const CaseParameters& parameters, const BulkGrid& grid,
                                     const nlohmann::json& particles, bool continues) {
  std::vector<std::string> advice;
  require_mesh_fits(grid, flow.mesh, continues && flow.scene.mesh_moves);
  add_unless_empty(advice, walls_inside_bulk_cells(flow.mesh, grid));
  if (const auto& unseen = parameters.particles->unseen_surfaces; !unseen.empty())
    advice.push_back(fmt::format(
        "The fluid does not see what fix {} moves: it flows through there, and is moved by particles "
        "alone (docs/warnings.md, Unseen surfaces)",
        fmt::join(unseen, ", ")));
  if (!continues)
    for (const std::string& said : first_look(parameters, flow, grid, particles)) advice.push_back(said);
  require_same_motion(flow, particles.value("moved_surfaces", std::vector<std::string>()));
  if (flow.ghost && particles.at("inserts_particles").get<bool>())
    throw InputError(
        "the script puts particles in during the run, and coupling.phase_interchange is volume_adding, which "
        "fills each with liquid: that would have to flow to where they come into being, through the gas, "
        "too; "
        "porous makes room for them without");
  if (flow.porosity && particles.at("inserts_particles").get<bool>() && flow.p_rgh.needReference())
    throw InputError(
        "the script puts particles in during the run, and the fluid's box is closed: no patch fixes p_rgh, "
        "so that "
        "the fluid has nowhere to go; give the case an opening, or scene.porosity: off");
  if (flow.scene.interchange == PhaseInterchange::replacement)
    require_mesh_resolves_particles(flow.mesh, particles.at("min_diameter"));
  return advice;
}

}  // namespace demvof
