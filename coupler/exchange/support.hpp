// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Whether contacts hold the particles of a bulk cell. Each of them may touch others in every DEM step, and
// all of them still move as one: then contacts cancel in the cell, and a change of the fluid's velocity moves
// the bed as if its particles were free. A bed that rests on something gets from its contacts what fluid and
// gravity ask for.
//
//   S = min(1, 4 |sum w c| / (|sum w d| + |sum w o|))
//
//   c, d, o   impulses of contacts, of drag (lift, added mass), of all else, in the window, N s
//   K_eff     = free response + S (response by contacts - free response)
//
// With S = 1 everywhere a bed in contact that moves in a stiff liquid doubles its velocity in each window
// (tests/verification/pair/moving_beds.py); with 0 one that is held swings (docs/theory.md). The 4: a bed of
// which the stream carries three quarters still counts as held by more than half, and C above beta/2 keeps a
// held one from swinging. Closer to lifting off it is not held any more; a bed taken through this in windows
// up to K dt = 20 eps rho stayed on Ergun's line (docs/decisions/relaxation.md).

#include <algorithm>

#include "coupler/base/vec3.hpp"
#include "coupler/grid/bulk_cells.hpp"

namespace demvof {

/// Of a particle, or of a bulk cell with the particles' weights.
struct Support {
  Vec3 contact, drag, others;  // impulses of the window, N s
  double free_response = 0;    // beta_eff if no contact held it, kg/s
};

/// S, -, 0 to 1. 0 where nothing acts.
inline double support_by_contacts(const Support& cell) {
  constexpr double counts_as_held = 4;
  const double asked = norm(cell.drag) + norm(cell.others);
  return asked > 0 ? std::min(1.0, counts_as_held * norm(cell.contact) / asked) : 0;
}

/// Takes back from the responses what contacts that bear nothing stand for.
inline void count_support(const CellValues<Support>& support, CellValues<BulkParticles>& particles) {
  for (std::size_t i = 0; i < particles.cells.size(); ++i) {
    const Support* here = find(support, particles.cells[i]);
    BulkParticles& cell = particles.values[i];
    if (!here || !(cell.drag_response > here->free_response)) continue;
    const double response =
        here->free_response + support_by_contacts(*here) * (cell.drag_response - here->free_response);
    cell.response_weighted_velocity *= response / cell.drag_response;
    cell.drag_response = response;
  }
}

}  // namespace demvof
