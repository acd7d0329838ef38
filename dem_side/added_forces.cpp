// SPDX-License-Identifier: GPL-3.0-or-later
// How forces are added in LIGGGHTS's steps: by a fix external, whose own pass over all particles is not
// needed.

#include <algorithm>
#include <limits>

#include "atom.h"
#include "dem_side/dem.hpp"
#include "fix_external.h"
#include "lammps.h"
#include "modify.h"
#include "update.h"

namespace demvof {
namespace {

constexpr const char* external_fix = "demvof_fluid_force";
// LIGGGHTS adds what that fix holds in steps that this divides: in step 0 alone. In others forces are added
// where they are found.
constexpr int steps_between_additions = std::numeric_limits<int>::max();

}  // namespace

void Dem::renew_added_forces() {
  const ParticleArrays local = particles();
  double* const* added = added_forces();
  double* const* force = liggghts_->atom->f;
  for (int i = 0; i < local.count; ++i)
    for (int axis = 0; axis < 3; ++axis) force[i][axis] -= added[i][axis];
  add_forces_(local, added);
  if (has_clumps()) clumps_->renew_forces();
}

void Dem::attach(AddForces add_forces) {
  add_forces_ = std::move(add_forces);
  // Created after everything in the script, so that its post_force comes last and sees all forces.
  add_fix({external_fix, "all", "external", "pf/callback", "1", std::to_string(steps_between_additions)});
  auto* fix = dynamic_cast<LAMMPS_NS::FixExternal*>(liggghts_->modify->find_fix_id(external_fix));
  fix->set_callback(&Dem::call_back, this);
}

double* const* Dem::added_forces() const {
  return dynamic_cast<LAMMPS_NS::FixExternal*>(liggghts_->modify->find_fix_id(external_fix))->fexternal;
}

void Dem::call_back(void* self, long step, int, int*, double**, double** added) {
  const Dem& dem = *static_cast<Dem*>(self);
  const ParticleArrays local = dem.particles();
  if (step != 0) {
    dem.add_forces_(local, step == dem.liggghts_->update->laststep ? added : nullptr);
    return;
  }
  std::vector<double> before;
  for (int i = 0; i < local.count; ++i) before.insert(before.end(), local.force[i], local.force[i] + 3);
  dem.add_forces_(local, added);
  for (int i = 0; i < local.count; ++i)
    std::copy_n(&before[3 * static_cast<std::size_t>(i)], 3, local.force[i]);
}

}  // namespace demvof
