// SPDX-License-Identifier: GPL-3.0-or-later
#include "dem_side/particle_grid.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "coupler/base/errors.hpp"
#include "coupler/base/mpi_check.hpp"

namespace demvof {
namespace {

void require_same_period(const BulkGridParameters& grid, const ParticleDomain& box) {
  for (int axis = 0; axis < 3; ++axis) {
    if (!box.periodic[axis]) continue;
    const double tolerance = 1e-9 * (box.upper[axis] - box.lower[axis]);
    if (std::abs(grid.lower[axis] - box.lower[axis]) > tolerance ||
        std::abs(grid.upper[axis] - box.upper[axis]) > tolerance)
      throw InputError(fmt::format(
          "bulk_grid: from {} to {} m along {}, but the particles' box is periodic there, from {} to {} m: "
          "the two must be the same",
          grid.lower[axis], grid.upper[axis], "xyz"[axis], box.lower[axis], box.upper[axis]));
  }
}

// Lengths in the wrong unit and boxes in the wrong place show here.
void require_particles_inside(const BulkGridParameters& grid, const Dem& dem) {
  const ParticleArrays particles = dem.particles();
  constexpr double lowest = std::numeric_limits<double>::lowest();
  double extent[6] = {lowest, lowest, lowest, lowest, lowest, lowest};  // -smallest, largest coordinates
  for (int i = 0; i < particles.count; ++i)
    for (int axis = 0; axis < 3; ++axis) {
      extent[axis] = std::max(extent[axis], -particles.position[i][axis]);
      extent[3 + axis] = std::max(extent[3 + axis], particles.position[i][axis]);
    }
  check_mpi(MPI_Allreduce(MPI_IN_PLACE, extent, 6, MPI_DOUBLE, MPI_MAX, dem.world()), "MPI_Allreduce");
  if (extent[3] == lowest) return;
  for (int axis = 0; axis < 3; ++axis)
    if (-extent[axis] < grid.lower[axis] || extent[3 + axis] > grid.upper[axis])
      throw InputError(
          fmt::format("bulk_grid: from {} to {} m along {}, but there are particles from {:.6g} to {:.6g} m: "
                      "the bulk grid "
                      "must hold all of them at the start",
                      grid.lower[axis], grid.upper[axis], "xyz"[axis], -extent[axis], extent[3 + axis]));
}

}  // namespace

BulkGrid particle_grid(const BulkGridParameters& parameters, const Dem& dem) {
  const ParticleDomain box = dem.domain();
  require_same_period(parameters, box);
  require_particles_inside(parameters, dem);
  return BulkGrid(parameters.lower, parameters.upper, parameters.cells, box.periodic);
}

}  // namespace demvof
