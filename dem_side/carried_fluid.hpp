// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <limits>
#include <type_traits>

#include "coupler/base/series.hpp"
#include "coupler/base/sphere.hpp"
#include "coupler/base/vec3.hpp"
#include "coupler/closures/size_mix.hpp"
#include "coupler/transfer/bulk_surface.hpp"

// What a particle carries through a window, from rank to rank: what it feels and what it received. LIGGGHTS
// keeps and moves the rows; all zero for a particle that came into being during the window: no fluid acts on
// it yet.

namespace demvof {

/// The drag factor near the slip s_0 for which the law was last asked: its power series in s/s_0 - 1, within
/// its reach.
struct LocalDrag {
  static constexpr double near_slip = 0.05;  // where the reach ends at the latest: every law is good to 3e-7

  Series factor;                                              // kg/s
  double per_slip = std::numeric_limits<double>::infinity();  // 1/s_0, s/m; infinite: the law is to be asked
};

/// Of one fluid, as if the particle lay wholly in it, but for what it received. What every DEM step needs
/// comes first: fewer lines of memory.
struct CarriedFluid {
  Vec3 velocity;         // u, m/s
  Vec3 pressure_force;   // N
  Vec3 left_over_force;  // N
  LocalDrag drag;
  Vec3 drag_impulse;  // received in this window, lift and added mass included, N s
  double drag_factor_sum =
      0;                     // of this window: sum of beta over the evaluations, with the wetted share, kg/s
  double density = 0;        // rho, kg/m3; 0: this fluid is not here
  double viscosity = 0;      // mu, Pa s
  double void_fraction = 1;  // eps, -
  double drag_exponent = 1;  // n at the start of this window (implicit_drag.hpp), -
  SizeMix sizes;             // of the particles around it
};

/// Where the surface is, seen from the particle's centre.
struct CarriedSurface {
  double dry = 0;       // share of the volume in the gas, -
  Vec3 normal;          // into the gas; zero: no surface is near
  double distance = 0;  // of the surface along the normal, m
  double velocity = 0;  // of the surface along the normal, m/s
};

/// What contacts did in this window.
struct CarriedContacts {
  double evaluations = 0;  // of the forces: DEM steps, and the first half step of a run
  double touching = 0;     // those of them with a force other than gravity
  Vec3 impulse;            // N s
};

struct CarriedRow {
  /// 1 + k: in this window it is wholly in fluid k, sees no surface, and nothing else is to be known of it.
  /// 0: more is, or it is new.
  double alone = 0;
  Vec3 path;  // covered in this window, m
  CarriedContacts contacts;
  // s, without a fluid that there is: new since the last window began. The fluid's pressure has yet to act.
  double waited = 0;
  double known = 0;  // 1: it was there when a window began
  double told = 0;   // of which fluids: 1 liquid, 2 gas, 3 both
  double owed = 0;   // by which fluids there is a force left over; likewise
  CarriedSurface surface;
  CarriedFluid fluid[2];  // liquid, gas

  double share(int k) const { return k == 0 ? 1 - surface.dry : surface.dry; }
  bool feels(int k) const { return (static_cast<int>(told) >> k & 1) && share(k) > 0; }
  bool waits() const { return told == 0; }
};

/// Of one fluid, when a force needs its derivatives.
struct CarriedGradients {
  Vec3 stress_force;   // N
  Vec3 acceleration;   // Du/Dt, m/s2
  Vec3 vorticity;      // 1/s
  Vec3 other_impulse;  // of the drag impulse, what lift and added mass gave, N s
};
struct CarriedGradientsRow {
  CarriedGradients fluid[2];
};

// Beside these vectors is what a step adds up with them (act_on_lone.hpp).
static_assert(offsetof(CarriedRow, contacts.evaluations) == offsetof(CarriedRow, path) + sizeof(Vec3));
static_assert(offsetof(CarriedFluid, drag_factor_sum) == offsetof(CarriedFluid, drag_impulse) + sizeof(Vec3));

constexpr const char* rows_name = "demvof_fluid";
constexpr const char* gradient_rows_name = "demvof_fluid_gradients";

/// The doubles of local particle i by their names.
template <class Carried = CarriedRow>
Carried& carried_by(double* const* rows, int i) {
  static_assert(std::is_standard_layout_v<Carried> && alignof(Carried) == alignof(double));
  return *reinterpret_cast<Carried*>(rows[i]);
}

/// Rows are farther from each other than what processors fetch by themselves.
inline void fetch_ahead(double* const* rows, int i, int count) {
  constexpr int particles_ahead = 8, line = 64;
  if (i + particles_ahead >= count) return;
  const CarriedRow& row = carried_by(rows, i + particles_ahead);
  __builtin_prefetch(&row, 1);
  const auto* fluid = reinterpret_cast<const char*>(&row.fluid[row.alone > 1]);
  for (std::size_t byte = 0; byte < offsetof(CarriedFluid, density); byte += line)
    __builtin_prefetch(fluid + byte, 1);
}

/// The surface at the start of a window; what is not told counts as not there.
inline CarriedSurface carried_surface(const SeenSurface& seen, const Vec3& liquid_velocity) {
  return {1 - seen.wetted, seen.normal, seen.distance, dot(seen.normal, liquid_velocity)};
}

/// Surface and particle move for a DEM step (s); returns what became wet of the particle, - (negative: dry).
inline double move_surface(CarriedSurface& surface, const Vec3& particle_velocity, double radius,
                           double step) {
  if (surface.normal.x == 0 && surface.normal.y == 0 && surface.normal.z == 0) return 0;
  surface.distance += step * (surface.velocity - dot(surface.normal, particle_velocity));
  const double dry = 1 - share_below_plane(surface.distance / radius);
  const double wetted = surface.dry - dry;
  surface.dry = dry;
  return wetted;
}

}  // namespace demvof
