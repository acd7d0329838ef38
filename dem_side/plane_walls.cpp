// SPDX-License-Identifier: GPL-3.0-or-later
#include "dem_side/plane_walls.hpp"

#include <array>
#include <optional>
#include <string_view>

#include "dem_side/dem.hpp"
#include "dem_side/granular_walls.hpp"
#include "lammps.h"
#include "modify.h"

namespace demvof {
namespace {

using namespace LAMMPS_NS;

/// LIGGGHTS keeps the kind of a wall to itself. The way to a plane is along one axis from anywhere, and ends
/// at one coordinate; a cylinder has no such axis.
std::optional<PlaneWall> as_plane(FixWallGran& fix) {
  std::array<Vec3, 2> to_wall;
  std::array<Vec3, 2> from = {Vec3{0.37, 0.73, 1.19}, Vec3{-1.61, 2.83, -0.41}};
  for (int n = 0; n < 2; ++n) fix.primitiveWall()->resolveContact(&from[n].x, 0, &to_wall[n].x);
  int axis = -1, ways = 0;
  for (int i = 0; i < 3; ++i)
    if (to_wall[0][i] != 0 || to_wall[1][i] != 0) {
      axis = i;
      ++ways;
    }
  if (ways != 1) return std::nullopt;
  return PlaneWall{fix.id, axis, from[0][axis] + to_wall[0][axis]};
}

}  // namespace

PlaneWalls Dem::plane_walls() const {
  PlaneWalls walls;
  for (int n = 0; n < liggghts_->modify->nfix; ++n) {
    Fix& fix = *liggghts_->modify->fix[n];
    auto* granular = dynamic_cast<FixWallGran*>(&fix);
    if (!granular && std::string_view(fix.style).find("wall") == std::string_view::npos) continue;
    const auto plane = granular && !granular->is_mesh_wall() ? as_plane(*granular) : std::nullopt;
    if (plane)
      walls.planes.push_back(*plane);
    else
      walls.others = true;
  }
  return walls;
}

}  // namespace demvof
