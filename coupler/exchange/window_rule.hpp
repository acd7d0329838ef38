// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// How long the next window may be, by what came of the last one.
//
// The particles feel for a whole window the fluid of its start: what it has become by its end they hear a
// window late. Per bulk cell that is, as a change of their velocity,
//
//   dv = (1 - exp(-x)) |u - u_seen| + (mobility/V_s) dt |grad p - grad p_seen|
//
//   x = n beta dt/(m + m_a)   from theta = (1 - exp(-x))/x = 1 - following/V_s       (relaxation.hpp)
//   mobility = sum w theta V^2 (1 + C_m)/(m + m_a)   what drag leaves of the pressure's push
//
// the mean of both fluids where a surface cuts the cell. The first part is the implicit part of the exchange,
// C (u_ref - u) dt, per mass. With the tolerance for dv of all but a hundredth of the solid (drops and the
// edges of a kernel hold next to nothing, and see the pressure of single cells), 0.3 of a bulk cell for the
// way of the fastest particle and 0.1 for the change of a void fraction, relative,
//
//   e = max(dv/tolerance, way/0.3, change/0.1)
//   e > 1          the next window is 0.8/e of this one, but no less than an eighth
//   e < 0.4        the next window is 1.5 times this one: with dv ~ dt^2 at most, e stays below 1
//   else           it is the same
//
// in whole DEM steps, from shortest to longest. Windows up to a time at which something is written are equal
// parts of what is left, no longer than that. docs/theory.md, docs/decisions/adaptive_windows.md.

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "coupler/grid/bulk_cells.hpp"

namespace demvof {

/// What a window came to.
struct WindowChange {
  double velocity = 0;       // dv, m/s, of all but a hundredth of the solid
  double way = 0;            // of the fastest particle, over the width of a bulk cell, -
  double void_fraction = 0;  // relative change, the worst bulk cell's, -
};

/// dv of the bulk cells, by how much solid they hold: bins a fifth wide. Sums over ranks are those of the
/// volumes.
struct LateVelocities {
  static constexpr double least = 1e-9, width = 1.2;  // m/s, -
  std::array<double, 200> volumes{};                  // from 1e-9 to 7e6 m/s, m3

  void add(double velocity, double solid_volume) {
    const double bin = velocity > least ? std::ceil(std::log(velocity / least) / std::log(width)) : 0;
    volumes[static_cast<std::size_t>(std::min(bin, static_cast<double>(volumes.size() - 1)))] += solid_volume;
  }
  /// That which all of the solid but such a part stays below, to the bin's upper end; 0 where nothing is
  /// late.
  double all_but(double part) const {
    const double rest = part * std::accumulate(volumes.begin(), volumes.end(), 0.0);
    double above = 0;
    for (std::size_t bin = volumes.size(); bin-- > 1;) {
      above += volumes[bin];
      if (above > rest) return least * std::pow(width, static_cast<double>(bin));
    }
    return 0;
  }
};

/// x of theta(x) = (1 - exp(-x))/x, theta in (0, 1].
inline double response_times(double theta) {
  if (theta >= 1) return 0;
  // g(x) = x theta + exp(-x) - 1 is convex: from beyond its root Newton's steps come down to it.
  double x = std::min(1 / theta, 2 * (1 - theta) / theta);
  for (int i = 0; i < 100; ++i) {
    const double step = (x * theta + std::expm1(-x)) / (theta - std::exp(-x));
    x -= step;
    if (!(std::abs(step) > 1e-14 * x)) break;
  }
  return x;
}

/// theta of the particles of a bulk cell, all of one kind, -.
inline double inertial_share(const BulkParticles& particles) {
  constexpr double least = 1e-12;  // round-off of the sums
  return particles.solid_volume > 0
             ? std::clamp(1 - particles.following_volume / particles.solid_volume, least, 1.0)
             : 1;
}

/// dv, m/s. velocity, pressure_gradient: of the fluid now, less what the particles were told; window: s.
inline double late_velocity(const BulkParticles& particles, const Vec3& velocity,
                            const Vec3& pressure_gradient, double window) {
  if (!(particles.solid_volume > 0)) return 0;
  const double theta = inertial_share(particles);
  const double response = response_times(theta) * theta;  // 1 - exp(-x)
  return response * norm(velocity) +
         particles.pressure_mobility / particles.solid_volume * window * norm(pressure_gradient);
}

/// What particles of a window would be to the fluid after one that is `ratio` times as long: what depends on
/// theta goes with that of their mean.
inline BulkParticles over_window(BulkParticles particles, double ratio) {
  const double theta = inertial_share(particles);
  const double then = ratio * response_times(theta);
  const double now = then > 1e-8 ? -std::expm1(-then) / then : 1;
  const double kept = now / theta, follow = theta < 1 ? (1 - now) / (1 - theta) : 1;
  const double whole = particles.drag_tangent - particles.free_response;
  const double held = whole > 0 ? (particles.drag_response - particles.free_response) / whole : 0;
  particles.pressure_mobility *= kept;
  particles.following_volume *= follow;
  particles.free_response *= kept;
  particles.following_response *= kept * follow;
  particles.drag_response =
      particles.free_response + held * (particles.drag_tangent - particles.free_response);
  return particles;
}

/// e, -.
inline double window_error(const WindowChange& change, double tolerance) {
  constexpr double longest_way = 0.3, largest_change = 0.1;
  return std::max(
      {change.velocity / tolerance, change.way / longest_way, change.void_fraction / largest_change});
}

/// DEM steps of the next windows, from shortest to longest. steps: of the last one.
struct StepRange {
  long shortest = 1, longest = 1;
};
inline long steps_of_next_window(long steps, double error, const StepRange& range) {
  constexpr double growth = 1.5, least = 0.125, aim = 0.8, room = 0.4;
  double next = static_cast<double>(steps);
  if (error > 1)
    next = std::floor(next * std::max(least, aim / error));
  else if (error < room)
    next = std::max(next + 1, std::floor(growth * next));
  return std::clamp(static_cast<long>(next), range.shortest, range.longest);
}

/// DEM steps that this many windows come to at most, whatever their errors: the next one has `steps`, and
/// those after it follow from the `wanted` that it was meant to have.
inline long most_steps(int windows, long steps, long wanted, const StepRange& range) {
  long all = steps;
  for (int window = 1; window < windows; ++window) all += wanted = steps_of_next_window(wanted, 0, range);
  return all;
}

/// Of `distance` DEM steps to a time that has to be met, the next window's when it may have `wanted`: equal
/// parts.
inline long equal_part(long distance, long wanted) {
  const long parts = (distance + wanted - 1) / wanted;
  return (distance + parts - 1) / parts;
}

}  // namespace demvof
