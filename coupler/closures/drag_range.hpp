// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "coupler/closures/drag.hpp"
#include "coupler/closures/force_parameters.hpp"

namespace demvof {

/// Where a law was fitted; without a law: everywhere.
inline DragRange drag_range(DragLaw law) {
  switch (law) {
    case DragLaw::none:
      break;
    case DragLaw::schiller_naumann:
      return schiller_naumann_range;
    case DragLaw::gidaspow:
      return gidaspow_range;
    case DragLaw::di_felice:
      return di_felice_range;
    case DragLaw::koch_hill:
      return koch_hill_range;
    case DragLaw::beetstra:
      return beetstra_range;
    case DragLaw::rong:
      return rong_range;
  }
  return {1e300, 0, 1};
}

}  // namespace demvof
