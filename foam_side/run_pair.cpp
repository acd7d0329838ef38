// SPDX-License-Identifier: GPL-3.0-or-later
#include "foam_side/run_pair.hpp"

#include <nlohmann/json.hpp>

#include "coupler/base/stopwatch.hpp"
#include "coupler/link/run_stage.hpp"
#include "coupler/scene/plan_windows.hpp"
#include "foam_side/bridge.hpp"
#include "foam_side/fluid_case.hpp"
#include "foam_side/replacement.hpp"
#include "foam_side/restart.hpp"
#include "foam_side/rows_of_all_ranks.hpp"
#include "foam_side/step_fluid.hpp"
#include "foam_side/write_fields.hpp"

namespace demvof {
namespace {

/// What the fluid of a pair does before, in and after each window.
class PairedFluid {
 public:
  PairedFluid(Flow& flow, const ProgramOptions& options, const CaseParameters& parameters,
              const BulkGrid& grid, FluidEnd& link, const OwnWorld& world, RunRecord& record)
      : flow_(flow),
        options_(options),
        parameters_(parameters),
        link_(link),
        world_(world),
        record_(record),
        bridge_(flow, parameters, grid, link.mine(), world.comm()) {}

  /// The particles before the first window, and the state that it starts from. start: of an earlier run, or
  /// null.
  void begin(const RestartPoint* start);
  void begin_window();
  FluidMessage message();
  void advance();
  void take(ParticleMessage particles);
  void end_window();

 private:
  ParticleReport meet_particles(const nlohmann::json* saved);
  void start_anew(const ParticleReport& particles);
  void go_on(const RestartPoint& start, const nlohmann::json& saved, const ParticleReport& particles);
  double windows_ahead() const;
  RunRecord::Window record_of_window();
  void choose_next_window(RunRecord::Window& done);

  Flow& flow_;
  const ProgramOptions& options_;
  const CaseParameters& parameters_;
  FluidEnd& link_;
  const OwnWorld& world_;
  RunRecord& record_;
  Bridge bridge_;
  StepRange range_;    // where windows have their own lengths
  WindowSteps steps_;  // likewise
  ReplacementBooks replacement_;
  std::vector<Droplet> droplets_;  // for the coming window, of all ranks
  FluidSeconds seconds_;
};

void PairedFluid::begin(const RestartPoint* start) {
  nlohmann::json saved;
  if (start) saved = read_fluid_restart(options_.out, *start, flow_, link_.mine(), world_);
  const ParticleReport particles = meet_particles(start ? &saved : nullptr);
  if (link_.plan().own_lengths()) {
    range_ = step_range(*parameters_.coupling.adaptive_window, link_.plan().steps.length);
    steps_ = {range_.shortest, range_.shortest};
  }
  if (start)
    go_on(*start, saved, particles);
  else
    start_anew(particles);
  // The windows end the run, not controlDict.
  flow_.time.setEndTime(parameters_.coupling.end_time + parameters_.coupling.longest_window());
  flow_.time.write_when_told();
}

ParticleReport PairedFluid::meet_particles(const nlohmann::json* saved) {
  SurfaceToBulk& surface = bridge_.surface_to_bulk();
  if (flow_.scene.two_fluids && saved)
    surface.go_on_from(seen_surface(*saved));
  else if (flow_.scene.two_fluids)
    surface.news();  // all of it
  if (saved) bridge_.openings_to_bulk().go_on_from(seen_openings(*saved));
  FluidEnd::Start first = link_.start(bridge_.openings_to_bulk().told(), surface.seen());
  bridge_.take(std::move(first.particles));
  return first.report;
}

void PairedFluid::start_anew(const ParticleReport& particles) {
  ParticlesToFine& to_fine = bridge_.particles_to_fine();
  if (flow_.porosity) {
    set_solid_velocity(flow_, to_fine.solid_velocity());
    set_initial_porosity(flow_, to_fine.void_fraction());
  }
  if (flow_.ghost) set_initial_ghost(flow_, to_fine.void_fraction());
  const double window = link_.plan().own_lengths()
                            ? static_cast<double>(range_.shortest) * link_.plan().steps.length
                            : link_.plan().window;
  const double begin = link_.end_time();
  const bool other_gravity = norm(set_gravity(flow_, flow_.gravity.mean(begin, begin + window))) > 0;
  if (other_gravity || pressure_says_nothing(flow_)) balance_pressure(flow_);
  record_.start(flow_, &particles, link_.number());
  write_fields(flow_);
}

void PairedFluid::go_on(const RestartPoint& start, const nlohmann::json& saved,
                        const ParticleReport& particles) {
  steps_ = go_on_from(saved, start.window, flow_, bridge_, record_, particles);
  if (link_.plan().own_lengths())
    bridge_.set_window(static_cast<double>(steps_.last) * link_.plan().steps.length);
  if (world_.rank() == 0) go_back_to(options_.out, start);
}

void PairedFluid::begin_window() {
  if (link_.plan().own_lengths()) {
    link_.set_steps(steps_.next);
    bridge_.set_window(link_.window_length());
  }
  bridge_.follow_gravity(flow_.gravity.mean(link_.begin_time(), link_.end_time()));
}

/// OpeningsToBulk::windows_ahead at their longest, in windows like the last one.
double PairedFluid::windows_ahead() const {
  constexpr int ahead = OpeningsToBulk::windows_ahead;
  if (!link_.plan().own_lengths()) return ahead;
  return static_cast<double>(most_steps(ahead, link_.steps(), steps_.next, range_)) /
         static_cast<double>(steps_.last);
}

FluidMessage PairedFluid::message() {
  const Stopwatch watch(seconds_.mapping);
  FluidMessage fluid;
  if (link_.plan().mesh_moves) fluid.openings = bridge_.openings_to_bulk().look(windows_ahead());
  if (flow_.scene.two_fluids) fluid.surface = bridge_.surface_to_bulk().news();
  fluid.means = bridge_.bulk_fluids();
  if (link_.plan().gradients) fluid.gradients = bridge_.bulk_fluid_gradients();
  if (link_.plan().interface) fluid.interface = bridge_.fluid_to_bulk().interface();
  return fluid;
}

void PairedFluid::take(ParticleMessage particles) {
  if (link_.plan().interface) droplets_ = on_every_rank(particles.droplets->values);
  const Stopwatch watch(seconds_.mapping);
  bridge_.take(std::move(particles.sums));
}

void PairedFluid::advance() {
  ParticlesToFine& to_fine = bridge_.particles_to_fine();
  {
    const Stopwatch watch(seconds_.fluid);
    demvof::begin_window(flow_, link_.end_time());
    replace_particles(
        flow_, droplets_,
        [&to_fine](const Vec3& position, double volume) {
          return to_fine.solid_fraction_of(position, volume);
        },
        [this](const Vec3& position, const Vec3& impulse) { return bridge_.owe(position, impulse); },
        replacement_);
    to_fine.note(droplets_);
    to_fine.spread_sources();  // the flux is fitted to the new window with its drag
    if (flow_.porosity) {
      set_solid_velocity(flow_, to_fine.solid_velocity());
      set_porosity_target(flow_, to_fine.void_fraction());
    }
    if (flow_.ghost) set_ghost_target(flow_, to_fine.void_fraction(), to_fine.solid_flux_density());
    while (step_fluid(flow_, &bridge_)) {
    }
  }
  run_stage().set("end of the window", flow_.time.value());
  bridge_.end_window();
}

void PairedFluid::end_window() {
  RunRecord::Window done = record_of_window();
  done.particles = link_.close_window();
  if (link_.plan().own_lengths()) choose_next_window(done);
  seconds_.waiting = link_.statistics().waiting_seconds;
  seconds_.exchange = link_.statistics().exchange_seconds;
  done.seconds = seconds_;
  done.exchanged_bytes = link_.statistics().bytes_sent + link_.statistics().bytes_received;
  done.exchanged_cells = link_.statistics().cells_sent + link_.statistics().cells_received;
  require_whole_log();
  record_.window(flow_, done, parameters_.coupling.end_time);
  if (link_.writes())
    write_state(options_.out, parameters_, link_.number(), flow_, bridge_, record_, steps_, link_, world_);
}

/// The fluid's part, before the particles have reported.
RunRecord::Window PairedFluid::record_of_window() {
  ParticlesToFine& to_fine = bridge_.particles_to_fine();
  RunRecord::Window done;
  done.number = link_.number();
  done.planned = link_.plan().windows;
  done.fluid = take_report(flow_);
  done.fluid.explicit_impulse = to_fine.impulses().explicit_part;
  done.fluid.implicit_impulse = to_fine.impulses().implicit_part;
  done.fluid.kept_left_over = bridge_.kept_left_over();
  if (flow_.porosity) done.fluid.fine_solid_volume = to_fine.spread().solid_volume;
  done.negative_cells = to_fine.spread().negative_cells;
  done.full_cells = to_fine.spread().full_cells;
  done.beside = to_fine.beside();
  const Bridge::PressureImpulses pressure = bridge_.pressure_impulses();
  done.fluid.seen_pressure = pressure.seen;
  done.fluid.owed_pressure = pressure.owed;
  done.fluid.returned_pressure = pressure.returned;
  done.fluid.returned_turnover = pressure.turnover;
  done.held_back = pressure.held_back;
  done.fluid.outside.surface_tension += pressure.tension;
  done.fluid.outside.smeared_weight = pressure.smeared_weight;
  if (link_.plan().interface) {
    done.replacement = replacement_;
    done.fluid.replaced_liquid = replacement_.liquid();
    done.fluid.replacement_impulse = replacement_.from_outside;
  }
  done.active_cells = static_cast<long>(bridge_.active_cells());
  done.relaxation = bridge_.relaxed().smallest;
  done.relaxed_cells = bridge_.relaxed().cells;
  return done;
}

void PairedFluid::choose_next_window(RunRecord::Window& done) {
  const Stopwatch watch(seconds_.mapping);
  done.length = link_.window_length();
  done.change = bridge_.change(done.particles->max_speed);
  done.error = window_error(done.change, parameters_.coupling.adaptive_window->tolerance);
  // One cut short by an output says what the next would have come to.
  const double part = static_cast<double>(link_.steps()) / static_cast<double>(steps_.next);
  steps_ = {link_.steps(), steps_of_next_window(steps_.next, done.error / part, range_)};
}

}  // namespace

RunStatus run_pair(Flow& flow, const ProgramOptions& options, const CaseParameters& parameters,
                   const RestartPoint* start, const BulkGrid& grid, FluidEnd& link, const OwnWorld& world,
                   RunRecord& record) {
  run_stage().set("first void fraction");
  PairedFluid fluid(flow, options, parameters, grid, link, world, record);
  fluid.begin(start);
  while (link.next_window()) {
    run_stage().set("exchange with the particles", flow.time.value());
    fluid.begin_window();
    link.window(
        fluid.message(), [&] { fluid.advance(); },
        [&](ParticleMessage particles) { fluid.take(std::move(particles)); });
    fluid.end_window();
  }
  return link.done() ? RunStatus::completed : RunStatus::interrupted;
}

}  // namespace demvof
