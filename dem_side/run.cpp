// SPDX-License-Identifier: GPL-3.0-or-later
#include "dem_side/run.hpp"

#include <optional>

#include "coupler/config/read_case.hpp"
#include "coupler/link/failure.hpp"
#include "coupler/link/handshake_items.hpp"
#include "coupler/link/particle_end.hpp"
#include "coupler/link/run_stage.hpp"
#include "coupler/link/signals.hpp"
#include "coupler/output/restart_point.hpp"
#include "coupler/output/run_lock.hpp"
#include "dem_side/dem.hpp"
#include "dem_side/fallback_results.hpp"
#include "dem_side/forces.hpp"
#include "dem_side/handshake_facts.hpp"
#include "dem_side/particle_grid.hpp"
#include "dem_side/possible_particles.hpp"
#include "dem_side/replacement.hpp"
#include "dem_side/restart.hpp"
#include "dem_side/run_pair.hpp"
#include "dem_side/window_steps.hpp"

namespace demvof {
namespace {

namespace fs = std::filesystem;

const ParticleParameters& particle_parameters(const CaseParameters& parameters) {
  if (parameters.particles && parameters.scene.particles != Switch::off) return *parameters.particles;
  throw InputError(
      parameters.file +
      ": particles: not given or switched off, so dem_side has nothing to do; start foam_side alone");
}

void require_steps_to_fit(const CouplingParameters& coupling, double time_step) {
  if (coupling.adaptive_window)
    require_whole_steps(coupling.end_time, time_step);
  else
    steps_per_window(coupling.window, time_step);
}

/// Sets the particles up, from the script's start or from a state. Collective.
void set_up(Dem& dem, FluidForces& forces, const CouplingParameters& coupling, const RestartPoint* start,
            const fs::path& out, const std::string& script) {
  if (!start) {
    dem.set_up();
    require_room_for_each(dem, script);
    return;
  }
  const LastParticles last = read_particle_restart(out, start->window, dem, script);
  forces.go_on_from(coupling.adaptive_window ? last.steps * dem.time_step() : coupling.window, last.steps);
  dem.set_up();
  dem.go_on_from(last.random);
}

}  // namespace

int run_particles(const ProgramOptions& options, const OwnWorld& world) {
  const CaseParameters parameters = read_case(options.case_file, options.overrides);
  const CouplingParameters& coupling = parameters.coupling;
  const fs::path script =
      fs::absolute(beside_case_file(parameters, particle_parameters(parameters).script)).lexically_normal();
  fs::create_directories(options.out);
  std::optional<RunLock> lock;
  if (world.rank() == 0) lock.emplace(options.out, RunLock::Part::particles);
  std::optional<RestartPoint> start;
  if (options.continues) {
    start = open_state(options, parameters, world);
    if (world.rank() == 0) keep_earlier(options.out, "particles.log");
  }
  FallbackResults fallback_results(options, parameters, world);

  run_stage().set("particle script");
  Dem dem(world.comm(), script, options.out / "particles.log",
          start ? restart_file(options.out, start->window) : fs::path());
  install_signal_handlers();
  require_possible_particles(dem.particles(), world.comm(), script.string());
  if (parameters.gravity) dem.set_gravity(parameters.gravity->at(0));
  require_steps_to_fit(coupling, dem.time_step());
  FluidForces forces(dem, parameters.forces);
  std::optional<Replacement> replacement;  // has rows of its own in a state
  if (coupling.phase_interchange == PhaseInterchange::replacement)
    replacement.emplace(dem, coupling.interchange_speed);
  set_up(dem, forces, coupling, start ? &*start : nullptr, options.out, script.string());

  const BulkGrid grid = particle_grid(*parameters.bulk_grid, dem);
  const double largest_diameter = dem.census().max_diameter;
  const AveragingParameters averaging = with_bandwidth(coupling.averaging, largest_diameter);
  if (parameters.forces.own_wake != OwnWake::none)
    forces.take_out_own_wake(WakeWidth(grid, averaging), largest_diameter);

  run_stage().set("handshake");
  ParticleEnd link(world, grid.cells(), coupling.time_out);
  PairedParticles pair(dem, forces, grid, averaging, parameters, link, world);
  link.handshake(handshake_items(version(), configuration_hash(parameters), dem.script_gravity(), options.out,
                                 start ? start->checksum : "no", parameters.gravity),
                 handshake_facts(dem, forces, pair.largest_solid_fraction(),
                                 particle_parameters(parameters).unseen_surfaces, world.size()));
  link.receive_plan();
  if (!options.check)
    pair.run(replacement ? &*replacement : nullptr, options.out,
             start ? std::optional(start->time) : std::nullopt, fallback_results);
  link.close();
  return options.check || link.done() ? exit_done : exit_failed;
}

}  // namespace demvof
