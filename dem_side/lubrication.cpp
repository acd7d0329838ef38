// SPDX-License-Identifier: GPL-3.0-or-later
#include "dem_side/lubrication.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

namespace demvof {
namespace {

constexpr const char* told_rows = "demvof_film_bodies";
constexpr const char* sums_rows = "demvof_film_sums";

// Films begin at the cut-off; one that a body enters in a step has to be known before.
constexpr double reach_over_cut_off = 2;

/// What the other end of a film has to know of a body; its place is that of its owner, not of an image.
struct Told {
  Vec3 place, velocity;
  double mobility, viscosity;
};
static_assert(sizeof(Told) == 8 * sizeof(double));

const Told& told_of(double* const* rows, int i) {
  return *reinterpret_cast<const Told*>(rows[i]);
}

/// By how many periods an image was shifted; 0 of the particle itself.
double periods(double image, double place, double period) {
  return std::round((image - place) / period);
}

}  // namespace

Lubrication::Lubrication(Dem& dem, const LubricationParameters& parameters)
    : dem_(dem), parameters_(parameters) {
  dem_.reach_further(reach_over_cut_off * parameters.cut_off);
  dem_.add_ghost_rows(told_rows, sizeof(Told) / sizeof(double));
  dem_.add_ghost_rows(sums_rows, 1);
}

const std::vector<Vec3>& Lubrication::forces(const ParticleArrays& particles, const std::vector<Body>& bodies,
                                             double step) {
  domain_ = dem_.domain();
  tell_ghosts(particles, bodies);
  find_films(particles);
  order_ends();
  share_out(particles);
  forces_.assign(particles.count, {});
  for (const End& end : ends_) {
    const Film& film = films_[end.film];
    forces_[end.particle] += ((end.particle == film.first ? -1 : 1) * film.impulse / step) * film.towards;
  }
  return forces_;
}

void Lubrication::tell_ghosts(const ParticleArrays& particles, const std::vector<Body>& bodies) {
  told_ = dem_.particle_rows(told_rows);
  for (int i = 0; i < particles.count; ++i)
    *reinterpret_cast<Told*>(told_[i]) = {vec3(particles.position[i]), bodies[i].velocity, bodies[i].mobility,
                                          bodies[i].viscosity};
  dem_.bring_to_ghosts(told_rows);
}

void Lubrication::find_films(const ParticleArrays& particles) {
  films_.clear();
  ends_.clear();
  const NearPairs pairs = dem_.near_pairs();
  for (int row = 0; row < pairs.rows; ++row) {
    const int i = pairs.particle[row];
    for (int n = 0; n < pairs.partners[i]; ++n) add_pair(particles, i, pairs.partner[i][n]);
  }
  for (const NearWall& wall : dem_.near_walls(reach_over_cut_off * parameters_.cut_off))
    add_wall(particles, wall);
}

void Lubrication::add_pair(const ParticleArrays& particles, int i, int j) {
  const double mean_radius = 0.5 * (particles.radius[i] + particles.radius[j]);
  const FilmLimits limits{parameters_.roughness * mean_radius, parameters_.cut_off * mean_radius};
  const Vec3 apart = vec3(particles.position[j]) - vec3(particles.position[i]);
  const double reach = 2 * mean_radius + reach_over_cut_off * limits.cut_off;
  if (dot(apart, apart) >= reach * reach) return;
  const auto [first, second] = particles.id[i] < particles.id[j] ? std::pair(i, j) : std::pair(j, i);
  const Told &one = told_of(told_, first), &other = told_of(told_, second);
  Vec3 way = other.place - one.place;
  for (int axis = 0; axis < 3; ++axis) {
    if (!domain_.periodic[axis]) continue;
    const double period = domain_.upper[axis] - domain_.lower[axis];
    way[axis] += period * (periods(particles.position[second][axis], other.place[axis], period) -
                           periods(particles.position[first][axis], one.place[axis], period));
  }
  const double distance = norm(way);
  if (!(distance > 0)) return;
  const Vec3 towards = way / distance;
  const double viscosity = 0.5 * (one.viscosity + other.viscosity);
  const double resistance =
      film_resistance(viscosity, reduced_radius(particles.radius[first], particles.radius[second]));
  add(particles, {first, second, towards, limits, distance - 2 * mean_radius,
                  dot(other.velocity - one.velocity, towards), resistance, 0});
}

void Lubrication::add_wall(const ParticleArrays& particles, const NearWall& wall) {
  const double radius = particles.radius[wall.particle];
  const Told& body = told_of(told_, wall.particle);
  add(particles, {wall.particle,
                  -1,
                  wall.towards,
                  {parameters_.roughness * radius, parameters_.cut_off * radius},
                  wall.gap,
                  dot(wall.velocity - body.velocity, wall.towards),
                  film_resistance(body.viscosity, radius),
                  0});
}

/// Takes the film if this step changes it.
void Lubrication::add(const ParticleArrays& particles, const Film& candidate) {
  Film film = candidate;
  const double from = film.limits.clamp(film.gap);
  const bool counts = film.first < particles.count;  // here, and not where the first is a ghost
  const bool rough = film.gap > 0 && film.gap < film.limits.roughness;
  const bool wet = film.resistance > 0 && (parameters_.suction || film.free < 0);
  count_.outside += counts && wet && rough;
  count_.evaluations += counts && wet && rough;
  if (!wet || film.limits.clamp(film.gap + film.free * dem_.time_step()) == from) return;
  count_.evaluations += counts && !rough;
  film.stiffness = film.resistance / from;
  const int number = static_cast<int>(films_.size());
  if (film.first < particles.count)
    ends_.push_back(
        {film.first, number, film.second < 0 ? std::numeric_limits<int>::max() : particles.id[film.second]});
  if (film.second >= 0 && film.second < particles.count)
    ends_.push_back({film.second, number, particles.id[film.first]});
  films_.push_back(film);
}

/// By particle, then by its partner; walls come last, in their order.
void Lubrication::order_ends() {
  std::sort(ends_.begin(), ends_.end(), [&](const End& a, const End& b) {
    const auto key = [&](const End& end) {
      const bool wall = films_[end.film].second < 0;
      return std::tuple(end.particle, end.partner, wall ? 0.0 : films_[end.film].gap, end.film);
    };
    return key(a) < key(b);
  });
}

void Lubrication::share_out(const ParticleArrays& particles) {
  sums_ = dem_.particle_rows(sums_rows);
  for (int i = 0; i < particles.count; ++i) sums_[i][0] = 0;
  for (const End& end : ends_) sums_[end.particle][0] += films_[end.film].stiffness;
  dem_.bring_to_ghosts(sums_rows);
  for (Film& film : films_) {
    const double mobility =
        mobility_in(film, film.first) + (film.second < 0 ? 0 : mobility_in(film, film.second));
    if (mobility > 0)
      film.impulse = -film.resistance * film_strain(film.limits, film.gap, film.free, film.resistance,
                                                    mobility, dem_.time_step());
  }
}

/// Of the part of the body that belongs to the film.
double Lubrication::mobility_in(const Film& film, int particle) const {
  return told_of(told_, particle).mobility * sums_[particle][0] / film.stiffness;
}

}  // namespace demvof
