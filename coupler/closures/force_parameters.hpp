// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "coupler/base/vec3.hpp"

namespace demvof {

enum class DragLaw { none, schiller_naumann, gidaspow, di_felice, koch_hill, beetstra, rong };
enum class OwnWake { none, oseen };

enum class LiftLaw { none, saffman_mei };

struct ForceParameters {
  DragLaw drag = DragLaw::schiller_naumann;
  bool pressure_gradient = true;
  OwnWake own_wake = OwnWake::none;  // correction of the sampled velocity for the particle's own disturbance
  bool viscous_stress = false;
  double added_mass = 0;  // C_m, -: the particle moves C_m times its own volume of fluid with it
  LiftLaw lift = LiftLaw::none;
  bool capillary = false;
  Vec3 constant;  // N on each particle, from outside
};

/// True when a force asks for derivatives of the fluid's velocity or for its surface (BulkFluidGradients).
inline bool need_gradients(const ForceParameters& forces) {
  return forces.viscous_stress || forces.added_mass > 0 || forces.lift != LiftLaw::none || forces.capillary;
}

}  // namespace demvof
