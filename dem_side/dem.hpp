// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <mpi.h>

#include <array>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "coupler/base/vec3.hpp"
#include "dem_side/clumps.hpp"
#include "dem_side/contact_stiffness.hpp"
#include "dem_side/contact_times.hpp"
#include "dem_side/near_surfaces.hpp"
#include "dem_side/particle_arrays.hpp"
#include "dem_side/plane_walls.hpp"
#include "dem_side/random_streams.hpp"

namespace LAMMPS_NS {
class FixInsertStream;
class LAMMPS;
}  // namespace LAMMPS_NS

namespace demvof {

/// The box that holds the particles, m, and the directions in which it wraps around.
/// One of the script's that moves, or counts as moving.
struct MovedSurface {
  std::string fix, style;  // by which it does
};

struct ParticleDomain {
  Vec3 lower, upper;
  std::array<bool, 3> periodic{};
};

/// The particles of all ranks in a few numbers.
struct ParticleCensus {
  long count = 0;
  double min_diameter = 0, max_diameter = 0;  // m; 0 without particles
  double solid_volume = 0;                    // m3
  double lightest_response = 0;               // smallest mass/(3 pi diameter), kg/m; 0 without particles
  double lowest_density = 0;                  // kg/m3; 0 without particles
  long whole = 0;                             // spheres by themselves, and clumps
};

/// Owner of one LIGGGHTS instance that has read a user's script.
///
/// The script is an ordinary one and is left as it is. It must
///   - use `units si` and spheres (`atom_style granular` or `sphere`),
///   - set a `timestep` and integrate with `fix nve/sphere` (or `fix nve`),
///   - give gravity, if any, by one `fix gravity`.
/// Its own `run` commands are carried out first, without any fluid: a bed can settle there. The
/// coupled run starts from the state in which the script ends. Relative paths in the script count
/// from the folder it lies in: the constructor makes that the working folder.
///
/// A script whose run is to be continued asks the variable ${continued}: 0 at a start, and 1 when it has to
/// read ${restart_file} in place of making a box and particles (docs/howto_your_own_case.md).
///
/// Everything LIGGGHTS prints goes to the log file. When LIGGGHTS itself gives up, the message carries
/// the error line of that file.
class Dem {
 public:
  /// Collective over world, the ranks of this program; LIGGGHTS itself runs on MPI_COMM_WORLD, which OwnWorld
  /// makes the same ranks. script, log: absolute paths. restart_file: what write_restart() of an earlier run
  /// has left, absolute; empty: a start.
  /// Throws InputError when the script is missing, leaves out something of the above, or LIGGGHTS
  /// refuses it.
  Dem(MPI_Comm world, const std::filesystem::path& script, const std::filesystem::path& log,
      const std::filesystem::path& restart_file = {});
  ~Dem();
  Dem(const Dem&) = delete;
  Dem& operator=(const Dem&) = delete;

  /// Computes the forces of the state reached by the script. Once, before the first run; whatever
  /// adds forces is attached before. In a run that goes on they are those of its last step.
  /// Throws InputError when LIGGGHTS finds the script incomplete.
  void set_up();
  /// Calls add_forces again for the state that set_up() has left: the first half step moves with what it
  /// finds now. After set_up(), before the first run().
  void renew_added_forces();
  /// Advances by a number of time steps. Throws SolverStopped when LIGGGHTS gives up.
  void run(int steps);

  /// Throws RunError when not everything that LIGGGHTS has printed came to its log.
  void require_whole_log() const;
  /// Writes particles and contacts, and the state of the script's fixes. Collective; the run goes on as if
  /// nothing had happened.
  void write_restart(const std::filesystem::path& file);
  /// Writes the rows of all particles with the forces on them; file: of rank 0. Collective. set_up() of a run
  /// that goes on finds them beside its restart file.
  void write_rows(const std::filesystem::path& file) const;
  static std::filesystem::path rows_file(std::filesystem::path restart_file) {
    return restart_file += "_rows";
  }
  RandomStates random_states();                // on rank 0 of all ranks; collective
  void go_on_from(const RandomStates& saved);  // after set_up
  long step() const;                           // of LIGGGHTS, the script's own included

  /// With clumps found anew: a call for all particles, none for each.
  ParticleArrays particles() const;
  int mask(int i) const;  // of local particle i
  int type(int i) const;  // of it, from 1
  /// True when LIGGGHTS moves local particle i by the forces on it; false for particles that are frozen,
  /// moved by prescription or not integrated at all. Clumps know none of that.
  bool integrates(int i) const { return clumps_->has(i) || integrates_sphere(mask(i)); }
  /// The same of a sphere by itself with this mask.
  bool integrates_sphere(int mask) const { return (mask & integrated_) && !(mask & frozen_); }
  bool held(int mask) const { return mask & held_; }  // by a fix of the script
  /// An insertion that moves local particle i at the velocity that it prescribes (fix insert/stream, until
  /// the particle has left the insertion's volume): it takes all force from it. With the last step it gives
  /// it a velocity, and forces move it from then on.
  struct Stream {
    bool carries = false;   // i in this step and in the next one
    bool releases = false;  // i: this step is the last
    Vec3 change;            // of the velocity by that, m/s
  };
  Stream stream(int i) const { return stream_ ? found_stream(i) : Stream{}; }
  bool has_stream() const { return stream_; }
  /// True when it turns such a particle by the torque on it.
  bool turns(int mask) const { return (mask & turned_) && !(mask & frozen_); }
  /// True when fix gravity acts on a particle with this mask.
  bool has_weight(int mask) const { return mask & weighed_; }

  MPI_Comm world() const { return world_; }
  double time_step() const;            // s
  ContactTimes contact_times() const;  // collective
  ContactStiffness contact_stiffness() const;
  Vec3 script_gravity() const;  // of fix gravity, m/s2
  /// What acts in place of it from here on, m/s2: the added forces make up for the difference. Throws
  /// InputError when there is no fix gravity to say on which particles.
  void set_gravity(const Vec3& gravity);
  Vec3 gravity() const { return gravity_.value_or(script_gravity()); }
  ParticleDomain domain() const;
  ParticleCensus census() const;                      // collective
  bool has_clumps() const { return bool(*clumps_); }  // fix multisphere
  long whole_particles() const;                       // spheres by themselves, and clumps, of this rank
  bool inserts_particles() const;                     // the script has an insertion that is not over yet
  std::vector<MovedSurface> moved_surfaces() const;
  bool has_surfaces() const;                  // fix mesh/surface
  std::vector<Vec3> surface_corners() const;  // of this rank's triangles, three for each, m
  long inserted() const;                      // particles that its insertions have put in so far, all ranks
  long taken_out() const;  // particles that its outlets (fix massflow/mesh) have deleted so far

  /// One value row per particle that goes with it from rank to rank, and from run to run; rows of new
  /// particles are 0.
  /// Returned pointers: local particle -> row, valid until the next DEM step.
  void add_particle_rows(const std::string& name, int width) { add_rows(name, width, false); }
  double* const* particle_rows(const std::string& name) const;
  /// Rows that are of one step alone, and that ghosts have as well: bring_to_ghosts() gives them those of
  /// their particles. Collective.
  void add_ghost_rows(const std::string& name, int width) { add_rows(name, width, true); }
  void bring_to_ghosts(const std::string& name);

  /// near_surfaces.hpp: what is near in a DEM step, from the next set_up() on at least as far as asked for.
  void reach_further(double radii);
  NearPairs near_pairs() const;
  std::vector<NearWall> near_walls(double radii) const;
  PlaneWalls plane_walls() const;

  /// Calls add_forces in every DEM step, after all other forces and torques are known: to add to
  /// particles.force and particles.torque, and in the last step of a run to note by local particle what it
  /// has added, N; added: nullptr in other steps. Called in set_up() too.
  using AddForces = std::function<void(const ParticleArrays& particles, double* const* added)>;
  void attach(AddForces add_forces);
  /// What the last step of the last run has added to each local particle, N.
  double* const* added_forces() const;

 private:
  template <class Work>
  void guarded(Work&& work);
  template <class Work>
  void by_the_script(Work&& work);
  void add_fix(std::vector<std::string> words);
  void add_rows(const std::string& name, int width, bool for_ghosts);
  void read_rows();
  /// What of local particles is in that file.
  struct Columns {
    std::string name;
    int width;
    double* const* of;
  };
  std::vector<Columns> columns() const;
  Stream found_stream(int i) const;
  static void call_back(void* self, long step, int count, int* id, double** position, double** external);

  MPI_Comm world_;
  std::filesystem::path script_, log_;
  std::unique_ptr<LAMMPS_NS::LAMMPS> liggghts_;
  AddForces add_forces_;
  std::unique_ptr<Clumps> clumps_;
  std::optional<Vec3> gravity_;
  std::vector<std::pair<std::string, int>> kept_rows_;  // names and widths
  std::filesystem::path restart_file_;                  // empty: a start
  LAMMPS_NS::FixInsertStream* stream_ = nullptr;        // the first of the script; all share its rows
  int integrated_ = 0, turned_ = 0, frozen_ = 0, held_ = 0, weighed_ = 0;  // group bits
};

}  // namespace demvof
