// SPDX-License-Identifier: GPL-3.0-or-later
// What demvof adds to a DEM step: particles of a script in a fluid that stays as it is, beside plain
// LIGGGHTS.
//
//   dem_steps SCRIPT plain|gas|liquid WINDOWS STEPS [FILE]
//
// Prints nanoseconds of CPU per particle and DEM step, and per particle and window for what is done between;
// FILE gets velocities and what the particles received, by their numbers.

#include <mpi.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "dem_side/forces.hpp"
#include "tests/benchmarks/cpu_seconds.hpp"

namespace {

using namespace demvof;

void write(const char* file, const Dem& dem, const FluidForces& forces) {
  const ParticleArrays local = dem.particles();
  std::map<int, std::vector<double>> by_id;
  for (int i = 0; i < local.count; ++i) {
    std::vector<double>& all = by_id[local.id[i]];
    for (int k = 0; k < 2; ++k) {
      const BulkParticles of = forces.contributions(k)(i);
      for (const double value :
           {of.drag_impulse.x, of.drag_impulse.y, of.drag_impulse.z, of.drag_factor, of.drag_tangent,
            of.solid_flux.x, of.solid_flux.y, of.solid_flux.z, of.drag_response})
        all.push_back(value);
    }
    for (const Vec3& vector : {vec3(local.velocity[i]), vec3(local.position[i]), vec3(local.force[i])})
      for (const double value : {vector.x, vector.y, vector.z}) all.push_back(value);
  }
  std::FILE* out = std::fopen(file, "wb");
  for (const auto& [id, values] : by_id) std::fwrite(values.data(), sizeof(double), values.size(), out);
  std::fclose(out);
}

}  // namespace

int main(int argc, char** argv) {
  MPI_Init(&argc, &argv);
  if (argc < 5) return 2;
  const std::string mode = argv[2];
  const int windows = std::atoi(argv[3]), steps = std::atoi(argv[4]);
  const std::filesystem::path script = std::filesystem::absolute(argv[1]);
  Dem dem(MPI_COMM_WORLD, script,
          std::filesystem::temp_directory_path() / (std::to_string(getpid()) + ".dem_steps.log"));
  ForceParameters parameters;
  parameters.drag = DragLaw::schiller_naumann;
  std::unique_ptr<FluidForces> forces;
  if (mode != "plain") forces = std::make_unique<FluidForces>(dem, parameters);
  dem.set_up();
  const int count = dem.particles().count;
  const FluidAtParticle none{{}, {}, 0, 0, {}}, air{{}, {0, 0, -9.81 * 1.2}, 1.2, 1.8e-5, {}},
      water{{}, {0, 0, -9810}, 1000, 1e-3, {}};
  double in_steps = 0, between = 0;
  for (int n = 0; n < windows; ++n) {
    const double start = cpu_seconds();
    if (forces) {
      FluidsAtParticles felt;
      felt.fluid[0] = [&](int) { return mode == "liquid" ? water : none; };
      felt.fluid[1] = [&](int) { return mode == "liquid" ? none : air; };
      felt.surface = [](int) { return SeenSurface{}; };
      forces->begin_window(felt, steps * dem.time_step());
      if (n == 0) forces->first_half_step();
    }
    const double begun = cpu_seconds();
    dem.run(steps);
    const double done = cpu_seconds();
    between += begun - start;
    in_steps += done - begun;
  }
  std::printf("%s %d: %.2f ns per step, %.1f ns per window\n", mode.c_str(), count,
              1e9 * in_steps / windows / steps / count, 1e9 * between / windows / count);
  if (forces && argc > 5) write(argv[5], dem, *forces);
  forces.reset();
  MPI_Finalize();
}
