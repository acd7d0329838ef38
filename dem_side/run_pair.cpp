// SPDX-License-Identifier: GPL-3.0-or-later
#include "dem_side/run_pair.hpp"

#include "coupler/base/mpi_check.hpp"
#include "coupler/base/stopwatch.hpp"
#include "coupler/exchange/momentum_exchange.hpp"
#include "coupler/link/run_stage.hpp"
#include "dem_side/dem.hpp"
#include "dem_side/restart.hpp"
#include "dem_side/size_mix.hpp"
#include "dem_side/window_steps.hpp"

namespace demvof {
namespace {

bool any_rank(bool here, const OwnWorld& world) {
  int any = here;
  check_mpi(MPI_Allreduce(MPI_IN_PLACE, &any, 1, MPI_INT, MPI_MAX, world.comm()), "MPI_Allreduce");
  return any != 0;
}

}  // namespace

PairedParticles::PairedParticles(Dem& dem, FluidForces& forces, const BulkGrid& grid,
                                 const AveragingParameters& averaging, const CaseParameters& parameters,
                                 ParticleEnd& link, const OwnWorld& world)
    : dem_(dem),
      forces_(forces),
      grid_(grid),
      parameters_(parameters),
      link_(link),
      world_(world),
      averaging_(world.comm(), grid, link.mine(), averaging) {
  weigh();
  averaging_.in(0).deposit(forces_.contributions());
}

void PairedParticles::weigh() {
  const ParticleArrays particles = dem_.particles();
  Spheres places = spheres(particles);
  if (dem_.has_clumps()) {
    radii_of_wholes_ = whole_radii(particles);
    places.radius = radii_of_wholes_.data();
  }
  averaging_.weigh(places);
}

std::function<SeenSurface(int)> PairedParticles::surface_at_particles() const {
  return averaging_.surface_at(spheres(dem_.particles()));
}

/// What the particles are now, by fluid; of the exchange schemes that hand something back with their support.
std::vector<CellValues<BulkParticles>> PairedParticles::deposit() {
  const bool two_fluids = link_.plan().fluids > 1;
  weigh();
  if (two_fluids && any_rank(forces_.waiting_for_fluid() > 0, world_))
    forces_.see_surface(surface_at_particles());
  std::vector<CellValues<BulkParticles>> by_fluid;
  replaced_volume_ = 0;
  for (int k = 0; k < averaging_.fluids(); ++k) {
    const auto contribution = [&, of = forces_.contributions(k), keep = forces_.keep_to(k)](int i) {
      if (two_fluids && !averaging_.in(1 - k).reached_by(i)) keep(i);
      BulkParticles here = of(i);
      if (replacement_) replaced_volume_ += replacement_->leave_out_replaced(i, here);
      return here;
    };
    AveragingInFluid& in = averaging_.in(k);
    if (!hands_back_left_over(parameters_.coupling.exchange)) {  // uses no responses
      by_fluid.push_back(in.deposit(contribution));
      continue;
    }
    const auto support = in.deposit_with<Support>([&contribution, of = forces_.support(k)](int i) {
      return AveragingInFluid::With<Support>{contribution(i), of(i)};
    });
    by_fluid.push_back(in.deposited());
    count_support(support, by_fluid.back());
  }
  return by_fluid;
}

void PairedParticles::feel(const FluidMessage& fluid) {
  const WindowPlan& plan = link_.plan();
  const double window = link_.window_length();
  FluidsAtParticles felt;
  {
    const Stopwatch watch(seconds_.averaging);
    for (int k = 0; k < plan.fluids; ++k)
      felt.fluid[k] = averaging_.in(k).sample(fluid.means[k], plan.gradients ? &fluid.gradients[k] : nullptr);
    if (plan.fluids > 1) {
      averaging_.see(fluid.surface);
      felt.surface = surface_at_particles();
    }
    if (fluid.openings) averaging_.set_openings(*fluid.openings);  // for what they do in this window
    forces_.begin_window(felt, window);
    for (int k = 0; k < plan.fluids && knows_sizes(parameters_.forces.drag); ++k)
      forces_.tell_sizes(k, sizes_around(dem_.particles(), forces_, k, averaging_.in(k)));
  }
  if (replacement_)
    replacement_->begin_window(averaging_.in(0).sample_records(*fluid.interface), felt.fluid[0], window);
}

void PairedParticles::say_what_to_expect() {
  ParticleMessage expected;
  for (int k = 0; k < averaging_.fluids(); ++k)
    expected.sums.push_back(averaging_.in(k).deposit(forces_.expected_contributions(k)));
  if (replacement_) expected.droplets.emplace();
  link_.send(expected);
}

void PairedParticles::step(int steps) {
  run_stage().set("DEM steps");
  const Stopwatch watch(seconds_.dem);
  dem_.run(steps);
}

ParticleMessage PairedParticles::done() {
  ParticleMessage done;
  {
    const Stopwatch watch(seconds_.averaging);
    done.sums = deposit();
  }
  if (replacement_) done.droplets = replacement_->droplets(grid_, link_.mine());
  return done;
}

int PairedParticles::steps_of_window() const {
  if (link_.plan().own_lengths()) return static_cast<int>(link_.steps());
  return steps_per_window(parameters_.coupling.window, dem_.time_step());
}

void PairedParticles::run(Replacement* replacement, const std::filesystem::path& folder,
                          std::optional<double> continued_from, FallbackResults& fallback) {
  const WindowPlan& plan = link_.plan();
  if (plan.interface) replacement_ = replacement;
  run_stage().set("first exchange");
  averaging_.set_openings(link_.openings());
  if (plan.fluids > 1) averaging_.see(link_.surface());
  const std::vector<CellValues<BulkParticles>> deposited = deposit();
  Report report(dem_);
  fallback.start(report.count());
  Output output(dem_, grid_, folder, continued_from);
  if (!continued_from)
    output.write(link_.end_time(), parameters_.coupling.longest_window(), forces_, averaging_, {});
  link_.start(deposited, report.window(forces_, averaging_, replaced_volume_, seconds_));

  long dem_steps = 0;  // done here
  while (link_.next_window()) {
    run_stage().set("exchange with the fluid", link_.begin_time());
    const FluidMessage fluid = link_.fluid();
    if (parameters_.gravity)
      dem_.set_gravity(parameters_.gravity->mean(link_.begin_time(), link_.end_time()));
    feel(fluid);
    if (link_.is_first()) forces_.first_half_step();  // the fluid is known now
    if (link_.is_first() && plan.schedule == Schedule::concurrent) say_what_to_expect();
    const int steps = steps_of_window();
    step(steps);
    const double time = link_.end_time();
    run_stage().set("end of the window", time);
    link_.send(done());
    seconds_.exchange = link_.statistics().exchange_seconds;
    seconds_.waiting = link_.statistics().waiting_seconds;
    const ParticleReport said = report.window(forces_, averaging_, replaced_volume_, seconds_);
    link_.close_window(said);

    dem_steps += steps;
    fallback.window(link_.number() - plan.windows_before, dem_steps, said, report.count());
    if (!link_.writes()) continue;
    run_stage().set("output", time);
    dem_.require_whole_log();
    output.write(time, link_.window_length(), forces_, averaging_, fluid.means);
    link_.both_have_written(to_text(write_particle_restart(folder, link_.number(), dem_, steps)));
  }
}

}  // namespace demvof
