// SPDX-License-Identifier: GPL-3.0-or-later
#include "foam_side/run_record.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>

#include "coupler/config/quantities.hpp"
#include "coupler/config/read_case.hpp"
#include "coupler/exchange/momentum_exchange.hpp"
#include "coupler/output/machine.hpp"
#include "coupler/output/restart_point.hpp"
#include "coupler/output/verdict.hpp"
#include "foam_side/fine_mesh.hpp"
#include "foam_side/fluid_books.hpp"
#include "foam_side/run_warnings.hpp"

namespace demvof {

namespace {

using WallClock = std::chrono::steady_clock;
using nlohmann::json;

double seconds_since(WallClock::time_point start) {
  return std::chrono::duration<double>(WallClock::now() - start).count();
}

Vec3 vec3(const json& array) {
  return {array.at(0), array.at(1), array.at(2)};
}

void add_vector(Quantities& quantities, const std::string& name, const Vec3& vector) {
  quantities[name + "_x"] = vector.x;
  quantities[name + "_y"] = vector.y;
  quantities[name + "_z"] = vector.z;
}

/// Names that this run can record, in the order of the table.
std::vector<std::string> recorded_names(const CaseParameters& parameters, bool particles, bool refines) {
  if (!parameters.output.history.empty()) return parameters.output.history;
  std::vector<std::string> names;
  for (const Quantity& quantity : known_quantities) {
    const std::string name(quantity.name);
    if (name.rfind("window", 0) == 0 && !parameters.coupling.adaptive_window) continue;
    if (name == "fine_cells" && !refines) continue;
    const bool of_particles = name == "particles" || name.rfind("window", 0) == 0 || name == "solid_front" ||
                              name == "active_bulk_cells" || name == "smallest_relaxation" ||
                              name.rfind("particle_", 0) == 0 || name.rfind("pending_", 0) == 0;
    if (particles || !of_particles) names.push_back(name);
  }
  return names;
}

}  // namespace

struct RunRecord::Shared {
  std::mutex mutex;
  RunResults results;
  std::filesystem::path file;
  bool begun = false;  // what is there is of this run; before, of the one that it was to go on with
  WallClock::time_point start = WallClock::now();

  void write() {
    results.wall_seconds.total = seconds_since(start);
    write_results(file, results);
  }
};

FluidReport take_report(Flow& flow) {
  FluidReport report;
  const FluidBooks books = take_books(flow);
  report.liquid_volume = liquid_volume(flow);
  report.liquid_in = books.liquid_in;
  if (!flow.source) return report;
  report.momentum = fluid_momentum(flow);
  report.outside.fluid_weight = books.weight;
  report.outside.boundary_pressure = books.boundary_pressure;
  report.outside.boundary_shear = books.boundary_shear;
  report.outside.carried_in = books.carried_in;
  report.outside.surface_tension = books.surface_tension;
  report.outside.sources = books.sources;
  return report;
}

RunRecord::RunRecord(const ProgramOptions& options, const CaseParameters& parameters, const Scene& scene,
                     const json& particles, int rank, int ranks)
    : out_(options.out),
      parameters_(parameters),
      writes_(rank == 0),
      shared_(std::make_shared<Shared>()),
      progress_(options.out / "progress.json") {
  RunResults& results = shared_->results;
  shared_->file = out_ / "results.json";
  results.configuration_hash = configuration_hash(parameters);
  results.configuration = resolved_configuration(parameters);
  results.command = options.command;
  results.ranks = {ranks, particles.is_null() ? 0 : particles.at("ranks").get<int>()};
  results.scene = scene.decisions;
  if (!particles.is_null()) {
    results.particles.initial = results.particles.final = particles.at("particle_count");
    for (const auto& name : particles.at("closures")) results.closures.push_back({name, 0, 0});
    const BulkGridParameters& grid = *parameters.bulk_grid;
    results.cells.bulk = static_cast<long>(BulkGrid(grid.lower, grid.upper, grid.cells).cell_count());
  }
  shared_->begun = !options.continues;
  if (!writes_) return;
  std::error_code ignored;
  if (shared_->begun) std::filesystem::remove(shared_->file, ignored);  // of a run before, started by hand
  set_last_words([shared = shared_](const Failure& failure) {
    const std::lock_guard<std::mutex> lock(shared->mutex);
    if (!shared->begun) return;
    shared->results.status = RunStatus::failed;
    shared->results.failure =
        RunFailure{side_name(failure.side), failure.stage, failure.time, failure.message};
    shared->write();
  });
}

RunRecord::~RunRecord() = default;

void RunRecord::start(const Flow& flow, const ParticleReport* particles, long windows) {
  const Quantities quantities = fluid_quantities(flow);
  books_.emplace(parameters_.coupling.exchange, parameters_.coupling.schedule,
                 particles ? particles->momentum : Vec3{}, fluid_momentum(flow),
                 Books::State{{}, {}, quantities.at("liquid_volume"), {}});
  initial_potential_ = quantities.at("potential_energy");
  open_history(flow, {});
  write_row(flow, particles);
  begin_ = flow.time.value();
  next_row_ = begin_ + parameters_.output.history_interval;
  windows_before_ = windows;
}

void RunRecord::open_history(const Flow& flow, std::optional<double> continued_from) {
  if (!writes_) return;
  std::vector<HistoryColumn> columns;
  for (const std::string& name :
       recorded_names(parameters_, flow.scene.particles, flow.refinement != nullptr))
    columns.push_back({name, std::string(find_quantity(name)->unit)});
  history_ = std::make_unique<History>(out_ / "history.csv", columns, continued_from);
}

void RunRecord::go_on(const Flow& flow, const ParticleReport& particles, long windows, const json& books) {
  books_.emplace(parameters_.coupling.exchange, parameters_.coupling.schedule, particles.momentum,
                 fluid_momentum(flow),
                 Books::State{vec3(books.at("pending")), vec3(books.at("unplaced")),
                              books.at("liquid_volume"), vec3(books.at("owed_pressure"))});
  initial_potential_ = books.at("initial_potential");
  begin_ = books.at("begin");
  next_row_ = books.at("next_row");
  last_row_ = flow.time.value();
  windows_before_ = windows;
  const std::lock_guard<std::mutex> lock(shared_->mutex);
  shared_->results.continued_from = flow.time.value();
  if (writes_) keep_earlier(out_, "results.json");
  shared_->begun = true;
  open_history(flow, flow.time.value());
}

json RunRecord::books() const {
  const auto array = [](const Vec3& v) { return json{v.x, v.y, v.z}; };
  const Books::State state = books_->state();
  return {{"pending", array(state.pending)},
          {"unplaced", array(state.unplaced)},
          {"owed_pressure", array(state.owed_pressure)},
          {"liquid_volume", state.liquid_volume},
          {"initial_potential", initial_potential_},
          {"begin", begin_},
          {"next_row", next_row_}};
}

void RunRecord::enter(RunResults& results, const ParticleReport& particles) {
  results.wall_seconds.particles = particles.dem_seconds;
  results.wall_seconds.exchange += particles.averaging_seconds + particles.exchange_seconds;
  results.wall_seconds.waiting += particles.waiting_seconds;
  results.peak_memory_bytes.particles = static_cast<std::int64_t>(particles.peak_memory_bytes);
  results.particles.final = std::lround(particles.count);
  results.particles.inserted = std::lround(particles.inserted);
  results.particles.left = std::lround(particles.left);
  results.particles.lost = std::lround(particles.lost);
  results.particles.outside_fluid = std::lround(particles.outside_fluid);
  results.steps.particles += std::lround(particles.steps);
  for (std::size_t i = 0; i < results.closures.size(); ++i) {
    results.closures[i].evaluations += std::lround(particles.closures.at(i).evaluations);
    results.closures[i].outside += std::lround(particles.closures.at(i).outside);
  }
  limits_.relieved_cells += std::lround(particles.relieved_cells);
  limits_.relieved_volume += particles.relieved_volume;
  limits_.unplaced_volume = std::max(limits_.unplaced_volume, particles.unplaced_volume);
  limits_.waiting_particles += std::lround(particles.waiting_for_fluid);
  limits_.outside_particles += std::lround(particles.outside_fluid);
  constexpr double soft_share = 0.1;  // of those in contact, that is worth a warning
  if (particles.on_soft_springs > soft_share * particles.touching) {
    const bool first = limits_.soft_windows++ == 0;
    limits_.holding_window = std::max(limits_.holding_window, particles.holding_window);
    limits_.mild_window =
        first ? particles.mild_window : std::min(limits_.mild_window, particles.mild_window);
  }
  limits_.unplaced_left_over += norm(particles.left_over_unplaced);
  last_particles_ = particles;
}

void RunRecord::window(const Flow& flow, const Window& window, double end_time) {
  const bool crosses =
      parameters_.coupling.phase_interchange == PhaseInterchange::none && solid_at_interface(flow);
  const long cells = Foam::returnReduce(flow.mesh.nCells(), Foam::sumOp<label>());
  const double memory = Foam::returnReduce(static_cast<double>(peak_memory_bytes()), Foam::sumOp<double>());
  {
    const std::lock_guard<std::mutex> lock(shared_->mutex);
    RunResults& results = shared_->results;
    results.steps.windows = window.number - windows_before_;
    results.steps.fluid = flow.clock.steps;
    results.cells.fine_max = std::max(results.cells.fine_max, cells);
    results.cells.fine_min = results.cells.fine_min ? std::min(results.cells.fine_min, cells) : cells;
    if (flow.refinement) {
      results.cells.mesh_changes = flow.refinement->changes;
      results.cells.rank_changes = flow.refinement->moves;
      results.cells.imbalance = flow.refinement->worst_imbalance;
    }
    results.cells.bulk_active_max = std::max(results.cells.bulk_active_max, window.active_cells);
    if (parameters_.coupling.adaptive_window) {
      RunResults::Windows& windows = results.window ? *results.window : results.window.emplace();
      windows.enter(window.length, window.error);
    }
    last_window_ = {window.length, window.error, window.relaxation, window.active_cells};
    results.relaxation.smallest = std::min(results.relaxation.smallest, window.relaxation);
    results.relaxation.cells += window.relaxed_cells;
    results.peak_memory_bytes.fluid = static_cast<std::int64_t>(memory);
    results.wall_seconds.fluid = window.seconds.fluid;
    results.wall_seconds.exchange = window.seconds.mapping + window.seconds.exchange;
    results.wall_seconds.waiting = window.seconds.waiting;
    results.exchanged = {window.exchanged_bytes, window.exchanged_cells};
    if (window.particles) {
      enter(results, *window.particles);
      limits_.negative_cells += window.negative_cells;
      limits_.full_cells += window.full_cells;
      if (window.beside.matters()) {
        limits_.beside.cells += window.beside.cells;
        limits_.beside.impulse = std::max(limits_.beside.impulse, window.beside.impulse);
      }
      if (window.held_back.matters()) {
        limits_.held_back.cells += window.held_back.cells;
        limits_.held_back.impulse = std::max(limits_.held_back.impulse, window.held_back.impulse);
      }
    }
    if (window.replacement) {
      const ReplacementBooks& books = *window.replacement;
      results.replacement = {books.became_liquid,      books.took_place_back,    books.liquid_in,
                             books.liquid_out,         books.worst_volume_error, books.impulse,
                             books.worst_impulse_error};
    }
    if (window.particles)
      books_->window(window.fluid, *window.particles);
    else
      books_->window(window.fluid);
    const ConservationErrors& worst = books_->worst();
    results.conservation = {worst.exchange, worst.momentum, worst.solid_volume, worst.liquid_volume};
    if (window.particles && !flow.ghost) results.momentum = books_->momentum();
    if (window.replacement) limits_.drop_resolution = window.replacement->worst_resolution;
    limits_.crossing_windows += crosses;
  }
  const double time = flow.time.value();
  if (time > next_row_ - 0.5 * flow.time.deltaTValue() || time >= end_time) {
    write_row(flow, window.particles ? &*window.particles : nullptr);
    next_row_ += parameters_.output.history_interval;
    if (parameters_.output.history_interval <= 0) next_row_ = time;
  }
  if (!writes_) return;
  Progress progress;
  progress.begin_time = begin_;
  progress.time = time;
  progress.end_time = end_time;
  progress.window = window.number;
  progress.windows = window.planned;
  progress.worst_courant = flow.clock.largest_courant;
  progress.particles = shared_->results.particles.final;
  progress.fine_cells = cells;
  progress_.update(progress);
}

Quantities RunRecord::all_quantities(const Flow& flow, const ParticleReport* particles) const {
  Quantities q = fluid_quantities(flow);
  q["kinetic_energy_ratio"] = initial_potential_ > 0 ? q["kinetic_energy"] / initial_potential_ : 0;
  q["mechanical_energy"] = q["kinetic_energy"] + q["potential_energy"];
  add_vector(q, "fluid_momentum", fluid_momentum(flow));
  q["fine_cells"] = static_cast<double>(Foam::returnReduce(flow.mesh.nCells(), Foam::sumOp<label>()));
  if (!particles) return q;
  q["particles"] = particles->count;
  if (parameters_.coupling.adaptive_window) {
    q["window"] = last_window_.length;
    q["window_error"] = last_window_.error;
  }
  q["active_bulk_cells"] = static_cast<double>(last_window_.active_cells);
  q["smallest_relaxation"] = last_window_.relaxation;
  q["particle_kinetic_energy"] = particles->kinetic_energy;
  add_vector(q, "particle_momentum", particles->momentum);
  add_vector(q, "pending_momentum", books_->pending());
  // dem_side counts potential energy from the origin, the fluid from the lowest corner of its mesh.
  q["particle_potential_energy"] =
      particles->potential_energy + particles->mass * (flow.g.value() & lowest_corner(flow));
  if (particles->count > 0) q["solid_front"] = particles->solid_front.x;
  q["mechanical_energy"] += q["particle_kinetic_energy"] + q["particle_potential_energy"];
  return q;
}

void RunRecord::write_row(const Flow& flow, const ParticleReport* particles) {
  const Quantities quantities = all_quantities(flow, particles);
  const std::string nonsense = find_nonsense({quantities.begin(), quantities.end()});
  if (!nonsense.empty()) throw RunError(nonsense);
  if (const auto speed = quantities.find("max_speed"); speed != quantities.end())
    largest_speed_ = std::max(largest_speed_, speed->second);
  last_row_ = flow.time.value();
  if (!writes_) return;
  std::vector<double> row;
  const std::lock_guard<std::mutex> lock(shared_->mutex);
  shared_->results.quantities.clear();
  for (const HistoryColumn& column : history_->columns()) {
    const auto found = quantities.find(column.name);
    row.push_back(found == quantities.end() ? std::nan("") : found->second);
    if (found != quantities.end()) shared_->results.quantities.push_back(*found);
  }
  history_->append(flow.time.value(), row);
}

RunStatus RunRecord::finish(const Flow& flow, RunStatus status) {
  if (flow.time.value() > last_row_) write_row(flow, last_particles_ ? &*last_particles_ : nullptr);
  if (!writes_) return status;
  const std::lock_guard<std::mutex> lock(shared_->mutex);
  RunResults& results = shared_->results;
  const Verdict verdict = judge(results, parameters_.limits, {flow.clock.largest_courant, largest_speed_},
                                pays_drag_impulse(parameters_.coupling.exchange));
  results.warnings = run_warnings(flow, limits_, books_->gone_impulse(), results.closures);
  results.warnings.insert(results.warnings.begin(), verdict.warnings.begin(), verdict.warnings.end());
  results.status = verdict.failure ? RunStatus::failed : status;
  if (verdict.failure) {
    results.failure = RunFailure{"fluid", "judging the results", flow.time.value(), *verdict.failure};
    fmt::print(stderr, "The run went to its end, and its results are wrong: {}\n", *verdict.failure);
  }
  shared_->write();
  shared_->begun = false;  // nothing that comes now changes what was computed
  return results.status;
}

}  // namespace demvof
