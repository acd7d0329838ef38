// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <mutex>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "coupler/config/parameters.hpp"
#include "coupler/config/program_options.hpp"
#include "coupler/exchange/books.hpp"
#include "coupler/exchange/owed_pressure.hpp"
#include "coupler/exchange/window_rule.hpp"
#include "coupler/link/failure.hpp"
#include "coupler/output/history.hpp"
#include "coupler/output/progress.hpp"
#include "coupler/output/results.hpp"
#include "foam_side/flow.hpp"
#include "foam_side/quantities.hpp"
#include "foam_side/replacement.hpp"
#include "foam_side/run_warnings.hpp"

namespace demvof {

/// Wall time of rank 0 of this side, s.
struct FluidSeconds {
  double fluid = 0;     // in the fluid's equations
  double mapping = 0;   // between fine mesh and bulk grid
  double exchange = 0;  // packing and moving data, waiting apart
  double waiting = 0;   // for the partner
};

/// What flowed and acted in the window or step just done. Collective.
FluidReport take_report(Flow& flow);

/// What a run leaves behind besides its fields: history.csv, progress.json, results.json.
/// Rank 0 writes; calls that take the flow are collective over the fluid side.
class RunRecord {
 public:
  /// particles: the facts that dem_side stated in the handshake (null without particles).
  RunRecord(const ProgramOptions& options, const CaseParameters& parameters, const Scene& scene,
            const nlohmann::json& particles, int rank, int ranks);
  ~RunRecord();

  /// The state before the first step. particles: dem_side's report of it; nullptr without particles. windows:
  /// those that would have been done by then, where it begins later than at 0.
  void start(const Flow& flow, const ParticleReport* particles, long windows = 0);

  /// The same for a run that goes on. windows: done before; books: of an earlier RunRecord at that time.
  /// Moves what that has written about the whole run to the folder `earlier`.
  void go_on(const Flow& flow, const ParticleReport& particles, long windows, const nlohmann::json& books);
  nlohmann::json books() const;

  /// One window (with particles) or time step (without).
  struct Window {
    long number = 0, planned = 0;  // planned 0: not known
    // Where windows have their own lengths: s, what it came to, and its error (window_rule.hpp), -.
    double length = 0;
    WindowChange change;
    double error = 0;
    FluidReport fluid;        // liquid excepted: it is looked up
    long active_cells = 0;    // of the bulk grid
    double relaxation = 1;    // smallest relaxation factor of what the particles were told
    long relaxed_cells = 0;   // bulk cells with a factor below 1
    long negative_cells = 0;  // fine cells whose solid fraction was interpolated below 0
    long full_cells = 0;      // fine cells with more solid than leaves room for the fluid
    OwedPressure::HeldBack held_back;
    ParticlesToFine::Beside beside;
    std::optional<ReplacementBooks> replacement;  // of the run so far, when the scene has it
    std::optional<ParticleReport> particles;      // not without particles
    FluidSeconds seconds;
    std::int64_t exchanged_bytes = 0, exchanged_cells = 0;
  };
  void window(const Flow& flow, const Window& window, double end_time);

  /// Writes results.json, with the verdict on what was computed; returns the status there, on rank 0.
  /// Failures on the way are written by the last words (failure.hpp) instead.
  RunStatus finish(const Flow& flow, RunStatus status);

 private:
  struct Shared;  // results as the last words need them, whichever thread speaks them
  void open_history(const Flow& flow, std::optional<double> continued_from);
  void enter(RunResults& results, const ParticleReport& particles);
  Quantities all_quantities(const Flow& flow, const ParticleReport* particles) const;
  void write_row(const Flow& flow, const ParticleReport* particles);

  std::filesystem::path out_;
  const CaseParameters& parameters_;
  bool writes_;
  std::shared_ptr<Shared> shared_;
  std::unique_ptr<History> history_;
  ProgressFile progress_;
  std::optional<Books> books_;
  long windows_before_ = 0;       // those to the time at which this run begins
  double begin_ = 0;              // of the run, or of that which it continues, s
  double initial_potential_ = 0;  // J
  double largest_speed_ = 0;      // in the rows of history.csv, m/s
  double last_row_ = -1;          // time of the last row of history.csv, s
  double next_row_ = 0;           // time of the next row of history.csv, s
  struct {
    double length = 0, error = 0;  // where windows have their own lengths: s, -
    double relaxation = 1;
    long active_cells = 0;
  } last_window_;  // as history.csv has it
  std::optional<ParticleReport> last_particles_;

  ActedLimits limits_;
};

}  // namespace demvof
