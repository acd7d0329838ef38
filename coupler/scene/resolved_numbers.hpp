// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

namespace demvof {

/// What the two programs made of a case before the first step; `demvof check` shows it.
struct ResolvedNumbers {
  double window = 0;  // s
  long windows = 0;
  double dem_time_step = 0;    // s; 0 without particles
  long dem_steps = 0;          // per window (n)
  double fluid_time_step = 0;  // the first, s
  long fluid_steps = 0;        // in the first window (k); later ones follow from the Courant number
  long fine_cells = 0;         // at the start
  long bulk_cells = 0;
  double bulk_spacing = 0;                    // smallest edge of a bulk cell, m
  long particles = 0;                         // at the start
  double min_diameter = 0, max_diameter = 0;  // of a particle, m
};

/// As a table for people, one line each; without particles those of the fluid side alone.
std::string numbers_table(const ResolvedNumbers& numbers);

}  // namespace demvof
