// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

namespace LAMMPS_NS {
class LAMMPS;
}

namespace demvof {

/// Where the random numbers stand by which a script's insertions choose places, sizes and velocities.
/// LIGGGHTS's restart file leaves them out, or begins them anew.
struct RandomStates {
  std::vector<std::string> names;        // the same on all ranks
  std::vector<std::vector<int>> states;  // [rank][stream]
};

/// Of this rank: names and states[0]. The run goes on from there like one that is continued: of pairs of
/// normal numbers the second one is dropped.
RandomStates random_states(LAMMPS_NS::LAMMPS& liggghts);

/// Sets those of this rank. Of another number of ranks only what was the same on all of them is of use; what
/// the script does not have any more is of none.
void set_random_states(LAMMPS_NS::LAMMPS& liggghts, const RandomStates& saved, int rank, int ranks);

}  // namespace demvof
