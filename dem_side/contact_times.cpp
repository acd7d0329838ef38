// SPDX-License-Identifier: GPL-3.0-or-later
#include "dem_side/contact_times.hpp"

#include <mpi.h>

#include <algorithm>
#include <cmath>

#include "atom.h"
#include "coupler/base/mpi_check.hpp"
#include "coupler/base/sphere.hpp"
#include "dem_side/script_property.hpp"

namespace demvof {

ContactTimes shortest_contact_times(LAMMPS_NS::LAMMPS& liggghts) {
  const LAMMPS_NS::Atom& atom = *liggghts.atom;
  const int types = atom.ntypes;
  auto* stiffness = script_property(liggghts, "kn", "peratomtypepair", types, types);
  auto* modulus = script_property(liggghts, "youngsModulus", "peratomtype", types, 0);
  auto* poisson = script_property(liggghts, "poissonsRatio", "peratomtype", types, 0);

  double shortest[] = {HUGE_VAL, HUGE_VAL};
  for (int i = 0; i < atom.nlocal; ++i) {
    const int type = atom.type[i] - 1;
    const double r = atom.radius[i], mass = atom.rmass[i];
    for (int other = 0; stiffness && other < types; ++other)
      shortest[0] = std::min(shortest[0], pi * std::sqrt(0.5 * mass / stiffness->compute_array(type, other)));
    if (modulus && poisson) {
      const double nu = poisson->compute_vector(type), shear = modulus->compute_vector(type) / (2 * (1 + nu));
      const double density = mass / sphere_volume(r);
      shortest[1] = std::min(shortest[1], pi * r * std::sqrt(density / shear) / (0.1631 * nu + 0.8766));
    }
  }
  check_mpi(MPI_Allreduce(MPI_IN_PLACE, shortest, 2, MPI_DOUBLE, MPI_MIN, liggghts.world), "MPI_Allreduce");
  const auto known = [](double time) { return std::isfinite(time) ? time : 0.0; };
  return {known(shortest[0]), known(shortest[1])};
}

}  // namespace demvof
