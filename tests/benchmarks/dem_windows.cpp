// SPDX-License-Identifier: GPL-3.0-or-later
// What dem_side does in windows, with bulk fluids that stay as they are in place of the other side: particles
// of a script in water and air, averaging as in cases/many_particles.
//
//   dem_windows SCRIPT LEVEL WINDOWS STEPS [FILE]
//
// The bulk grid is that of the script's box, cells of 20 mm; LEVEL: of the water, m. Prints nanoseconds of
// CPU per particle and window, or DEM step; FILE gets what particles and bulk cells have at the end,
// particles by their numbers.

#include <mpi.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "coupler/transfer/averaging.hpp"
#include "dem_side/forces.hpp"
#include "tests/benchmarks/cpu_seconds.hpp"

namespace {

using namespace demvof;

/// What the other side would tell: fluids that differ from place to place, and a surface that is not level.
struct Fluids {
  CellValues<BulkFluid> means[2];
  CellValues<BulkSurface> surface;
};

Fluids fluids_on(const BulkGrid& grid, double level) {
  Fluids all;
  const Vec3 normal = Vec3{0.1, 0.05, 1} / norm({0.1, 0.05, 1});
  const Vec3 middle{0.5 * (grid.lower().x + grid.upper().x), 0.5 * (grid.lower().y + grid.upper().y), level};
  for (CellId cell = 0; cell < grid.cell_count(); ++cell) {
    const Vec3 centre = grid.cell_centre(grid.ijk(cell));
    const double offset = dot(normal, middle - centre);
    const double liquid = share_of_box_below(normal, offset, grid.spacing());
    for (int k = 0; k < 2; ++k) {
      BulkFluid fluid;
      fluid.density = (k == 0 ? liquid > 0 : liquid < 1) ? (k == 0 ? 1000 : 1.2) : 0;
      fluid.viscosity = k == 0 ? 1e-3 : 1.8e-5;
      fluid.velocity = {0.1 * std::sin(20 * centre.z), 0.2 * centre.x, -0.3 * std::cos(9 * centre.y)};
      fluid.pressure_gradient = {0, 30 * centre.x, -9.81 * fluid.density};
      fluid.void_fraction = 0.6 + 0.3 * std::sin(50 * centre.z) * std::sin(30 * centre.x);
      fluid.left_over = {1e-9 * centre.x, 0, 2e-9 * centre.z};
      all.means[k].cells.push_back(cell);
      all.means[k].values.push_back(fluid);
    }
    if (liquid == 0) continue;
    all.surface.cells.push_back(cell);
    all.surface.values.push_back({liquid, liquid < 1 ? normal : Vec3{}, offset});
  }
  return all;
}

void write(const char* file, const Dem& dem, const FluidForces& forces, const Averaging& averaging) {
  const ParticleArrays local = dem.particles();
  std::map<int, std::vector<double>> by_id;
  for (int i = 0; i < local.count; ++i) {
    std::vector<double>& all = by_id[local.id[i]];
    for (const Vec3& vector : {vec3(local.velocity[i]), vec3(local.position[i]), vec3(local.force[i]),
                               forces.drag_impulse(i), forces.pressure_force(i)})
      for (const double value : {vector.x, vector.y, vector.z}) all.push_back(value);
    for (int k = 0; k < 2; ++k) all.push_back(forces.drag_tangent(i, k));
  }
  std::FILE* out = std::fopen(file, "wb");
  for (const auto& [id, values] : by_id) std::fwrite(values.data(), sizeof(double), values.size(), out);
  for (int k = 0; k < averaging.fluids(); ++k) {
    const CellValues<BulkParticles>& cells = averaging.in(k).deposited();
    std::fwrite(cells.values.data(), sizeof(BulkParticles), cells.values.size(), out);
  }
  std::fclose(out);
}

}  // namespace

int main(int argc, char** argv) {
  MPI_Init(&argc, &argv);
  if (argc < 5) return 2;
  const int windows = std::atoi(argv[3]), steps = std::atoi(argv[4]);
  Dem dem(MPI_COMM_WORLD, std::filesystem::absolute(argv[1]),
          std::filesystem::temp_directory_path() / (std::to_string(getpid()) + ".dem_windows.log"));
  ForceParameters parameters;
  parameters.drag = DragLaw::schiller_naumann;
  FluidForces forces(dem, parameters);
  dem.set_up();
  const ParticleDomain box = dem.domain();
  std::array<int, 3> cells;
  for (int axis = 0; axis < 3; ++axis)
    cells[axis] = std::max(1, static_cast<int>(std::lround((box.upper[axis] - box.lower[axis]) / 0.02)));
  const BulkGrid grid(box.lower, box.upper, cells, box.periodic);
  const Fluids fluids = fluids_on(grid, std::atof(argv[2]));
  const int count = dem.particles().count;
  Averaging averaging(MPI_COMM_WORLD, grid, BulkPartition(cells, 1), {});
  averaging.set_openings({});
  averaging.see(fluids.surface);
  double seconds[4] = {};
  double start = cpu_seconds();
  const auto took = [&](double& sum) { sum += cpu_seconds() - std::exchange(start, cpu_seconds()); };
  const auto deposit = [&] {
    averaging.weigh(spheres(dem.particles()));
    took(seconds[2]);
    for (int k = 0; k < 2; ++k)
      averaging.in(k).deposit_with<Support>(
          [&, of = forces.contributions(k), support = forces.support(k), keep = forces.keep_to(k)](int i) {
            if (!averaging.in(1 - k).reached_by(i)) keep(i);
            return AveragingInFluid::With<Support>{of(i), support(i)};
          });
    took(seconds[3]);
  };
  deposit();
  std::fill_n(seconds, 4, 0);
  for (int n = 0; n < windows; ++n) {
    start = cpu_seconds();
    FluidsAtParticles felt;
    for (int k = 0; k < 2; ++k) felt.fluid[k] = averaging.in(k).sample(fluids.means[k]);
    felt.surface = averaging.surface_at(spheres(dem.particles()));
    forces.begin_window(felt, steps * dem.time_step());
    if (n == 0) forces.first_half_step();
    took(seconds[0]);
    dem.run(steps);
    took(seconds[1]);
    deposit();
  }
  const double per_window = 1e9 / windows / count;
  std::printf("%d: begin %.1f, weigh %.1f, deposit %.1f, all %.1f ns per window; step %.2f ns\n", count,
              per_window * seconds[0], per_window * seconds[2], per_window * seconds[3],
              per_window * (seconds[0] + seconds[2] + seconds[3]), per_window / steps * seconds[1]);
  if (argc > 5) write(argv[5], dem, forces, averaging);
  MPI_Finalize();
}
