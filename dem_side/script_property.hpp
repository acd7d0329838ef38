// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "fix_property_global.h"
#include "lammps.h"
#include "modify.h"

namespace demvof {

/// A material property of the script; nullptr where it has none of this name. kind: LIGGGHTS's word for its
/// shape.
inline LAMMPS_NS::FixPropertyGlobal* script_property(LAMMPS_NS::LAMMPS& liggghts, const char* name,
                                                     const char* kind, int rows, int columns) {
  return dynamic_cast<LAMMPS_NS::FixPropertyGlobal*>(
      liggghts.modify->find_fix_property(name, "property/global", kind, rows, columns, "demvof", false));
}

}  // namespace demvof
