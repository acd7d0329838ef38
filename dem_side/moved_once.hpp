// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

namespace LAMMPS_NS {
class FixMultisphere;
class LAMMPS;
}  // namespace LAMMPS_NS

namespace demvof {

/// What is wrong with who moves which spheres, a sentence each: every sphere, also one that an insertion will
/// put in, is moved by one fix of the script, or held by one. clumps: of the script, which move their own
/// spheres; or nullptr. Collective, and the same on all ranks.
std::vector<std::string> not_moved_once(LAMMPS_NS::LAMMPS& liggghts, const LAMMPS_NS::FixMultisphere* clumps);

}  // namespace demvof
