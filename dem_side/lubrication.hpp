// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "coupler/base/vec3.hpp"
#include "coupler/closures/lubrication.hpp"
#include "dem_side/closure_count.hpp"
#include "dem_side/dem.hpp"

namespace demvof {

/// Films between particles, and between particles and granular walls, in every DEM step.
///
/// A film knows its two bodies alone (closures/lubrication.hpp). One of many films has of each body the share
/// of the mass that the film's stiffness, 6 pi mu a^2/h, has in the sum over the body's films: as if it were
/// split up, each part pulled by one film, and put together again with its momentum. Kinetic energy can only
/// go down in both, so that any number of films is stable for any step.
///
/// Both ends of a film get the same impulse, to the last bit, also where they are on two ranks or on both
/// sides of a periodic boundary; and what films give a particle is added up in the order of its partners'
/// ids. So neither ranks nor a new start change anything.
class Lubrication {
 public:
  /// Throws InputError when the script's contacts do not show what is near.
  Lubrication(Dem& dem, const LubricationParameters& parameters);

  void begin_window() { count_ = {}; }

  /// A local particle at the end of the step as it would be without films.
  struct Body {
    Vec3 velocity;         // m/s
    double mobility = 0;   // change of that velocity by an impulse, 1/kg; 0: not moved by forces
    double viscosity = 0;  // of what is around it, Pa s
  };
  /// Forces of the films on the local particles, means of a step (s), N. Collective.
  const std::vector<Vec3>& forces(const ParticleArrays& particles, const std::vector<Body>& bodies,
                                  double step);

  /// Films, each in each DEM step, and those of them that are narrower than the roughness.
  const ClosureCount& count() const { return count_; }

 private:
  struct Film {
    int first, second;  // local particles or ghosts, by their ids; second: none at a wall
    Vec3 towards;       // from the first to the second, unit vector
    FilmLimits limits;
    double gap, free;    // m; its rate without the film, m/s
    double resistance;   // 6 pi mu a^2, N s
    double stiffness;    // that over the gap
    double impulse = 0;  // on the second along towards, N s
  };
  struct End {  // of a film
    int particle, film;
    int partner;  // id
  };

  void tell_ghosts(const ParticleArrays& particles, const std::vector<Body>& bodies);
  void find_films(const ParticleArrays& particles);
  void add_pair(const ParticleArrays& particles, int i, int j);
  void add_wall(const ParticleArrays& particles, const NearWall& wall);
  void add(const ParticleArrays& particles, const Film& film);
  void order_ends();
  void share_out(const ParticleArrays& particles);
  double mobility_in(const Film& film, int particle) const;

  Dem& dem_;
  LubricationParameters parameters_;
  ClosureCount count_;
  // Of the present step.
  ParticleDomain domain_;
  double* const* told_ = nullptr;  // rows of particles and ghosts
  double* const* sums_ = nullptr;
  std::vector<Film> films_;
  std::vector<End> ends_;  // at local particles
  std::vector<Vec3> forces_;
};

}  // namespace demvof
