// SPDX-License-Identifier: GPL-3.0-or-later
#include "dem_side/near_surfaces.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>

#include "atom.h"
#include "coupler/base/errors.hpp"
#include "dem_side/dem.hpp"
#include "dem_side/granular_walls.hpp"
#include "dem_side/particle_arrays.hpp"
#include "force.h"
#include "lammps.h"
#include "modify.h"
#include "neigh_list.h"
#include "neighbor.h"
#include "pair.h"

namespace demvof {
namespace {

using namespace LAMMPS_NS;

void add_near_primitive(const Atom& atom, FixWallGran& fix, double radii, std::vector<NearWall>& walls) {
  PrimitiveWall& wall = *fix.primitiveWall();
  for (int i = 0; i < atom.nlocal; ++i) {
    if (!(atom.mask[i] & fix.groupbit)) continue;
    Vec3 to_wall;
    const double gap = wall.resolveContact(atom.x[i], atom.radius[i], &to_wall.x);
    const double distance = norm(to_wall);
    if (gap < radii * atom.radius[i] && distance > 0) walls.push_back({i, gap, to_wall / distance, {}});
  }
}

/// Of the triangles that a particle is near to, the nearest one stands for the surface.
void add_near_surface(const Atom& atom, const FixWallGran& fix, FixMeshSurface& surface, double radii,
                      std::vector<NearWall>& walls) {
  TriMesh& mesh = *surface.triMesh();
  const auto* moving = mesh.prop().getElementProperty<MultiVectorContainer<double, 3, 3>>("v");
  const auto before = static_cast<std::ptrdiff_t>(walls.size());
  for (int triangle = 0; triangle < mesh.sizeLocal() + mesh.sizeGhost(); ++triangle)
    for (const int i : surface.meshNeighlist()->get_contact_list(triangle)) {
      if (i >= atom.nlocal || !(atom.mask[i] & fix.groupbit)) continue;
      Vec3 to_wall;
      double corners[3];
      int inside = -1;
      const double gap = mesh.resolveTriSphereContactBary(i, triangle, atom.radius[i], atom.x[i], &to_wall.x,
                                                          corners, inside, true);
      const double distance = norm(to_wall);
      if (!(gap < radii * atom.radius[i] && distance > 0)) continue;
      NearWall wall{i, gap, to_wall / distance, {}};
      for (int corner = 0; moving && corner < 3; ++corner)
        wall.velocity += corners[corner] * vec3((*moving)(triangle)[corner]);
      walls.push_back(wall);
    }
  const auto nearer = [](const NearWall& a, const NearWall& b) {
    return a.particle != b.particle ? a.particle < b.particle : a.gap < b.gap;
  };
  std::sort(walls.begin() + before, walls.end(), nearer);
  const auto same = [](const NearWall& a, const NearWall& b) { return a.particle == b.particle; };
  walls.erase(std::unique(walls.begin() + before, walls.end(), same), walls.end());
}

}  // namespace

// LIGGGHTS lists pairs up to factor (r_1 + r_2) + skin apart, surfaces up to factor r + skin, and makes new
// lists when something has moved by half a skin: factor - 1 is what is left in any step. Ghosts are known up
// to factor r_max + r + skin.
void reach_further(LAMMPS& liggghts, double radii) {
  const char* style = liggghts.force->pair_style;
  if (!style || std::string_view(style).substr(0, 4) != "gran")
    throw InputError(fmt::format(
        "forces.lubrication needs a list of particles that are near each other, which 'pair_style gran ...' "
        "makes; the script has {}",
        style ? "pair_style " + std::string(style) : "no pair_style"));
  if (liggghts.force->newton_pair)
    throw InputError(
        "forces.lubrication needs pairs that are seen from both ranks: 'newton off' in the script, before "
        "the "
        "box is made");
  liggghts.neighbor->register_contact_dist_factor(1 + radii);
}

NearPairs near_pairs(const LAMMPS& liggghts) {
  const Pair* pair = liggghts.force->pair;
  if (!pair || !pair->list) return {};
  const NeighList& list = *pair->list;
  return {list.inum, list.ilist, list.numneigh, list.firstneigh};
}

std::vector<NearWall> near_walls(LAMMPS& liggghts, double radii) {
  const Atom& atom = *liggghts.atom;
  std::vector<NearWall> walls;
  for (int n = 0; n < liggghts.modify->nfix; ++n) {
    auto* fix = dynamic_cast<FixWallGran*>(liggghts.modify->fix[n]);
    if (!fix) continue;
    if (!fix->is_mesh_wall()) add_near_primitive(atom, *fix, radii, walls);
    for (int mesh = 0; fix->is_mesh_wall() && mesh < fix->n_meshes(); ++mesh)
      add_near_surface(atom, *fix, *fix->mesh_list()[mesh], radii, walls);
  }
  return walls;
}

void Dem::reach_further(double radii) {
  demvof::reach_further(*liggghts_, radii);
}

NearPairs Dem::near_pairs() const {
  return demvof::near_pairs(*liggghts_);
}

std::vector<NearWall> Dem::near_walls(double radii) const {
  return demvof::near_walls(*liggghts_, radii);
}

}  // namespace demvof
