// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "coupler/base/vec3.hpp"
#include "coupler/closures/force_parameters.hpp"
#include "coupler/exchange/crossing.hpp"
#include "coupler/exchange/exchange_parameters.hpp"
#include "coupler/exchange/gravity_table.hpp"
#include "coupler/transfer/averaging_parameters.hpp"
#include "coupler/transfer/mapping_parameters.hpp"

// Everything a case file can say, with its defaults. Nothing here knows YAML: read_case.cpp fills
// these structs, the rest of the program only sees them. What steers an algorithm stands beside it
// (closures, exchange, transfer) and is only put together here. SI units throughout.

namespace demvof {

/// Where foam_side makes the fine mesh finer than the case's own, and when coarser again.
struct RefinementParameters {
  int levels = 2;               // how often a cell of the case's mesh may be halved
  int buffer = 2;               // rings of cells around the interface that are fine too
  bool particles = false;       // fine wherever there are particles
  double porosity_jump = 0;     // fine where eps of two neighbours differs by more, -; 0: not asked
  int max_cells = 10000000;     // no finer beyond this
  double max_imbalance = 1.03;  // cells are moved between ranks beyond this: most on a rank over the mean
};

struct FluidParameters {
  std::string case_folder;  // an ordinary OpenFOAM interFoam case, relative to the case file
  int ranks = 1;            // MPI ranks of foam_side
  std::vector<std::string> prepare = {"blockMesh",
                                      "setFields"};  // OpenFOAM commands that make mesh and fields
  std::optional<RefinementParameters> refinement;    // absent: the mesh stays as it is
};

struct ParticleParameters {
  std::string script;                        // an ordinary LIGGGHTS input script, relative to the case file
  int ranks = 1;                             // MPI ranks of dem_side
  std::vector<std::string> unseen_surfaces;  // fixes that move surfaces through which the fluid flows
};

struct BulkGridParameters {
  Vec3 lower, upper;                  // corners, m
  std::array<int, 3> cells{1, 1, 1};  // cells per direction
};

struct CouplingParameters {
  double end_time = 0;                            // s
  double window = 0;                              // s; a multiple of the DEM time step
  std::optional<AdaptiveWindow> adaptive_window;  // then `window` is 0
  double longest_window() const { return adaptive_window ? adaptive_window->longest : window; }
  Schedule schedule = Schedule::staggered;
  ExchangeScheme exchange = ExchangeScheme::conservative_implicit;
  int order = 1;                    // in the window, of what the particles are told of the fluid: 1 or 2
  Sharing sharing = Sharing::mass;  // how a bulk cell's source is shared among its fine cells
  AveragingParameters averaging;
  MappingParameters mapping;
  PhaseInterchange phase_interchange = PhaseInterchange::porous;
  double interchange_speed = 0;  // replacement: slower impacts on the interface replace nothing, m/s
  double time_out = 600;         // s without a word from the partner before a side gives up
};

/// For each decision of the scene plan: found from the scene (automatic), or forced.
enum class Switch { automatic, on, off };
struct SceneParameters {
  Switch particles = Switch::automatic;  // off: the run is made without them (plain VOF)
  Switch surface_tension = Switch::automatic;
  Switch interface_advection = Switch::automatic;  // transport of alpha
  Switch porosity = Switch::automatic;             // eps in the fluid equations
  double dilute_limit = 0;  // largest solid fraction up to which automatic porosity is left out, -
};

struct OutputParameters {
  double interval = 0;               // s between field outputs; 0: only at the end
  double history_interval = 0;       // s between rows of history.csv; 0: every window
  std::vector<std::string> history;  // recorded quantities; empty: all that the scene has
  int states = 2;                    // that the run can be continued from: so many, the newest, are kept
  std::vector<double> pictures;      // times shown in report.html, s; empty: begin, four between, end
};

/// What a run may not exceed: beyond, its status is failed. A tenth of each is a warning.
struct LimitParameters {
  double books = 0.01;          // conservation.exchange and .momentum, -
  double volume = 0.1;          // conservation.solid_volume and .liquid_volume, -
  double courant = 50;          // cells that the fluid crosses in a step
  double lost_particles = 0.1;  // of all particles; the first is a warning
};

struct CaseParameters {
  std::string file;  // path of the case file, as given
  FluidParameters fluid;
  std::optional<ParticleParameters> particles;  // absent: plain VOF, no partner
  std::optional<BulkGridParameters> bulk_grid;  // needed with particles
  std::optional<GravityTable> gravity;          // absent: constant, as the two sides' inputs say
  CouplingParameters coupling;
  ForceParameters forces;
  SceneParameters scene;
  OutputParameters output;
  LimitParameters limits;
};

}  // namespace demvof
