// SPDX-License-Identifier: GPL-3.0-or-later
#include "dem_side/possible_particles.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <climits>
#include <cmath>
#include <numeric>
#include <vector>

#include "coupler/base/errors.hpp"
#include "coupler/base/mpi_check.hpp"
#include "coupler/base/sphere.hpp"

namespace demvof {
namespace {

constexpr double largest_speed = 1e6, lowest_density = 1e-3, highest_density = 1e6;  // m/s, kg/m3

bool finite(const double* vector) {
  return std::isfinite(vector[0]) && std::isfinite(vector[1]) && std::isfinite(vector[2]);
}

/// What is wrong with a particle by itself.
std::string objection(const ParticleArrays& all, int i) {
  if (!finite(all.position[i])) return "its place is not a number";
  if (!finite(all.velocity[i]) || norm(vec3(all.velocity[i])) > largest_speed)
    return fmt::format("its velocity is ({:g}, {:g}, {:g}) m/s", all.velocity[i][0], all.velocity[i][1],
                       all.velocity[i][2]);
  if (!finite(all.spin[i])) return "its angular velocity is not a number";
  const double radius = all.radius[i];
  if (!(radius > 0) || !std::isfinite(radius)) return fmt::format("its diameter is {:g} m", 2 * radius);
  const double density = all.mass[i] / all.volume(i);
  if (!(density >= lowest_density && density <= highest_density))
    return fmt::format("its density is {:g} kg/m3; give {:g} to {:g}", density, lowest_density,
                       highest_density);
  return {};
}

struct Found {
  int id = INT_MAX;
  std::string text;
  void take(int of, const std::string& what) {
    if (of < id) *this = {of, what};
  }
};

Found first_impossible(const ParticleArrays& all) {
  Found first;
  for (int i = 0; i < all.count; ++i)
    if (all.id[i] < first.id)
      if (const std::string what = objection(all, i); !what.empty())
        first.take(all.id[i], fmt::format("particle {}: {}", all.id[i], what));
  if (!first.text.empty()) return first;

  std::vector<int> order(static_cast<std::size_t>(all.count));
  std::iota(order.begin(), order.end(), 0);
  const auto place = [&](int i) {
    return std::array{all.position[i][0], all.position[i][1], all.position[i][2]};
  };
  std::sort(order.begin(), order.end(), [&](int i, int j) { return place(i) < place(j); });
  for (std::size_t n = 1; n < order.size(); ++n) {
    const int i = order[n - 1], j = order[n];
    if (place(i) != place(j)) continue;
    const auto [low, high] = std::minmax(all.id[i], all.id[j]);
    first.take(low, fmt::format("particles {} and {} are at one place, ({:g}, {:g}, {:g}) m", low, high,
                                all.position[i][0], all.position[i][1], all.position[i][2]));
  }
  return first;
}

}  // namespace

void require_possible_particles(const ParticleArrays& particles, MPI_Comm world, const std::string& script) {
  Found mine = first_impossible(particles);
  struct {
    int id, rank;
  } first = {mine.id, 0};
  check_mpi(MPI_Comm_rank(world, &first.rank), "MPI_Comm_rank");
  check_mpi(MPI_Allreduce(MPI_IN_PLACE, &first, 1, MPI_2INT, MPI_MINLOC, world), "MPI_Allreduce");
  if (first.id == INT_MAX) return;
  int length = static_cast<int>(mine.text.size());
  check_mpi(MPI_Bcast(&length, 1, MPI_INT, first.rank, world), "MPI_Bcast");
  mine.text.resize(static_cast<std::size_t>(length));
  check_mpi(MPI_Bcast(mine.text.data(), length, MPI_CHAR, first.rank, world), "MPI_Bcast");
  throw InputError(script + ": " + mine.text);
}

}  // namespace demvof
