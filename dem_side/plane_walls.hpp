// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

namespace demvof {

/// A plane of fix wall/gran ... primitive, across an axis.
struct PlaneWall {
  std::string fix;
  int axis = 0;
  double at = 0;  // m, where it stands now
};

struct PlaneWalls {
  std::vector<PlaneWall> planes;
  bool others = false;  // the script has walls of other shapes, or of other fixes
};

}  // namespace demvof
