// SPDX-License-Identifier: GPL-3.0-or-later
#include "dem_side/run.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <optional>

#include "coupler/base/mpi_check.hpp"
#include "coupler/base/stopwatch.hpp"
#include "coupler/config/read_case.hpp"
#include "coupler/exchange/momentum_exchange.hpp"
#include "coupler/link/failure.hpp"
#include "coupler/link/handshake_items.hpp"
#include "coupler/link/particle_end.hpp"
#include "coupler/link/run_stage.hpp"
#include "coupler/link/signals.hpp"
#include "coupler/output/machine.hpp"
#include "coupler/output/restart_point.hpp"
#include "coupler/output/run_lock.hpp"
#include "coupler/transfer/averaging.hpp"
#include "dem_side/dem.hpp"
#include "dem_side/fallback_results.hpp"
#include "dem_side/forces.hpp"
#include "dem_side/output.hpp"
#include "dem_side/particle_grid.hpp"
#include "dem_side/possible_particles.hpp"
#include "dem_side/replacement.hpp"
#include "dem_side/report.hpp"
#include "dem_side/restart.hpp"
#include "dem_side/size_mix.hpp"
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

/// Those that walls of the fluid have to go along with: "name (style)".
std::vector<std::string> surfaces_of_both(const std::vector<MovedSurface>& moved,
                                          const std::vector<std::string>& unseen) {
  std::vector<std::string> names, both;
  for (const auto& [fix, style] : moved) {
    names.push_back(fix);
    if (std::find(unseen.begin(), unseen.end(), fix) == unseen.end())
      both.push_back(fmt::format("{} ({})", fix, style));
  }
  for (const std::string& fix : unseen)
    if (std::find(names.begin(), names.end(), fix) == names.end())
      throw InputError(
          fmt::format("particles.unseen_surfaces: {}: no fix of this name moves a surface of the script{}{}",
                      fix, names.empty() ? "" : "; it has ", fmt::join(names, ", ")));
  return both;
}

std::string facts(const Dem& dem, const FluidForces& forces, const Averaging& averaging,
                  const std::vector<std::string>& moved_surfaces, const OwnWorld& world) {
  std::vector<std::string> closures;  // in the order of ParticleReport::closures
  for (const auto& [name, count] : forces.closures()) closures.push_back(name);

  const ParticleCensus census = dem.census();
  const ContactTimes contacts = dem.contact_times();
  const Vec3 momentum = half_step_momentum(dem);
  return nlohmann::json{{"particle_count", census.whole},
                        {"min_diameter", census.min_diameter},
                        {"max_diameter", census.max_diameter},
                        {"solid_volume", census.solid_volume},
                        {"inserts_particles", dem.inserts_particles()},
                        {"moved_surfaces", moved_surfaces},
                        {"time_step", dem.time_step()},
                        {"periodic", dem.domain().periodic},
                        {"collision_time", contacts.collision},
                        {"rayleigh_time", contacts.rayleigh},
                        {"lightest_response", census.lightest_response},
                        {"lightest_particle", census.lowest_density},
                        {"largest_solid_fraction", averaging.largest_solid_fraction()},
                        {"closures", closures},
                        {"momentum", {momentum.x, momentum.y, momentum.z}},
                        {"ranks", world.size()}}
      .dump();
}

bool any_rank(bool here, const OwnWorld& world) {
  int any = here;
  check_mpi(MPI_Allreduce(MPI_IN_PLACE, &any, 1, MPI_INT, MPI_MAX, world.comm()), "MPI_Allreduce");
  return any != 0;
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
  int steps = 0;  // of a window
  if (coupling.adaptive_window)
    require_whole_steps(coupling.end_time, dem.time_step());
  else
    steps = steps_per_window(coupling.window, dem.time_step());
  FluidForces forces(dem, parameters.forces);
  std::optional<Replacement> replacement;
  if (coupling.phase_interchange == PhaseInterchange::replacement)
    replacement.emplace(dem, coupling.interchange_speed);
  std::optional<LastParticles> last;
  if (start) {
    last = read_particle_restart(options.out, start->window, dem, script.string());
    forces.go_on_from(coupling.adaptive_window ? last->steps * dem.time_step() : coupling.window,
                      last->steps);
  }
  dem.set_up();
  if (last) dem.go_on_from(last->random);
  const BulkGrid grid = particle_grid(*parameters.bulk_grid, dem);
  const AveragingParameters averaged = with_bandwidth(coupling.averaging, dem.census().max_diameter);

  if (parameters.forces.own_wake != OwnWake::none)
    forces.take_out_own_wake(WakeWidth(grid, averaged), dem.census().max_diameter);

  const std::vector<std::string> moved_surfaces =
      surfaces_of_both(dem.moved_surfaces(), particle_parameters(parameters).unseen_surfaces);
  run_stage().set("handshake");
  ParticleEnd link(world, grid.cells(), coupling.time_out);
  Averaging averaging(world.comm(), grid, link.mine(), averaged);
  std::vector<double> radii_of_wholes;  // where there are clumps
  const auto weigh = [&] {
    const ParticleArrays particles = dem.particles();
    Spheres places = spheres(particles);
    if (dem.has_clumps()) {
      radii_of_wholes = whole_radii(particles);
      places.radius = radii_of_wholes.data();
    }
    averaging.weigh(places);
  };
  weigh();
  averaging.in(0).deposit(forces.contributions());
  link.handshake(handshake_items(version(), configuration_hash(parameters), dem.script_gravity(), options.out,
                                 start ? start->checksum : "no", parameters.gravity),
                 facts(dem, forces, averaging, moved_surfaces, world));
  const WindowPlan& plan = link.receive_plan();
  if (!plan.interface) replacement.reset();
  if (options.check) {
    link.close();
    return exit_done;
  }

  run_stage().set("first exchange");
  averaging.set_openings(link.openings());
  if (plan.fluids > 1) averaging.see(link.surface());
  const auto surface_at_particles = [&] { return averaging.surface_at(spheres(dem.particles())); };
  double replaced_volume = 0;  // m3, of this rank
  const auto deposit = [&] {
    weigh();
    if (plan.fluids > 1 && any_rank(forces.waiting_for_fluid() > 0, world))
      forces.see_surface(surface_at_particles());
    std::vector<CellValues<BulkParticles>> by_fluid;
    replaced_volume = 0;
    for (int k = 0; k < averaging.fluids(); ++k) {
      const auto contribution = [&, of = forces.contributions(k), keep = forces.keep_to(k)](int i) {
        if (plan.fluids > 1 && !averaging.in(1 - k).reached_by(i)) keep(i);
        BulkParticles here = of(i);
        if (replacement) replaced_volume += replacement->leave_out_replaced(i, here);
        return here;
      };
      AveragingInFluid& in = averaging.in(k);
      if (hands_back_left_over(coupling.exchange)) {  // uses responses
        const auto support = in.deposit_with<Support>([&contribution, of = forces.support(k)](int i) {
          return AveragingInFluid::With<Support>{contribution(i), of(i)};
        });
        by_fluid.push_back(in.deposited());
        count_support(support, by_fluid.back());
      } else {
        by_fluid.push_back(in.deposit(contribution));
      }
    }
    return by_fluid;
  };
  const std::vector<CellValues<BulkParticles>> deposited = deposit();
  Report report(dem);
  fallback_results.start(report.count());
  Output output(dem, grid, options.out, start ? std::optional(start->time) : std::nullopt);
  if (!start) output.write(0, coupling.longest_window(), forces, averaging, {});
  WallSeconds seconds;
  link.start(deposited, report.window(forces, averaging, replaced_volume, seconds));

  long dem_steps = 0;  // done here
  while (link.next_window()) {
    run_stage().set("exchange with the fluid", link.begin_time());
    const FluidMessage fluid = link.fluid();
    const double window = link.window_length();
    if (plan.own_lengths()) steps = static_cast<int>(link.steps());
    if (parameters.gravity) dem.set_gravity(parameters.gravity->mean(link.begin_time(), link.end_time()));
    FluidsAtParticles felt;
    {
      const Stopwatch watch(seconds.averaging);
      for (int k = 0; k < plan.fluids; ++k)
        felt.fluid[k] =
            averaging.in(k).sample(fluid.means[k], plan.gradients ? &fluid.gradients[k] : nullptr);
      if (plan.fluids > 1) {
        averaging.see(fluid.surface);
        felt.surface = surface_at_particles();
      }
      if (fluid.openings) averaging.set_openings(*fluid.openings);  // for what they do in this window
      forces.begin_window(felt, window);
      for (int k = 0; k < plan.fluids && knows_sizes(parameters.forces.drag); ++k)
        forces.tell_sizes(k, sizes_around(dem.particles(), forces, k, averaging.in(k)));
    }
    if (replacement)
      replacement->begin_window(averaging.in(0).sample_records(*fluid.interface), felt.fluid[0], window);
    if (link.number() == 1) {
      forces.first_half_step();  // the fluid is known now
      if (plan.schedule == Schedule::concurrent) {
        ParticleMessage expected;
        for (int k = 0; k < averaging.fluids(); ++k)
          expected.sums.push_back(averaging.in(k).deposit(forces.expected_contributions(k)));
        if (replacement) expected.droplets.emplace();
        link.send(expected);
      }
    }
    run_stage().set("DEM steps");
    {
      const Stopwatch watch(seconds.dem);
      dem.run(steps);
    }
    const double time = link.end_time();
    run_stage().set("end of the window", time);
    ParticleMessage done;
    {
      const Stopwatch watch(seconds.averaging);
      done.sums = deposit();
    }
    if (replacement) done.droplets = replacement->droplets(grid, link.mine());
    link.send(done);
    seconds.exchange = link.statistics().exchange_seconds;
    seconds.waiting = link.statistics().waiting_seconds;
    const ParticleReport said = report.window(forces, averaging, replaced_volume, seconds);
    link.close_window(said);

    dem_steps += steps;
    fallback_results.window(link.number() - plan.windows_before, dem_steps, said, report.count());
    if (!link.writes()) continue;
    run_stage().set("output", time);
    dem.require_whole_log();
    output.write(time, window, forces, averaging, fluid.means);
    link.both_have_written(to_text(write_particle_restart(options.out, link.number(), dem, steps)));
  }
  link.close();
  return link.done() ? exit_done : exit_failed;
}

}  // namespace demvof
