// SPDX-License-Identifier: GPL-3.0-or-later
#include "dem_side/dem.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <exception>
#include <fstream>

#include "atom.h"
#include "coupler/base/errors.hpp"
#include "coupler/base/mpi_check.hpp"
#include "dem_side/script_advice.hpp"
#include "dem_side/script_requirements.hpp"
#include "domain.h"
#include "fix_gravity.h"
#include "fix_insert_stream.h"
#include "fix_mesh_surface.h"
#include "fix_property_atom.h"
#include "input.h"
#include "lammps.h"
#include "modify.h"
#include "update.h"
#include "write_restart.h"

namespace demvof {
namespace {

/// LIGGGHTS talks to standard output where it reads a restart file; what matters goes to its log.
class Hush {
 public:
  Hush() : kept_(dup(STDOUT_FILENO)) {
    std::fflush(stdout);
    if (std::FILE* nothing = std::fopen("/dev/null", "w")) {
      dup2(fileno(nothing), STDOUT_FILENO);
      std::fclose(nothing);
    }
  }
  ~Hush() {
    std::fflush(stdout);
    dup2(kept_, STDOUT_FILENO);
    close(kept_);
  }
  Hush(const Hush&) = delete;
  Hush& operator=(const Hush&) = delete;

 private:
  int kept_;
};

namespace fs = std::filesystem;

// The last error that LIGGGHTS wrote; its own words say best what it did not like.
std::string error_line(const fs::path& log) {
  std::fflush(nullptr);
  std::ifstream lines(log);
  std::string last;
  for (std::string line; std::getline(lines, line);)
    if (line.find("ERROR") != std::string::npos) last = line;
  return last.empty() ? "no error message in " + log.string() : last;
}

bool is_insertion(const LAMMPS_NS::Fix& fix) {
  return std::string_view(fix.style).substr(0, 7) == "insert/";
}

template <class Function>
void for_each_fix(const LAMMPS_NS::LAMMPS& liggghts, Function&& function) {
  for (int i = 0; i < liggghts.modify->nfix; ++i) function(*liggghts.modify->fix[i]);
}

}  // namespace

Dem::Dem(MPI_Comm world, const fs::path& script, const fs::path& log, const fs::path& restart_file)
    : world_(world), script_(script), log_(log), restart_file_(restart_file) {
  if (!fs::is_regular_file(script))
    throw InputError(fmt::format("particles.script: there is no file {}", script.string()));
  refuse_before_it_is_read(script);
  fs::current_path(script.parent_path());

  // A region prints to the screen even when there is none (a crash in 3.8): it gets a file instead.
  std::vector<std::string> words = {"dem_side", "-screen", log.string(), "-log", "none", "-nocite"};
  words.insert(words.end(), {"-var", "continued", restart_file.empty() ? "0" : "1"});
  words.insert(words.end(), {"-var", "restart_file", restart_file.empty() ? "none" : restart_file.string()});
  std::vector<char*> arguments;
  for (std::string& word : words) arguments.push_back(word.data());
  by_the_script([&] {
    const Hush hush;
    // It looks at no return code: errors of MPI_COMM_WORLD end the program, those of world are returned.
    liggghts_ = std::make_unique<LAMMPS_NS::LAMMPS>(static_cast<int>(arguments.size()), arguments.data(),
                                                    MPI_COMM_WORLD);
    liggghts_->input->file(script.c_str());
  });
  require_coupled_scene(*liggghts_, script.string());
  clumps_ = std::make_unique<Clumps>(*liggghts_);

  for_each_fix(*liggghts_, [&](LAMMPS_NS::Fix& fix) {
    if (!stream_) stream_ = dynamic_cast<LAMMPS_NS::FixInsertStream*>(&fix);
    const std::string_view style = fix.style;
    if (style == "nve/sphere" || style == "nve") integrated_ |= fix.groupbit;
    if (style == "nve/sphere") turned_ |= fix.groupbit;
    if (style == "freeze") frozen_ |= fix.groupbit;
    if (style == "freeze" || style == "move" || style == "nve/noforce") held_ |= fix.groupbit;
    if (style == "gravity") weighed_ |= fix.groupbit;
  });
}

// A LIGGGHTS that has given up is in no state to be taken down, and its destructor may talk to ranks
// that no longer listen: when something failed, the instance is left to the end of the process.
Dem::~Dem() {
  if (std::uncaught_exceptions() > 0) liggghts_.release();
}

template <class Work>
void Dem::guarded(Work&& work) {
  try {
    work();
  } catch (const SolverStopped&) {
    liggghts_.release();
    throw SolverStopped("LIGGGHTS stopped: " + error_line(log_));
  }
}

// What LIGGGHTS refuses before the first step is a mistake in the script.
template <class Work>
void Dem::by_the_script(Work&& work) {
  try {
    guarded(work);
  } catch (const SolverStopped& stop) {
    const std::string advice = advice_on(stop.what(), script_);
    throw InputError(script_.string() + ": " + stop.what() + (advice.empty() ? "" : "\n" + advice));
  }
}

// LIGGGHTS would begin a run with forces from the velocities of the whole step; the step before used those of
// the half. The forces of that are part of the state.
void Dem::set_up() {
  by_the_script([&] { liggghts_->input->one("run 0 post no"); });
  if (restart_file_.empty()) return;
  read_rows();
  if (has_clumps()) clumps_->renew_forces();
}

// "pre no" goes on from where the last step ended: forces and neighbour lists are kept.
void Dem::run(int steps) {
  guarded([&] { liggghts_->input->one(fmt::format("run {} pre no post no", steps).c_str()); });
}

void Dem::require_whole_log() const {
  std::FILE* log = liggghts_->screen;
  errno = 0;
  if (log && (std::fflush(log) != 0 || std::ferror(log) != 0))
    throw RunError(
        fmt::format("cannot write {}: {}", log_.string(), errno ? std::strerror(errno) : "an earlier error"));
}

void Dem::write_restart(const fs::path& file) {
  guarded([&] {
    // What LIGGGHTS knows of contacts is in its neighbour list; the file takes what is with the particles.
    for_each_fix(*liggghts_, [](LAMMPS_NS::Fix& fix) {
      if (std::string_view(fix.style) == "contacthistory") fix.setup_pre_exchange();
    });
    // Particles that left a periodic box after the last neighbour list are wrapped in the file: read_restart
    // takes none from outside.
    liggghts_->modify->restart_pbc_any = 1;
    std::string name = file.string();
    LAMMPS_NS::WriteRestart(liggghts_.get()).write(name.data());
  });
}

RandomStates Dem::random_states() {
  RandomStates here = demvof::random_states(*liggghts_);
  const int streams = static_cast<int>(here.names.size());
  int ranks;
  check_mpi(MPI_Comm_size(world_, &ranks), "MPI_Comm_size");
  std::vector<int> all(static_cast<std::size_t>(ranks) * here.names.size());
  check_mpi(MPI_Gather(here.states[0].data(), streams, MPI_INT, all.data(), streams, MPI_INT, 0, world_),
            "MPI_Gather");
  here.states.clear();
  for (auto row = all.begin(); row != all.end(); row += streams) here.states.emplace_back(row, row + streams);
  return here;
}

void Dem::go_on_from(const RandomStates& saved) {
  int rank, ranks;
  check_mpi(MPI_Comm_rank(world_, &rank), "MPI_Comm_rank");
  check_mpi(MPI_Comm_size(world_, &ranks), "MPI_Comm_size");
  set_random_states(*liggghts_, saved, rank, ranks);
}

long Dem::step() const {
  return static_cast<long>(liggghts_->update->ntimestep);
}

ParticleArrays Dem::particles() const {
  const LAMMPS_NS::Atom& atom = *liggghts_->atom;
  ParticleArrays all = {atom.nlocal, atom.x,      atom.v,     atom.f,   atom.omega,
                        atom.torque, atom.radius, atom.rmass, atom.tag, atom.mask};
  if (!has_clumps()) return all;
  const Clumps::Spheres spheres = clumps_->spheres();
  all.mass = spheres.mass;
  all.of_clump = spheres.of_clump;
  all.clumps = spheres.bodies;
  all.off_centre = spheres.off_centre;
  return all;
}

int Dem::mask(int i) const {
  return liggghts_->atom->mask[i];
}

double Dem::time_step() const {
  return liggghts_->update->dt;
}

int Dem::type(int i) const {
  return liggghts_->atom->type[i];
}

ContactStiffness Dem::contact_stiffness() const {
  return ContactStiffness(*liggghts_);
}

ContactTimes Dem::contact_times() const {
  return shortest_contact_times(*liggghts_);
}

Vec3 Dem::script_gravity() const {
  Vec3 gravity;
  for_each_fix(*liggghts_, [&](LAMMPS_NS::Fix& fix) {
    double components[3];
    if (auto* found = dynamic_cast<LAMMPS_NS::FixGravity*>(&fix)) {
      found->get_gravity(components);
      gravity = vec3(components);
    }
  });
  return gravity;
}

void Dem::set_gravity(const Vec3& gravity) {
  if (!weighed_)
    throw InputError(fmt::format(
        "{}: gravity.table needs a 'fix gravity' (fix g all gravity 9.81 vector 0 0 -1), which says on which "
        "particles gravity acts",
        script_.string()));
  gravity_ = gravity;
}

ParticleDomain Dem::domain() const {
  const LAMMPS_NS::Domain& box = *liggghts_->domain;
  return {vec3(box.boxlo), vec3(box.boxhi), {box.xperiodic != 0, box.yperiodic != 0, box.zperiodic != 0}};
}

bool Dem::inserts_particles() const {
  bool inserts = false;
  for_each_fix(*liggghts_, [&](const LAMMPS_NS::Fix& fix) {
    inserts |= is_insertion(fix) && fix.next_reneighbor > liggghts_->update->ntimestep;
  });
  return inserts;
}

Dem::Stream Dem::found_stream(int i) const {
  // LIGGGHTS's row: place (0 to 2), step of insertion (3; 0: not of a stream) and of release (4), velocity
  // before (5 to 7) and after it (8 to 10)
  const double* row = stream_->fix_prop_release()->array_atom[i];
  const auto step = static_cast<double>(liggghts_->update->ntimestep);
  if (row[3] == 0 || step > row[4] + 0.5) return {};
  if (step < row[4] - 0.5) return {true, false, {}};
  return {false, true, vec3(row + 8) - vec3(row + 5)};
}

std::vector<MovedSurface> Dem::moved_surfaces() const {
  std::vector<MovedSurface> fixes;
  for_each_fix(*liggghts_, [&](LAMMPS_NS::Fix& fix) {
    auto* surface = dynamic_cast<LAMMPS_NS::FixMeshSurface*>(&fix);  // with surface_vel, surface_ang_vel
    if (std::string_view(fix.style) == "move/mesh" || (surface && surface->surfaceVel()) ||
        fix_has_word(script_, fix.id, "shear"))
      fixes.push_back({fix.id, fix.style});
  });
  return fixes;
}

bool Dem::has_surfaces() const {
  bool found = false;
  for_each_fix(*liggghts_,
               [&](LAMMPS_NS::Fix& fix) { found = found || dynamic_cast<LAMMPS_NS::FixMeshSurface*>(&fix); });
  return found;
}

std::vector<Vec3> Dem::surface_corners() const {
  std::vector<Vec3> corners;
  for_each_fix(*liggghts_, [&](LAMMPS_NS::Fix& fix) {
    auto* surface = dynamic_cast<LAMMPS_NS::FixMeshSurface*>(&fix);
    if (!surface) return;
    LAMMPS_NS::AbstractMesh& mesh = *surface->mesh();
    for (int triangle = 0; triangle < mesh.sizeLocal(); ++triangle)
      for (int corner = 0; corner < 3; ++corner) {
        double place[3];
        mesh.node_slow(triangle, corner, place);
        corners.push_back(vec3(place));
      }
  });
  return corners;
}

long Dem::inserted() const {
  long inserted = 0;
  for_each_fix(*liggghts_, [&](LAMMPS_NS::Fix& fix) {
    if (is_insertion(fix)) inserted += std::lround(fix.compute_vector(0));
  });
  return inserted;
}

long Dem::taken_out() const {
  constexpr int deleted = 5;  // of the fix's vector: particles it has deleted
  long taken = 0;
  for_each_fix(*liggghts_, [&](LAMMPS_NS::Fix& fix) {
    if (std::string_view(fix.style) == "massflow/mesh") taken += std::lround(fix.compute_vector(deleted));
  });
  return taken;
}

void Dem::add_fix(std::vector<std::string> words) {
  std::vector<char*> arguments;
  for (std::string& word : words) arguments.push_back(word.data());
  guarded([&] { liggghts_->modify->add_fix(static_cast<int>(arguments.size()), arguments.data()); });
}

void Dem::add_rows(const std::string& name, int width, bool for_ghosts) {
  // communication to ghosts and back; zeros for new particles. LIGGGHTS would put them into its restart file
  // from one buffer for all particles: row_file.cpp
  width = std::max(width, 2);  // LIGGGHTS takes no vector of one
  std::vector<std::string> words = {name, "all", "property/atom", name, "vector", "no", "no", "no"};
  if (for_ghosts)
    words[6] = "yes";
  else
    kept_rows_.emplace_back(name, width);
  words.insert(words.end(), width, "0.0");
  add_fix(std::move(words));
}

void Dem::bring_to_ghosts(const std::string& name) {
  auto* rows = dynamic_cast<LAMMPS_NS::FixPropertyAtom*>(liggghts_->modify->find_fix_id(name.c_str()));
  rows->do_forward_comm();
}

double* const* Dem::particle_rows(const std::string& name) const {
  return liggghts_->modify->find_fix_id(name.c_str())->array_atom;
}

}  // namespace demvof
