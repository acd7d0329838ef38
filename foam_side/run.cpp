// SPDX-License-Identifier: GPL-3.0-or-later
#include "foam_side/run.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <optional>

#include "coupler/config/read_case.hpp"
#include "coupler/link/fluid_end.hpp"
#include "coupler/link/handshake_items.hpp"
#include "coupler/link/run_stage.hpp"
#include "coupler/link/signals.hpp"
#include "coupler/output/restart_point.hpp"
#include "coupler/output/run_lock.hpp"
#include "coupler/scene/plan_windows.hpp"
#include "foam_side/case_advice.hpp"
#include "foam_side/case_numbers.hpp"
#include "foam_side/fluid_case.hpp"
#include "foam_side/numbers_of_case.hpp"
#include "foam_side/restart.hpp"
#include "foam_side/run_alone.hpp"
#include "foam_side/run_pair.hpp"
#include "foam_side/run_record.hpp"
#include "foam_side/said_by.hpp"
#include "foam_side/scene_facts.hpp"
#include "foam_side/step_fluid.hpp"
#include "foam_side/step_limits.hpp"

namespace demvof {

namespace {

namespace fs = std::filesystem;
using nlohmann::json;

json facts_as_json(const SceneFacts& facts) {
  return {{"surface_tension", facts.surface_tension},
          {"two_fluids", facts.two_fluids},
          {"turbulent", facts.turbulent}};
}

void add_particle_facts(SceneFacts& facts, const json& particles) {
  facts.particles = true;
  facts.particle_count = particles.at("particle_count");
  facts.inserts_particles = particles.at("inserts_particles");
  facts.largest_solid_fraction = particles.at("largest_solid_fraction");
  facts.lightest_particle = particles.value("lightest_particle", 0.0);
  facts.dem_time_step = particles.value("time_step", 0.0);
  facts.collision_time = particles.value("collision_time", 0.0);
  facts.rayleigh_time = particles.value("rayleigh_time", 0.0);
}

/// Shows what only a step asks for: entries of fvSchemes, function objects, walls that go along with the
/// mesh. step: s.
void try_step(Flow& flow, double step, const fs::path& folder) try {
  begin_window(flow, flow.time.value() + step);
  step_fluid(flow, nullptr);
} catch (const RunError& error) {
  throw InputError(std::string("the first step fails: ") + error.what());
} catch (const Foam::error& error) {
  throw InputError(said_by(error, folder));
}

/// The state that the run goes on from, if any, and the log of this one.
std::optional<RestartPoint> open_run(const ProgramOptions& options, const CaseParameters& parameters,
                                     const OwnWorld& world) {
  std::optional<RestartPoint> start;
  if (options.continues) {
    start = open_state(options, parameters, world);
    if (world.rank() == 0) keep_earlier(options.out, "fluid.log");
  }
  send_output_to(options.out / "fluid.log", world.rank());
  return start;
}

/// How the mesh refines itself; what the case file says of it is written where OpenFOAM looks for it.
void write_refinement(const MeshRefinement& refinement, const fs::path& out, bool continues, int rank) {
  if (!refinement.parameters) return;
  if (continues && !fs::exists(out / "fluid" / "constant" / "dynamicMeshDict"))
    throw InputError("--continue: fluid.refinement was not given in the run; remove it, or start a new run");
  if (rank == 0) write_mesh_dictionary(out / "fluid", *refinement.parameters);
}

/// The handshake; returns the particles' facts. state: checksum of that which the run goes on from, or "no".
json meet_partner(const ProgramOptions& options, const CaseParameters& parameters, const SceneFacts& facts,
                  const Vec3& gravity, const std::string& state, FluidEnd& link) {
  run_stage().set("handshake");
  return json::parse(link.handshake(handshake_items(version(), configuration_hash(parameters), gravity,
                                                    options.out, state, parameters.gravity),
                                    facts_as_json(facts).dump()));
}

/// What `demvof check` shows. step: the longest that a step may have, s.
void show_check(Flow& flow, const ProgramOptions& options, const CaseParameters& parameters,
                const SceneFacts& facts, const std::optional<BulkGrid>& grid, const json& particles,
                double step, int rank) {
  try_step(flow, step, options.out / "fluid");
  const ResolvedNumbers numbers = resolved_numbers(parameters, flow, facts.surface_tension, grid, particles);
  if (rank != 0) return;
  fmt::print("{}\n{}", scene_table(flow.scene.decisions), numbers_table(numbers));
  for (const std::string& advice : flow.scene.advice) fmt::print("beware: {}\n", advice);
}

int run_case(const ProgramOptions& options, const OwnWorld& world) {
  const CaseParameters parameters = read_case(options.case_file, options.overrides);
  const bool paired = parameters.particles && parameters.scene.particles != Switch::off;
  if (!paired && options.continues)
    throw InputError("--continue: only runs with particles; foam_side alone starts where controlDict says");
  if (!paired && world.partner_size() > 0)
    throw InputError(parameters.file + ": the run is made without particles, but dem_side was started, too");
  std::optional<RunLock> lock;
  if (world.rank() == 0) lock.emplace(options.out, RunLock::Part::fluid);
  const std::optional<RestartPoint> start = open_run(options, parameters, world);

  MeshRefinement refinement{parameters.fluid.refinement};
  write_refinement(refinement, options.out, options.continues, world.rank());
  const Foam::argList& args = *open_case(options.out / "fluid", world);
  install_signal_handlers();  // OpenFOAM has set its own
  require_numbers_that_can_be(case_time(args), paired);
  SceneFacts facts = fluid_facts(args);
  if (paired && !refinement.parameters) {
    refinement.parameters = take_refinement_of_case(case_time(args));
    refinement.by_case = refinement.parameters.has_value();
  }

  std::optional<FluidEnd> link;
  std::optional<BulkGrid> grid;
  json particles;
  if (paired) {
    const BulkGridParameters& box = *parameters.bulk_grid;
    link.emplace(world, box.cells, parameters.coupling.time_out);
    particles =
        meet_partner(options, parameters, facts, case_gravity(args), start ? start->checksum : "no", *link);
    add_particle_facts(facts, particles);
    grid.emplace(box.lower, box.upper, box.cells, particles.at("periodic"));
  }
  const Scene scene =
      plan_scene(parameters.scene, facts, parameters.forces, parameters.coupling.phase_interchange);
  if (link)
    link->send_plan(plan_windows(
        parameters, scene, particles.at("time_step"),
        start ? RunBegin{start->time, true, start->window} : RunBegin{case_time(args).startTime().value()}));

  run_stage().set("reading the fluid case");
  Foam::instant from;
  if (start) from = {start->time, start->fluid_time};
  const std::unique_ptr<Flow> flow = open_flow(
      args, scene, refinement.parameters ? &*refinement.parameters : nullptr, start ? &from : nullptr);
  install_signal_handlers();
  if (parameters.gravity) flow->gravity = *parameters.gravity;
  const double step = longest_step(*flow, paired ? parameters.coupling.longest_window() : 0);
  require_solvers(*flow, step);
  const auto say = [&flow](const std::vector<std::string>& advice) {
    flow->scene.advice.insert(flow->scene.advice.end(), advice.begin(), advice.end());
  };
  say(fluid_advice(*flow, refinement, paired, options.continues, case_gravity(args), facts.surface_tension,
                   step, world.size()));
  if (paired) say(pair_advice(*flow, parameters, *grid, particles, options.continues));
  if (options.check) {
    show_check(*flow, options, parameters, facts, grid, particles, step, world.rank());
    if (link) link->close();
    return exit_done;
  }

  RunRecord record(options, parameters, flow->scene, particles, world.rank(), world.size());
  RunStatus status =
      link ? run_pair(*flow, options, parameters, start ? &*start : nullptr, *grid, *link, world, record)
           : run_alone(*flow, parameters, record);
  status = record.finish(*flow, status);
  if (link) link->close();
  return status == RunStatus::completed ? exit_done : exit_failed;
}

}  // namespace

int run_fluid(const ProgramOptions& options, const OwnWorld& world) {
  try {
    return run_case(options, world);
  } catch (const Foam::error& error) {
    const std::string said = said_by(error, options.out / "fluid");
    if (run_stage().time() > 0) throw RunError(said);
    throw InputError(said);
  }
}

}  // namespace demvof
