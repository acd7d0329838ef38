// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// What a DEM step has to resolve, as far as the script tells.
//
//   collision   t = pi sqrt(m/2 / k_n)                                      linear spring (hooke/stiffness)
//   Rayleigh    t = pi r sqrt(rho/G) / (0.1631 nu + 0.8766), G = Y/(2 (1 + nu))       (Thornton & Randall
//   1988)
//
// The shortest over the particles: the lightest one, the stiffest spring.

namespace LAMMPS_NS {
class LAMMPS;
}

namespace demvof {

/// s; 0 where the script has no such property or no particle yet.
struct ContactTimes {
  double collision = 0, rayleigh = 0;
};

/// Collective over the world of the instance.
ContactTimes shortest_contact_times(LAMMPS_NS::LAMMPS& liggghts);

}  // namespace demvof
