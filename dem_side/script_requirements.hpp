// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

namespace LAMMPS_NS {
class LAMMPS;
}

namespace demvof {

/// Throws InputError, one line for each of them, when the scene that a script has left in LIGGGHTS
/// lacks what a coupled run needs (class Dem lists it) or holds what it cannot follow.
void require_coupled_scene(LAMMPS_NS::LAMMPS& liggghts, const std::string& script);

}  // namespace demvof
