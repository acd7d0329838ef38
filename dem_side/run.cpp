// SPDX-License-Identifier: GPL-3.0-or-later
#include "dem_side/run.hpp"

#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>

#include "coupler/base/stopwatch.hpp"
#include "coupler/config/read_case.hpp"
#include "coupler/exchange/momentum_exchange.hpp"
#include "coupler/link/failure.hpp"
#include "coupler/link/handshake_items.hpp"
#include "coupler/link/link.hpp"
#include "coupler/link/run_stage.hpp"
#include "coupler/link/signals.hpp"
#include "coupler/output/machine.hpp"
#include "coupler/output/output_due.hpp"
#include "coupler/output/restart_point.hpp"
#include "coupler/transfer/averaging.hpp"
#include "dem_side/dem.hpp"
#include "dem_side/forces.hpp"
#include "dem_side/output.hpp"
#include "dem_side/particle_grid.hpp"
#include "dem_side/replacement.hpp"
#include "dem_side/report.hpp"
#include "dem_side/restart.hpp"
#include "dem_side/survivor.hpp"
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

std::string facts(const Dem& dem, const Averaging& averaging, const OwnWorld& world) {
  const ParticleCensus census = dem.census();
  const ContactTimes contacts = dem.contact_times();
  const Vec3 momentum = half_step_momentum(dem);
  return nlohmann::json{{"particle_count", census.count},
                        {"min_diameter", census.min_diameter},
                        {"max_diameter", census.max_diameter},
                        {"solid_volume", census.solid_volume},
                        {"inserts_particles", dem.inserts_particles()},
                        {"time_step", dem.time_step()},
                        {"periodic", dem.domain().periodic},
                        {"collision_time", contacts.collision},
                        {"rayleigh_time", contacts.rayleigh},
                        {"lightest_response", census.lightest_response},
                        {"largest_solid_fraction", averaging.largest_solid_fraction()},
                        {"momentum", {momentum.x, momentum.y, momentum.z}},
                        {"ranks", world.size()}}
      .dump();
}

}  // namespace

int run_particles(const ProgramOptions& options, const OwnWorld& world) {
  const CaseParameters parameters = read_case(options.case_file, options.overrides);
  const CouplingParameters& coupling = parameters.coupling;
  const fs::path script =
      fs::absolute(beside_case_file(parameters, particle_parameters(parameters).script)).lexically_normal();
  fs::create_directories(options.out);
  std::optional<RestartPoint> start;
  if (options.continues) {
    start = read_restart_point(options.out, parameters);
    if (world.rank() == 0) keep_earlier(options.out, "particles.log");
  }
  const long windows_before = start ? start->window : 0;
  Survivor survivor(options, parameters, world);

  run_stage().set("particle script");
  Dem dem(world.comm(), script, options.out / "particles.log",
          start ? restart_file(options.out, start->window) : fs::path());
  install_signal_handlers();
  const int steps = steps_per_window(coupling.window, dem.time_step());
  FluidForces forces(dem, parameters.forces);
  std::optional<Replacement> replacement;
  if (coupling.phase_interchange == PhaseInterchange::replacement)
    replacement.emplace(dem, coupling.interchange_speed);
  if (start)
    forces.go_on_from(coupling.window, steps_of_continued(options.out, start->window, dem, script.string()));
  dem.set_up();
  const BulkGrid grid = particle_grid(*parameters.bulk_grid, dem);
  const AveragingParameters averaged = with_bandwidth(coupling.averaging, dem.census().max_diameter);

  if (parameters.forces.own_wake != OwnWake::none)
    forces.take_out_own_wake(WakeWidth(grid, averaged), dem.census().max_diameter);

  run_stage().set("handshake");
  Link link(world, grid.cell_count(), coupling.time_out);
  Averaging averaging(world.comm(), grid, link.mine(), averaged);
  const auto deposit_at_their_places = [&](const std::vector<BulkParticles>& contributions) {
    averaging.deposit(positions(dem.particles()), radii(dem.particles()), contributions);
  };
  deposit_at_their_places(forces.contributions());
  const auto fluid_facts = nlohmann::json::parse(
      link.handshake(handshake_items(version(), configuration_hash(parameters), dem.gravity()),
                     facts(dem, averaging, world)));
  if (!fluid_facts.value("two_fluids", false)) replacement.reset();  // there is no interface
  if (options.check) {
    link.close();
    return exit_done;
  }

  run_stage().set("first exchange");
  averaging.set_open_shares(link.receive<double>());
  double replaced_volume = 0;  // m3, of this rank
  const auto deposit = [&] {
    std::vector<BulkParticles> contributions = forces.contributions();
    if (replacement) replaced_volume = replacement->leave_out_replaced(contributions);
    deposit_at_their_places(contributions);
    CellValues<BulkParticles> deposited = averaging.deposited();
    if (hands_back_left_over(coupling.exchange))  // uses responses
      count_support(averaging.deposit_records(forces.support()), deposited);
    return deposited;
  };
  CellValues<BulkParticles> deposited = deposit();
  Report report(dem);
  survivor.start(report.count());
  Output output(dem, grid, options.out, start ? std::optional(start->time) : std::nullopt);
  if (!start) output.write(0, coupling.window, forces, averaging, {});
  WallSeconds seconds;
  link.send(deposited);
  link.swap_text(report.window(forces, averaging, replaced_volume, seconds));

  const long windows = std::lround(coupling.end_time / coupling.window);
  bool go_on = true;
  for (long n = windows_before + 1; n <= windows && go_on; ++n) {
    run_stage().set("exchange with the fluid", static_cast<double>(n - 1) * coupling.window);
    const auto fluid = link.receive<BulkFluid>();  // at the start of this window, whatever the schedule
    std::optional<CellValues<BulkFluidGradients>> gradients;
    if (need_gradients(parameters.forces)) gradients = link.receive<BulkFluidGradients>();
    {
      const Stopwatch watch(seconds.averaging);
      forces.begin_window(averaging.sample(fluid, gradients ? &*gradients : nullptr), coupling.window);
    }
    if (replacement)
      replacement->begin_window(averaging.sample_records(link.receive<BulkInterface>()), coupling.window);
    run_stage().set("DEM steps");
    {
      const Stopwatch watch(seconds.dem);
      dem.run(steps);
    }
    const double time = static_cast<double>(n) * coupling.window;
    run_stage().set("end of the window", time);
    {
      const Stopwatch watch(seconds.averaging);
      deposited = deposit();
    }
    link.send(deposited);
    if (replacement) link.send(replacement->droplets(grid, link.mine()));
    seconds.exchange = link.statistics().exchange_seconds;
    seconds.waiting = link.statistics().waiting_seconds;
    link.swap_text(report.window(forces, averaging, replaced_volume, seconds));
    go_on = link.agree_to_continue(stop_requested() ? Continue::stop_requested : Continue::run);

    survivor.window(n - windows_before, (n - windows_before) * steps, report.count(), seconds.dem,
                    seconds.waiting);
    if (n < windows && go_on && !output_due(n, coupling.window, parameters.output.interval)) continue;
    run_stage().set("output", time);
    output.write(time, coupling.window, forces, averaging, fluid);
    write_particle_restart(options.out, n, dem, steps);
    link.swap_text("{}");  // both sides have written
  }
  link.close();
  return go_on ? exit_done : exit_failed;
}

}  // namespace demvof
