// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

namespace demvof {

/// What the two programs made of a case before the first step; `demvof check` shows it.
struct ResolvedNumbers {
  double window = 0;           // s; the first one's
  double longest_window = 0;   // s; 0: all are the same
  long windows = 0;            // 0: not known
  double dem_time_step = 0;    // s; 0 without particles
  long dem_steps = 0;          // in the first window (n)
  double fluid_time_step = 0;  // the first, s
  long fluid_steps = 0;        // in the first window (k); later ones follow from the Courant number
  // What the steps follow from, s; 0: there is no such limit, or it is not known.
  double courant_step = 0;    // longest by the Courant numbers of the flow at the start
  double longest_step = 0;    // maxDeltaT
  double capillary_step = 0;  // shortest capillary wave on the smallest cell
  double collision_time = 0;  // of the lightest particle
  double rayleigh_time = 0;   // of the particle with the shortest
  double drag_time = 0;       // m/beta of the particle with the shortest, slow flow
  long fine_cells = 0;        // at the start
  long bulk_cells = 0;
  double bulk_spacing = 0;                    // smallest edge of a bulk cell, m
  long particles = 0;                         // at the start
  double min_diameter = 0, max_diameter = 0;  // of a particle, m
};

/// As a table for people, one line each; without particles those of the fluid side alone.
std::string numbers_table(const ResolvedNumbers& numbers);

}  // namespace demvof
