// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <limits>

#include "coupler/base/mpi_check.hpp"
#include "coupler/base/sphere.hpp"
#include "dem_side/dem.hpp"

namespace demvof {

long Dem::whole_particles() const {
  const ParticleArrays local = particles();
  if (!has_clumps()) return local.count;
  long whole = clumps_->count();
  for (int i = 0; i < local.count; ++i) whole += !local.in_clump(i);
  return whole;
}

ParticleCensus Dem::census() const {
  const ParticleArrays local = particles();
  double sums[3] = {static_cast<double>(local.count), 0, static_cast<double>(whole_particles())};
  constexpr double none = std::numeric_limits<double>::max();
  double extremes[4] = {-none, 0, -none, -none};  // -smallest, largest radius; -smallest mass/radius, density
  for (int i = 0; i < local.count; ++i) {
    sums[1] += local.volume(i);
    extremes[0] = std::max(extremes[0], -local.radius[i]);
    extremes[1] = std::max(extremes[1], local.radius[i]);
    extremes[2] =
        std::max(extremes[2], -local.mass[i] / (0.5 * local.drag_share(i) * local.drag_diameter(i)));
    extremes[3] = std::max(extremes[3], -local.mass[i] / local.volume(i));
  }
  check_mpi(MPI_Allreduce(MPI_IN_PLACE, sums, 3, MPI_DOUBLE, MPI_SUM, world_), "MPI_Allreduce");
  check_mpi(MPI_Allreduce(MPI_IN_PLACE, extremes, 4, MPI_DOUBLE, MPI_MAX, world_), "MPI_Allreduce");
  const long count = std::lround(sums[0]);
  if (count == 0) return {};
  return {count,        -2 * extremes[0],    2 * extremes[1], sums[1], -extremes[2] / (6 * pi),
          -extremes[3], std::lround(sums[2])};
}

}  // namespace demvof
