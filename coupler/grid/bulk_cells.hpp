// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <type_traits>
#include <vector>

#include "coupler/base/vec3.hpp"
#include "coupler/grid/bulk_grid.hpp"

namespace demvof {

/// Values on some bulk cells: cells is sorted and free of repeats, values[i] belongs to cells[i].
template <class T>
struct CellValues {
  std::vector<CellId> cells;
  std::vector<T> values;
};

/// The value of a cell; nullptr where there is none.
template <class T>
const T* find(const CellValues<T>& values, CellId cell) {
  const auto place = std::lower_bound(values.cells.begin(), values.cells.end(), cell);
  return place != values.cells.end() && *place == cell ? &values.values[place - values.cells.begin()]
                                                       : nullptr;
}

/// What the fluid tells the particles about one bulk cell at the start of a window.
struct BulkFluid {
  Vec3 velocity;             // u_b, m/s, mean over the cell (weights: coupling.sharing)
  Vec3 pressure_gradient;    // gradient of the total pressure, Pa/m
  double density = 0;        // rho, kg/m3; 0 marks a cell without fluid
  double viscosity = 0;      // mu, Pa s
  double void_fraction = 1;  // eps, -
  Vec3 left_over;            // M, N s: impulse that the particles of this cell must still receive
};

/// Derivatives of the fluid in one bulk cell; sent after BulkFluid, for the same cells, only when a force of
/// the case needs them.
struct BulkFluidGradients {
  Vec3 stress_force;  // div tau (viscous_stress) + sigma kappa grad alpha (capillary), those named, N/m3
  Vec3 acceleration;  // Du/Dt, m/s2
  Vec3 vorticity;     // curl u, 1/s
};

/// What the particles tell the fluid about one bulk cell at the end of a window. Every member is
/// extensive: a sum over the particles with weights w_ic that add up to 1 for each particle.
struct BulkParticles {
  double solid_volume = 0;      // sum w V, m3
  Vec3 drag_impulse;            // J, sum w (impulse received as drag, lift, added mass in the window), N s
  double drag_factor = 0;       // K V_cell = sum w beta, kg/s
  double drag_tangent = 0;      // sum w n beta, n beta = d(beta s)/ds, kg/s
  double drag_response = 0;     // K_eff V_cell, kg/s: response of J/dt to the fluid velocity
  Vec3 drag_weighted_velocity;  // sum w (beta v - mean lift and added-mass force), N
  Vec3 response_weighted_velocity;  // sum w beta_eff u_felt (fluid velocity each particle felt), N
  double pressure_mobility = 0;     // sum w theta V^2/m of those that forces move, m6/kg (relaxation.hpp)
  double following_volume = 0;      // sum w (1 - theta) V of these, m3
  double free_response = 0;         // sum w beta_eff of these, as if no contact held them, kg/s
  double following_response = 0;    // sum w (1 - theta) beta_eff of these, likewise, kg/s
  Vec3 solid_flux;                  // sum w V (mean velocity in the window), m4/s
};

/// Number of doubles in one record; records travel and are summed as plain rows of doubles.
template <class T>
constexpr int row_width() {
  static_assert(std::is_trivially_copyable_v<T> && sizeof(T) % sizeof(double) == 0,
                "a bulk record must be a plain row of doubles");
  return static_cast<int>(sizeof(T) / sizeof(double));  // NOLINT(bugprone-sizeof-expression): T may be double
}

}  // namespace demvof
