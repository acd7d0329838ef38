// SPDX-License-Identifier: GPL-3.0-or-later
#include "dem_side/first_look.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <vector>

#include "coupler/base/mpi_check.hpp"

namespace demvof {
namespace {

constexpr long most = 1000;  // particles that stand for all; so many are looked at one by one

/// Places and velocities, six numbers each, of every so many-th particle of all ranks.
std::vector<double> some_particles(const Dem& dem) {
  const ParticleArrays all = dem.particles();
  const long every = std::max(1L, (dem.census().count + most - 1) / most);
  std::vector<double> here;
  for (int i = 0; i < all.count; ++i)
    if (all.id[i] % every == 0)
      for (const double* of : {all.position[i], all.velocity[i]}) here.insert(here.end(), of, of + 3);
  int rank, ranks;
  check_mpi(MPI_Comm_rank(dem.world(), &rank), "MPI_Comm_rank");
  check_mpi(MPI_Comm_size(dem.world(), &ranks), "MPI_Comm_size");
  std::vector<int> counts(ranks), starts(ranks);
  const int count = static_cast<int>(here.size());
  check_mpi(MPI_Gather(&count, 1, MPI_INT, counts.data(), 1, MPI_INT, 0, dem.world()), "MPI_Gather");
  for (int r = 1; r < ranks; ++r) starts[r] = starts[r - 1] + counts[r - 1];
  std::vector<double> everywhere(rank == 0 ? starts.back() + counts.back() : 0);
  check_mpi(MPI_Gatherv(here.data(), count, MPI_DOUBLE, everywhere.data(), counts.data(), starts.data(),
                        MPI_DOUBLE, 0, dem.world()),
            "MPI_Gatherv");
  return everywhere;
}

struct Fastest {
  double speed = 0;
  int id = 0;
};

Fastest fastest(const Dem& dem) {
  const ParticleArrays all = dem.particles();
  Fastest found;
  for (int i = 0; i < all.count; ++i)
    if (const double speed = norm(vec3(all.velocity[i])); speed > found.speed) found = {speed, all.id[i]};
  check_mpi(MPI_Allreduce(MPI_IN_PLACE, &found, 1, MPI_DOUBLE_INT, MPI_MAXLOC, dem.world()), "MPI_Allreduce");
  return found;
}

double highest_density(const Dem& dem) {
  const ParticleArrays all = dem.particles();
  double highest = 0;
  for (int i = 0; i < all.count; ++i) highest = std::max(highest, all.mass[i] / all.volume(i));
  check_mpi(MPI_Allreduce(MPI_IN_PLACE, &highest, 1, MPI_DOUBLE, MPI_MAX, dem.world()), "MPI_Allreduce");
  return highest;
}

bool any_held(const Dem& dem) {
  const ParticleArrays all = dem.particles();
  int held = 0;
  for (int i = 0; i < all.count; ++i) held = held || dem.held(all.mask[i]);
  check_mpi(MPI_Allreduce(MPI_IN_PLACE, &held, 1, MPI_INT, MPI_MAX, dem.world()), "MPI_Allreduce");
  return held != 0;
}

}  // namespace

nlohmann::json first_look(const Dem& dem) {
  const PlaneWalls walls = dem.plane_walls();
  nlohmann::json planes = nlohmann::json::array();
  for (const PlaneWall& wall : walls.planes)
    planes.push_back({{"fix", wall.fix}, {"axis", wall.axis}, {"at", wall.at}});
  const Fastest quick = fastest(dem);
  return {{"particles", some_particles(dem)}, {"fastest", quick.speed},    {"fastest_id", quick.id},
          {"heaviest", highest_density(dem)}, {"any_held", any_held(dem)}, {"planes", planes},
          {"other_walls", walls.others}};
}

}  // namespace demvof
