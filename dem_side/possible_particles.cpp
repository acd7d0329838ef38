// SPDX-License-Identifier: GPL-3.0-or-later
#include "dem_side/possible_particles.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <climits>
#include <cmath>
#include <functional>
#include <numeric>
#include <vector>

#include "coupler/base/errors.hpp"
#include "coupler/base/mpi_check.hpp"
#include "coupler/base/sphere.hpp"
#include "lmptype.h"

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

/// Of two spheres, of the smaller one's radius: contacts of so much are no contacts, and throw them apart.
constexpr double deepest = 0.5;

Found first_deep_overlap(const ParticleArrays& all, const NearPairs& pairs,
                         const std::function<bool(int)>& held) {
  Found first;
  for (int row = 0; row < pairs.rows; ++row) {
    const int i = pairs.particle[row];
    for (int n = 0; n < pairs.partners[i]; ++n) {
      const int j = pairs.partner[i][n] & NEIGHMASK;
      const double overlap =
          all.radius[i] + all.radius[j] - norm(vec3(all.position[i]) - vec3(all.position[j]));
      if (overlap <= deepest * std::min(all.radius[i], all.radius[j])) continue;
      const bool ghost = j >= all.count;
      if (!ghost && all.in_clump(i) && all.in_clump(j) && all.of_clump[i].clump == all.of_clump[j].clump)
        continue;
      if (!ghost && held(i) && held(j)) continue;  // a shape made of spheres
      const auto [low, high] = std::minmax(all.id[i], all.id[j]);
      if (low == high) continue;
      first.take(
          low, fmt::format("particles {} and {} overlap by {:.3g} m, {:.2g} of the smaller one's radius: "
                           "their contact would throw them apart. Smaller spheres ('set ... diameter'), or "
                           "more room between them; a shape made of spheres: fix multisphere, or fix freeze",
                           low, high, overlap, overlap / std::min(all.radius[i], all.radius[j])));
    }
  }
  return first;
}

void refuse(Found mine, MPI_Comm world, const std::string& script) {
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

}  // namespace

void require_possible_particles(const ParticleArrays& particles, MPI_Comm world, const std::string& script) {
  refuse(first_impossible(particles), world, script);
}

void require_room_for_each(const Dem& dem, const std::string& script) {
  const ParticleArrays particles = dem.particles();
  const auto held = [&](int i) { return dem.held(particles.mask[i]); };
  refuse(first_deep_overlap(particles, dem.near_pairs(), held), dem.world(), script);
}

}  // namespace demvof
