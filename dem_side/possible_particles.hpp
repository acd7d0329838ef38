// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <mpi.h>

#include <string>

#include "dem_side/particle_arrays.hpp"

namespace demvof {

/// Throws InputError on all ranks when there is a particle that cannot be: one of its numbers is none or
/// beyond reason, or it is where another one is. It names the script and the particle with the lowest id.
/// Collective.
void require_possible_particles(const ParticleArrays& particles, MPI_Comm world, const std::string& script);

}  // namespace demvof
