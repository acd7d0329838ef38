// SPDX-License-Identifier: GPL-3.0-or-later
#include "foam_side/run.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>

#include "coupler/base/stopwatch.hpp"
#include "coupler/config/read_case.hpp"
#include "coupler/link/fluid_end.hpp"
#include "coupler/link/handshake_items.hpp"
#include "coupler/link/run_stage.hpp"
#include "coupler/link/signals.hpp"
#include "coupler/output/machine.hpp"
#include "coupler/output/restart_point.hpp"
#include "coupler/output/run_lock.hpp"
#include "coupler/scene/plan_windows.hpp"
#include "foam_side/balance_mesh.hpp"
#include "foam_side/bridge.hpp"
#include "foam_side/case_numbers.hpp"
#include "foam_side/case_sources.hpp"
#include "foam_side/divided_cells.hpp"
#include "foam_side/extras.hpp"
#include "foam_side/first_look.hpp"
#include "foam_side/fluid_books.hpp"
#include "foam_side/fluid_case.hpp"
#include "foam_side/mesh_ends.hpp"
#include "foam_side/numbers_of_case.hpp"
#include "foam_side/pressure_solver.hpp"
#include "foam_side/replacement.hpp"
#include "foam_side/restart.hpp"
#include "foam_side/run_record.hpp"
#include "foam_side/said_by.hpp"
#include "foam_side/scene_facts.hpp"
#include "foam_side/step_fluid.hpp"
#include "foam_side/step_limits.hpp"

namespace demvof {

namespace {

namespace fs = std::filesystem;
using nlohmann::json;

/// What flowed and acted in the window or step just done.
void enter_books(Flow& flow, FluidReport& report) {
  const FluidBooks books = take_books(flow);
  report.liquid_volume = liquid_volume(flow);
  report.liquid_in = books.liquid_in;
  if (!flow.source) return;
  report.momentum = fluid_momentum(flow);
  report.outside.fluid_weight = books.weight;
  report.outside.boundary_pressure = books.boundary_pressure;
  report.outside.boundary_shear = books.boundary_shear;
  report.outside.carried_in = books.carried_in;
  report.outside.surface_tension = books.surface_tension;
  report.outside.sources = books.sources;
}

RunStatus run_pair(Flow& flow, const ProgramOptions& options, const CaseParameters& parameters,
                   const RestartPoint* start, const BulkGrid& grid, FluidEnd& link, const OwnWorld& world,
                   RunRecord& record) {
  const double end_time = parameters.coupling.end_time;
  FluidSeconds seconds;

  run_stage().set("first void fraction");
  Bridge bridge(flow, parameters, grid, link.mine(), world.comm());
  ParticlesToFine& to_fine = bridge.particles_to_fine();
  SurfaceToBulk& surface = bridge.surface_to_bulk();
  const json saved = start ? read_fluid_restart(options.out, *start, flow, link.mine(), world) : json();
  if (flow.scene.two_fluids && start)
    surface.go_on_from(seen_surface(saved));
  else if (flow.scene.two_fluids)
    surface.news();  // all of it
  if (start) bridge.openings_to_bulk().go_on_from(seen_openings(saved));
  FluidEnd::Start first = link.start(bridge.openings_to_bulk().told(), surface.seen());
  bridge.take(std::move(first.particles));
  const bool own_lengths = link.plan().own_lengths();
  StepRange range;
  if (own_lengths) range = step_range(*parameters.coupling.adaptive_window, link.plan().steps.length);
  WindowSteps steps{range.shortest, range.shortest};
  if (start) {
    steps = go_on_from(saved, start->window, flow, bridge, record, first.report);
    if (own_lengths) bridge.set_window(static_cast<double>(steps.last) * link.plan().steps.length);
    if (world.rank() == 0) go_back_to(options.out, *start);
  } else {
    if (flow.porosity) {
      set_solid_velocity(flow, to_fine.solid_velocity());
      set_initial_porosity(flow, to_fine.void_fraction());
    }
    if (flow.ghost) set_initial_ghost(flow, to_fine.void_fraction());
    const double window =
        own_lengths ? static_cast<double>(range.shortest) * link.plan().steps.length : link.plan().window;
    const double begin = link.end_time();
    const bool other_gravity = norm(set_gravity(flow, flow.gravity.mean(begin, begin + window))) > 0;
    if (other_gravity || pressure_says_nothing(flow)) balance_pressure(flow);
    record.start(flow, &first.report, link.number());
    write_fields(flow);
  }
  flow.time.setEndTime(end_time +
                       parameters.coupling.longest_window());  // the windows end the run, not controlDict
  flow.time.write_when_told();

  const bool replaces = link.plan().interface;
  ReplacementBooks replacement;
  std::vector<Droplet> droplets;
  const auto solid_fraction_of = [&to_fine](const Vec3& position, double volume) {
    return to_fine.solid_fraction_of(position, volume);
  };
  const auto fluid_message = [&] {
    const Stopwatch watch(seconds.mapping);
    FluidMessage fluid;
    if (link.plan().mesh_moves) fluid.openings = bridge.openings_to_bulk().look();
    if (flow.scene.two_fluids) fluid.surface = bridge.surface_to_bulk().news();
    fluid.means = bridge.bulk_fluids();
    if (link.plan().gradients) fluid.gradients = bridge.bulk_fluid_gradients();
    if (replaces) fluid.interface = bridge.fluid_to_bulk().interface();
    return fluid;
  };
  const auto take = [&](ParticleMessage particles) {
    if (replaces) droplets = on_every_rank(particles.droplets->values);
    const Stopwatch watch(seconds.mapping);
    bridge.take(std::move(particles.sums));
  };
  const auto advance = [&] {
    {
      const Stopwatch watch(seconds.fluid);
      begin_window(flow, link.end_time());
      replace_particles(
          flow, droplets, solid_fraction_of,
          [&bridge](const Vec3& position, const Vec3& impulse) { return bridge.owe(position, impulse); },
          replacement);
      to_fine.note(droplets);
      to_fine.spread_sources();  // the flux is fitted to the new window with its drag
      if (flow.porosity) {
        set_solid_velocity(flow, to_fine.solid_velocity());
        set_porosity_target(flow, to_fine.void_fraction());
      }
      if (flow.ghost) set_ghost_target(flow, to_fine.void_fraction(), to_fine.solid_flux_density());
      while (step_fluid(flow, &bridge)) {
      }
    }
    run_stage().set("end of the window", flow.time.value());
    bridge.end_window();
  };

  while (link.next_window()) {
    run_stage().set("exchange with the particles", flow.time.value());
    if (own_lengths) {
      link.set_steps(steps.next);
      bridge.set_window(link.window_length());
    }
    bridge.follow_gravity(flow.gravity.mean(link.begin_time(), link.end_time()));
    link.window(fluid_message(), advance, take);
    RunRecord::Window done;
    done.number = link.number();
    done.planned = link.plan().windows;
    done.fluid.explicit_impulse = to_fine.impulses().explicit_part;
    done.fluid.implicit_impulse = to_fine.impulses().implicit_part;
    done.fluid.kept_left_over = bridge.kept_left_over();
    if (flow.porosity) done.fluid.fine_solid_volume = to_fine.spread().solid_volume;
    done.negative_cells = to_fine.spread().negative_cells;
    done.full_cells = to_fine.spread().full_cells;
    enter_books(flow, done.fluid);
    const Bridge::PressureImpulses pressure = bridge.pressure_impulses();
    done.fluid.seen_pressure = pressure.seen;
    done.fluid.owed_pressure = pressure.owed;
    done.fluid.returned_pressure = pressure.returned;
    done.fluid.returned_turnover = pressure.turnover;
    done.held_back = pressure.held_back;
    done.fluid.outside.surface_tension += pressure.tension;
    done.fluid.outside.smeared_weight = pressure.smeared_weight;
    if (replaces) {
      done.replacement = replacement;
      done.fluid.replaced_liquid = replacement.liquid();
      done.fluid.replacement_impulse = replacement.from_outside;
    }
    done.active_cells = static_cast<long>(bridge.active_cells());
    done.relaxation = bridge.relaxed().smallest;
    done.relaxed_cells = bridge.relaxed().cells;
    done.particles = link.close_window();
    if (own_lengths) {
      const Stopwatch watch(seconds.mapping);
      done.length = link.window_length();
      done.change = bridge.change(done.particles->max_speed);
      done.error = window_error(done.change, parameters.coupling.adaptive_window->tolerance);
      // One cut short by an output says what the next would have come to.
      const double part = static_cast<double>(link.steps()) / static_cast<double>(steps.next);
      steps = {link.steps(), steps_of_next_window(steps.next, done.error / part, range)};
    }
    seconds.waiting = link.statistics().waiting_seconds;
    seconds.exchange = link.statistics().exchange_seconds;
    done.seconds = seconds;
    done.exchanged_bytes = link.statistics().bytes_sent + link.statistics().bytes_received;
    done.exchanged_cells = link.statistics().cells_sent + link.statistics().cells_received;
    require_whole_log();
    record.window(flow, done, end_time);
    if (link.writes())
      write_state(options.out, parameters, link.number(), flow, bridge, record, steps, link, world);
  }
  return link.done() ? RunStatus::completed : RunStatus::interrupted;
}

/// Plain VOF: steps and output times as in controlDict, like interFoam, to the case file's end time.
RunStatus run_alone(Flow& flow, const CaseParameters& parameters, RunRecord& record) {
  if (parameters.coupling.end_time > 0) flow.time.setEndTime(parameters.coupling.end_time);
  set_gravity(flow, flow.gravity.at(flow.time.value()));
  FluidSeconds seconds;
  record.start(flow, nullptr);
  bool go_on = true;
  for (long n = 1; go_on; ++n) {
    {
      const Stopwatch watch(seconds.fluid);
      if (!step_fluid(flow, nullptr)) return RunStatus::completed;
    }
    RunRecord::Window done;
    done.number = n;
    enter_books(flow, done.fluid);
    done.seconds = seconds;
    require_whole_log();
    record.window(flow, done, flow.time.endTime().value());
    go_on = !Foam::returnReduce(stop_requested(), Foam::orOp<bool>());
  }
  write_fields(flow);
  return RunStatus::interrupted;
}

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

int run_case(const ProgramOptions& options, const OwnWorld& world) {
  const CaseParameters parameters = read_case(options.case_file, options.overrides);
  const bool paired = parameters.particles && parameters.scene.particles != Switch::off;
  std::optional<RunLock> lock;
  if (world.rank() == 0) lock.emplace(options.out, RunLock::Part::fluid);
  std::optional<RestartPoint> start;
  if (options.continues) {
    if (!paired)
      throw InputError("--continue: only runs with particles; foam_side alone starts where controlDict says");
    start = open_state(options, parameters, world);
    if (world.rank() == 0) keep_earlier(options.out, "fluid.log");
  }
  send_output_to(options.out / "fluid.log", world.rank());
  std::optional<RefinementParameters> refinement = parameters.fluid.refinement;
  if (refinement && start && !fs::exists(options.out / "fluid" / "constant" / "dynamicMeshDict"))
    throw InputError("--continue: fluid.refinement was not given in the run; remove it, or start a new run");
  if (refinement && world.rank() == 0) write_mesh_dictionary(options.out / "fluid", *refinement);
  if (!paired && world.partner_size() > 0)
    throw InputError(parameters.file + ": the run is made without particles, but dem_side was started, too");
  const Foam::argList& args = *open_case(options.out / "fluid", world);
  install_signal_handlers();  // OpenFOAM has set its own
  require_numbers_that_can_be(case_time(args), paired);
  SceneFacts facts = fluid_facts(args);
  const bool refined_by_case = paired && !refinement;
  if (refined_by_case) refinement = take_refinement_of_case(case_time(args));

  std::optional<FluidEnd> link;
  std::optional<BulkGrid> grid;
  json particles;
  if (paired) {
    run_stage().set("handshake");
    const BulkGridParameters& box = *parameters.bulk_grid;
    grid.emplace(box.lower, box.upper, box.cells);
    link.emplace(world, grid->cells(), parameters.coupling.time_out);
    particles = json::parse(
        link->handshake(handshake_items(version(), configuration_hash(parameters), case_gravity(args),
                                        options.out, start ? start->checksum : "no", parameters.gravity),
                        facts_as_json(facts).dump()));
    add_particle_facts(facts, particles);
    grid.emplace(box.lower, box.upper, box.cells, particles.at("periodic"));
  }
  Scene scene = plan_scene(parameters.scene, facts, parameters.forces, parameters.coupling.phase_interchange);
  if (link)
    link->send_plan(plan_windows(
        parameters, scene, particles.at("time_step"),
        start ? RunBegin{start->time, true, start->window} : RunBegin{case_time(args).startTime().value()}));

  run_stage().set("reading the fluid case");
  Foam::instant from;
  if (start) from = {start->time, start->fluid_time};
  const std::unique_ptr<Flow> flow =
      open_flow(args, scene, refinement ? &*refinement : nullptr, start ? &from : nullptr);
  install_signal_handlers();
  if (parameters.gravity) flow->gravity = *parameters.gravity;
  const double step = longest_step(*flow, paired ? parameters.coupling.longest_window() : 0);
  require_solvers(*flow, step);
  const std::string forget = sources_that_forget(*flow);
  if (start && !forget.empty()) throw InputError("--continue: " + forget + "; start a new run");
  for (const std::string& said :
       {slope_without_effect(flow->mesh, flow->gravity),
        gravity_that_jumps(case_gravity(args), flow->gravity, case_time(args).startTime().value()),
        slow_pressure_solver(*flow), pimple_by_default(flow->mesh), paired ? forget : "",
        paired ? unknown_sources(*flow) : ""})
    if (!said.empty()) scene.advice.push_back(said);
  if (refinement && world.size() > 1 && cells_stay(flow->mesh))
    scene.advice.emplace_back(
        "fluid.refinement: the mesh has cyclic patches, and cells stay on their ranks, however many of them "
        "there are (max_imbalance)");
  if (refinement && refined_by_case) {
    if (scene.interchange == PhaseInterchange::volume_adding ||
        scene.interchange == PhaseInterchange::replacement)
      throw InputError(
          "constant/dynamicMeshDict: dynamicRefineFvMesh: coupling.phase_interchange: volume_adding needs a "
          "mesh that stays as it is, replacement one that is fine wherever a particle may become liquid: "
          "remove "
          "the file, and for the latter write a section fluid.refinement with particles: true");
    scene.advice.push_back(refined_as_of_case(*refinement));
  }
  if (paired) {
    require_mesh_fits(*grid, flow->mesh, start && scene.mesh_moves);
    if (const std::string said = walls_inside_bulk_cells(flow->mesh, *grid); !said.empty())
      scene.advice.push_back(said);
    if (const auto& unseen = parameters.particles->unseen_surfaces; !unseen.empty())
      scene.advice.push_back(
          fmt::format("The fluid does not see what fix {} moves: it flows through there, and is moved by "
                      "particles alone (docs/warnings.md, Unseen surfaces)",
                      fmt::join(unseen, ", ")));
    if (!start)
      for (const std::string& said : first_look(parameters, *flow, *grid, particles))
        scene.advice.push_back(said);
    require_same_motion(*flow, particles.value("moved_surfaces", std::vector<std::string>()));
  }
  if (flow->porosity && facts.inserts_particles && flow->p_rgh.needReference())
    throw InputError(
        "the script puts particles in during the run, and the fluid's box is closed: no patch fixes p_rgh, "
        "so that "
        "the fluid has nowhere to go; give the case an opening, or scene.porosity: off");
  if (scene.interchange == PhaseInterchange::replacement)
    require_mesh_resolves_particles(flow->mesh, particles.at("min_diameter"));
  flow->scene.advice = scene.advice;
  if (options.check) {
    try_step(*flow, step, options.out / "fluid");
    const ResolvedNumbers numbers =
        resolved_numbers(parameters, *flow, facts.surface_tension, grid, particles);
    if (world.rank() == 0) {
      fmt::print("{}\n{}", scene_table(scene.decisions), numbers_table(numbers));
      for (const std::string& advice : scene.advice) fmt::print("beware: {}\n", advice);
    }
    if (link) link->close();
    return exit_done;
  }

  RunRecord record(options, parameters, scene, particles, world.rank(), world.size());
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
