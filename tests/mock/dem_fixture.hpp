// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Small LIGGGHTS scenes for tests: scripts are written into a folder of the test's own and read by
// the real Dem.

#include <gtest/gtest.h>
#include <mpi.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <memory>
#include <string>
#include <system_error>
#include <vector>

#include "dem_side/dem.hpp"

namespace demvof_test {

using demvof::Vec3;

/// The beads of the dam break.
constexpr double bead_diameter = 2.7e-3, bead_density = 2500;
constexpr double pi = 3.14159265358979323846;
constexpr double bead_volume = pi / 6 * bead_diameter * bead_diameter * bead_diameter;
constexpr double bead_mass = bead_density * bead_volume;

/// A box of 0.1 x 0.1 x 0.4 m with contact parameters and nothing in it.
inline std::string empty_box(double time_step, const std::string& boundary = "f f f") {
  return "units si\natom_style granular\natom_modify map array\nboundary " + boundary +
         "\nnewton off\ncommunicate single vel yes\n"
         "region box block 0 0.1 0 0.1 0 0.4 units box\ncreate_box 1 box\n"
         "neighbor 0.001 bin\nneigh_modify delay 0\n"
         "fix m1 all property/global kn peratomtypepair 1 1000.\n"
         "fix m2 all property/global kt peratomtypepair 1 285.\n"
         "fix m3 all property/global gamman peratomtypepair 1 590.\n"
         "fix m4 all property/global gammat peratomtypepair 1 295.\n"
         "fix m5 all property/global coefficientFriction peratomtypepair 1 0.3\n"
         "pair_style gran model hooke/stiffness tangential history\npair_coeff * *\n"
         "timestep " +
         std::to_string(time_step) + "\n";
}

/// Puts one bead of the given size into the scene; commands in order, numbered from 1.
inline std::string bead(const Vec3& at) {
  return "create_atoms 1 single " + std::to_string(at.x) + " " + std::to_string(at.y) + " " +
         std::to_string(at.z) + " units box\n";
}
inline std::string bead_properties() {
  return "set group all diameter " + std::to_string(bead_diameter) + " density " +
         std::to_string(bead_density) + "\n";
}
/// What a function gives for each local particle.
template <class Of>
auto all_of(const Of& of, const demvof::Dem& dem) {
  std::vector<decltype(of(0))> all;
  for (int i = 0; i < dem.particles().count; ++i) all.push_back(of(i));
  return all;
}

inline const char* gravity = "fix g all gravity 9.81 vector 0 0 -1\n";
inline const char* integrate = "fix integrate all nve/sphere\n";

/// A new folder's name, the same on all ranks and of no other run.
inline std::filesystem::path scene_folder(const std::string& name, MPI_Comm world) {
  int process = getpid();
  MPI_Bcast(&process, 1, MPI_INT, 0, world);
  return std::filesystem::temp_directory_path() / ("demvof_" + name + "_" + std::to_string(process));
}

/// Writes a script into a new folder and has it read.
class Scene {
 public:
  Scene(const std::string& name, const std::string& script, MPI_Comm world = MPI_COMM_WORLD,
        const std::filesystem::path& restart_file = {})
      : world_(world), folder_(scene_folder(name, world)) {
    int rank;
    MPI_Comm_rank(world, &rank);
    if (rank == 0) {
      std::filesystem::create_directories(folder_);
      std::ofstream(folder_ / "in.scene") << script;
    }
    MPI_Barrier(world);
    dem = std::make_unique<demvof::Dem>(world, folder_ / "in.scene", folder_ / "particles.log", restart_file);
  }

  ~Scene() {
    dem.reset();
    std::filesystem::current_path(std::filesystem::temp_directory_path());
    MPI_Barrier(world_);
    int rank;
    MPI_Comm_rank(world_, &rank);
    std::error_code none;
    if (rank == 0)
      std::filesystem::remove_all(folder_, none);  // another one would meet the test's next scene
  }
  Scene(const Scene&) = delete;
  Scene& operator=(const Scene&) = delete;

  std::unique_ptr<demvof::Dem> dem;

 private:
  MPI_Comm world_;
  std::filesystem::path folder_;
};

}  // namespace demvof_test
