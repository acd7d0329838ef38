// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <mpi.h>

#include <string>

#include "dem_side/dem.hpp"

namespace demvof {

/// Throws InputError on all ranks when there is a particle that cannot be: one of its numbers is none or
/// beyond reason, or it is where another one is. It names the script and the particle with the lowest id.
/// Collective.
void require_possible_particles(const ParticleArrays& particles, MPI_Comm world, const std::string& script);

/// The same of two spheres that overlap by more than half a radius of the smaller one, as LIGGGHTS's list of
/// neighbours has them: after Dem::set_up. Spheres of one clump may, and those that the script holds.
void require_room_for_each(const Dem& dem, const std::string& script);

}  // namespace demvof
