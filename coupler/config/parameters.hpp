// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "coupler/grid/vec3.hpp"

// Everything a case file can say, with its defaults. Nothing here knows YAML: read_case.cpp fills
// these structs, the rest of the program only sees them. SI units throughout.

namespace demvof {

/// Where foam_side makes the fine mesh finer than the case's own, and when coarser again.
struct RefinementParameters {
  int levels = 2;            // how often a cell of the case's mesh may be halved
  int buffer = 2;            // rings of cells around the interface that are fine too
  bool particles = false;    // fine wherever there are particles
  double porosity_jump = 0;  // fine where eps of two neighbours differs by more, -; 0: not asked
  int max_cells = 10000000;  // no finer beyond this
};

struct FluidParameters {
  std::string case_folder;  // an ordinary OpenFOAM interFoam case, relative to the case file
  int ranks = 1;            // MPI ranks of foam_side
  std::vector<std::string> prepare = {"blockMesh",
                                      "setFields"};  // OpenFOAM commands that make mesh and fields
  std::optional<RefinementParameters> refinement;    // absent: the mesh stays as it is
};

struct ParticleParameters {
  std::string script;  // an ordinary LIGGGHTS input script, relative to the case file
  int ranks = 1;       // MPI ranks of dem_side
};

struct BulkGridParameters {
  Vec3 lower, upper;                  // corners, m
  std::array<int, 3> cells{1, 1, 1};  // cells per direction
};

enum class Schedule { staggered, concurrent };
enum class ExchangeScheme { explicit_drag, semi_implicit, conservative_implicit };  // YAML: explicit, ...
enum class Kernel { centre, volume, linear, gaussian, diffusion };
enum class Mapping { nearest, inverse_distance, cell_point, cell_point_face, conservative };
enum class Sharing { volume, mass };
enum class PhaseInterchange { porous, volume_adding, replacement, none };

struct AveragingParameters {
  Kernel kernel = Kernel::gaussian;
  double width = 0;      // standard deviation of the Gaussian, m; 0: half a bulk cell
  double bandwidth = 0;  // b of the diffusion kernel, m; 0: six of the largest particle diameters
  double maximum_solid_fraction =
      0.74;  // of a bulk cell; what is above moves to the neighbours and is counted
};

struct MappingParameters {
  Mapping to_fine = Mapping::conservative;
  Mapping to_bulk = Mapping::conservative;
};

struct CouplingParameters {
  double end_time = 0;  // s
  double window = 0;    // s; a multiple of the DEM time step
  Schedule schedule = Schedule::staggered;
  ExchangeScheme exchange = ExchangeScheme::conservative_implicit;
  Sharing sharing = Sharing::mass;  // how a bulk cell's source is shared among its fine cells
  AveragingParameters averaging;
  MappingParameters mapping;
  PhaseInterchange phase_interchange = PhaseInterchange::porous;
  double interchange_speed = 0;  // replacement: slower impacts on the interface replace nothing, m/s
  double time_out = 600;         // s without a word from the partner before a side gives up
};

enum class DragLaw { none, schiller_naumann, gidaspow, di_felice, koch_hill, beetstra, rong };
enum class OwnWake { none, oseen };

enum class LiftLaw { none, saffman_mei };

struct ForceParameters {
  DragLaw drag = DragLaw::schiller_naumann;
  bool pressure_gradient = true;
  OwnWake own_wake = OwnWake::none;  // correction of the sampled velocity for the particle's own disturbance
  bool viscous_stress = false;
  double added_mass = 0;  // C_m, -: the particle moves C_m times its own volume of fluid with it
  LiftLaw lift = LiftLaw::none;
  bool capillary = false;
  Vec3 constant;  // N on each particle, from outside
};

/// True when a force asks for derivatives of the fluid's velocity or for its surface (BulkFluidGradients).
inline bool need_gradients(const ForceParameters& forces) {
  return forces.viscous_stress || forces.added_mass > 0 || forces.lift != LiftLaw::none || forces.capillary;
}

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
  std::vector<double> pictures;      // times shown in report.html, s; empty: begin, four between, end
};

struct CaseParameters {
  std::string file;  // path of the case file, as given
  FluidParameters fluid;
  std::optional<ParticleParameters> particles;  // absent: plain VOF, no partner
  std::optional<BulkGridParameters> bulk_grid;  // needed with particles
  CouplingParameters coupling;
  ForceParameters forces;
  SceneParameters scene;
  OutputParameters output;
};

}  // namespace demvof
