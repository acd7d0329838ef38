// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "coupler/exchange/momentum_books.hpp"
#include "coupler/scene/scene.hpp"

namespace demvof {

enum class RunStatus { completed, failed, interrupted };

struct RunFailure {
  std::string side;     // "fluid" or "particles"
  std::string stage;    // what it was doing, in the words of its main loop
  double time = 0;      // simulated, s
  std::string message;  // what happened and what to try
};

/// Everything that results.json says about a run (docs/outputs.md). Wall times are those of rank 0
/// of each side, s; counts are over all ranks.
struct RunResults {
  RunStatus status = RunStatus::completed;
  std::optional<RunFailure> failure;  // given when the status is failed

  std::string configuration_hash;
  std::string configuration;  // JSON text, as resolved_configuration() gives it
  std::string command;
  std::optional<double> continued_from;  // s: everything below is of the part of the run since then

  struct {
    int fluid = 1, particles = 0;
  } ranks;
  struct {
    double total = 0;      // from the start of main to the writing of this file
    double fluid = 0;      // in the fluid's equations
    double particles = 0;  // in DEM steps, forces included
    double exchange = 0;   // averaging, mapping and moving data, both sides, waiting apart
    double waiting = 0;    // for the partner, both sides
  } wall_seconds;
  struct {
    std::int64_t fluid = 0, particles = 0;
  } peak_memory_bytes;  // sums over ranks
  struct {
    long windows = 0, fluid = 0, particles = 0;
  } steps;
  struct {
    long fine_min = 0, fine_max = 0, bulk = 0, bulk_active_max = 0;
    long mesh_changes = 0;  // by fluid.refinement
    long rank_changes = 0;  // how often cells were moved between ranks
    double imbalance = 1;   // with it: most cells on a rank over the mean, worst of the run
  } cells;
  struct {
    long initial = 0, inserted = 0, left = 0, lost = 0, outside_fluid = 0, final = 0;
  } particles;
  /// Where windows have their own lengths.
  struct Windows {
    double shortest = 0, longest = 0;  // s
    double largest_error = 0;          // over what is allowed, - (window_rule.hpp)
    long over = 0;                     // with an error above 1

    void enter(double length, double error) {
      shortest = longest > 0 ? std::min(shortest, length) : length;
      longest = std::max(longest, length);
      largest_error = std::max(largest_error, error);
      over += error > 1;
    }
  };
  std::optional<Windows> window;
  struct {
    double smallest = 1;  // relaxation factor of what the particles were told of the fluid (relaxation.hpp)
    long cells = 0;       // bulk cells times windows in which it was below 1
  } relaxation;
  struct {
    std::int64_t bytes = 0, cells = 0;
  } exchanged;  // both ways, whole run
  struct {
    double exchange = 0;       // |given by particles - received by fluid - pending| / given, worst window
    double momentum = 0;       // the momentum ledger's
    double solid_volume = 0;   // bulk grid against the particles' volume, worst window
    double liquid_volume = 0;  // drift against the start, worst window
  } conservation;              // relative, -
  std::optional<MomentumBooks> momentum;  // of everything, with particles

  struct ClosureUse {
    std::string name;
    long evaluations = 0, outside = 0;  // outside the range the closure was fitted for
  };
  std::vector<ClosureUse> closures;  // over the run, all ranks
  struct Replacement {
    long became_liquid = 0, took_place_back = 0;  // particles
    double liquid_in = 0, liquid_out = 0;         // m3
    double volume_error = 0;                      // worst |change of liquid - V_p| / V_p, -
    Vec3 impulse;                                 // that came with it to the fluid, N s
    double impulse_error = 0;                     // against the change of the fluid's momentum, -
  };
  std::optional<Replacement> replacement;  // given with phase interchange `replacement`

  std::vector<Decision> scene;
  std::vector<std::pair<std::string, double>> quantities;  // names of history.csv, values at the end
  std::vector<std::string> warnings;                       // clamps and limiters that acted, with counts
};

/// The file's content; version and machine are added here. Numbers that are not finite become null.
/// Throws std::invalid_argument when the configuration is no JSON text.
std::string results_json(const RunResults& results);

/// Writes results_json to path in one step. Throws std::runtime_error when it cannot.
void write_results(const std::filesystem::path& path, const RunResults& results);

}  // namespace demvof
