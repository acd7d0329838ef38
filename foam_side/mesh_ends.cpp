// SPDX-License-Identifier: GPL-3.0-or-later
#include "foam_side/mesh_ends.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "coupler/base/errors.hpp"
#include "cyclicAMIPolyPatch.H"
#include "foam_side/extras.hpp"
#include "foam_side/fine_mesh.hpp"
#include "movingWallVelocityFvPatchVectorField.H"
#include "processorCyclicPolyPatch.H"
#include "wallPolyPatch.H"

namespace demvof {
namespace {

constexpr double tolerance = 1e-6;  // of the mesh's extent; numbers that a user wrote in two files

/// The boundary in the two planes that end the mesh in one direction, m2, over all ranks.
struct Ends {
  double area = 0, cyclic = 0;
};

/// What leaves through the patch comes in elsewhere. A baffle or a sliding interface inside the domain has
/// its other side at the same place.
bool wraps(const Foam::polyPatch& patch) {
  if (!patch.coupled()) return false;
  if (Foam::isA<Foam::processorPolyPatch>(patch) && !Foam::isA<Foam::processorCyclicPolyPatch>(patch))
    return false;
  const auto& coupled = Foam::refCast<const Foam::coupledPolyPatch>(patch);
  return coupled.separated() || !coupled.parallel();
}

/// The direction whose end the face lies in, -1 for none.
int end_of(const MeshBox& box, const vector& centre, const vector& normal) {
  for (int axis = 0; axis < 3; ++axis) {
    const double margin = tolerance * (box.upper[axis] - box.lower[axis]);
    const bool at_end = centre[axis] < box.lower[axis] + margin || centre[axis] > box.upper[axis] - margin;
    if (at_end && std::abs(normal[axis]) > (1 - tolerance) * Foam::mag(normal)) return axis;
  }
  return -1;
}

/// Per direction; the last is the cyclic area elsewhere, m2.
struct AllEnds {
  std::array<Ends, 3> along;
  double cyclic_elsewhere = 0;
};

AllEnds find_ends(const Foam::fvMesh& mesh) {
  const MeshBox box = mesh_box(mesh);
  scalarField sums(7, Foam::Zero);  // area and cyclic area per axis, cyclic area elsewhere
  for (const Foam::polyPatch& patch : mesh.boundaryMesh()) {
    if (Foam::isA<Foam::processorPolyPatch>(patch) && !wraps(patch)) continue;
    forAll(patch, face) {
      const vector normal = patch.faceAreas()[face];
      const int axis = end_of(box, patch.faceCentres()[face], normal);
      const double area = Foam::mag(normal);
      if (axis >= 0) sums[2 * axis] += area;
      if (wraps(patch)) sums[axis >= 0 ? 2 * axis + 1 : 6] += area;
    }
  }
  Foam::reduce(sums, Foam::sumOp<scalarField>());
  return {{Ends{sums[0], sums[1]}, Ends{sums[2], sums[3]}, Ends{sums[4], sums[5]}}, sums[6]};
}

void require_cover(const BulkGrid& grid, const MeshBox& mesh, int axis, bool has_moved) {
  if (grid.periodic()[axis] && has_moved) return;
  const double margin = tolerance * (mesh.upper[axis] - mesh.lower[axis]);
  const double below = mesh.lower[axis] - grid.lower()[axis], above = grid.upper()[axis] - mesh.upper[axis];
  if (below < -margin || above < -margin)
    throw InputError(
        fmt::format("bulk_grid: from {} to {} m along {}, but the fluid mesh goes from {} to {} m: the bulk "
                    "grid must cover it",
                    grid.lower()[axis], grid.upper()[axis], "xyz"[axis], mesh.lower[axis], mesh.upper[axis]));
  if (grid.periodic()[axis] && (below > margin || above > margin))
    throw InputError(fmt::format(
        "bulk_grid: from {} to {} m along {}, where the particles' box is periodic, but the fluid mesh goes "
        "from {} to {} m: the two must be the same",
        grid.lower()[axis], grid.upper()[axis], "xyz"[axis], mesh.lower[axis], mesh.upper[axis]));
}

void require_same_kind(int axis, bool periodic, const Ends& ends) {
  const char name = "xyz"[axis];
  if (ends.cyclic > 0 && ends.cyclic < (1 - tolerance) * ends.area)
    throw InputError(
        fmt::format("only a part of the fluid mesh's ends along {} is cyclic: it must be all or none", name));
  if (periodic && ends.cyclic == 0)
    throw InputError(fmt::format(
        "foam_side and dem_side do not agree: along {0} the particles' box is periodic (LIGGGHTS: boundary "
        "with p in place {1}), but the fluid mesh has no cyclic patches at its ends along {0}. Give the mesh "
        "a "
        "pair of cyclic patches there, or the script a box that ends (boundary f)",
        name, axis + 1));
  if (!periodic && ends.cyclic > 0)
    throw InputError(fmt::format(
        "foam_side and dem_side do not agree: along {0} the fluid mesh is cyclic, but the particles' box is "
        "not periodic. Write p in place {1} of the script's boundary command, or give the mesh other patches "
        "at its ends along {0}",
        name, axis + 1));
}

/// Where such a mesh goes nobody knows beforehand.
bool flow_moves_bodies(const Foam::fvMesh& mesh) {
  const Foam::IOdictionary motion(Foam::IOobject("dynamicMeshDict", mesh.time().constant(), mesh.time(),
                                                 Foam::IOobject::READ_IF_PRESENT, Foam::IOobject::NO_WRITE,
                                                 false));
  const char* key = motion.found("motionSolver") ? "motionSolver" : "solver";  // as OpenFOAM
  const auto solver = motion.lookupOrDefault<Foam::word>(key, "");
  return solver == "rigidBodyMotion" || solver == "sixDoFRigidBodyMotion";
}

/// A wall that the mesh takes along has this velocity, or fluid would pass through it.
bool has_wall_that_moves(const Flow& flow) {
  for (const Foam::fvPatchVectorField& patch : flow.U.boundaryField())
    if (Foam::isA<Foam::movingWallVelocityFvPatchVectorField>(patch)) return true;
  return false;
}

/// What it gives at the start it gives for ever; a wall of any other type may begin to move later (omega as a
/// table).
bool is_constant(const Foam::fvPatchVectorField& patch) {
  return patch.type() == "fixedValue" || patch.type() == "noSlip" || patch.type() == "movingWallVelocity";
}

bool has_wall_with_velocity(const Flow& flow) {
  volVectorField U("velocityAtStart", flow.U);
  U.correctBoundaryConditions();  // the velocity that a condition gives, whatever 'value' says
  bool moves = false;
  for (const Foam::fvPatchVectorField& patch : U.boundaryField())
    if (Foam::isA<Foam::wallPolyPatch>(patch.patch().patch()) && patch.fixesValue()) {
      moves = moves || !is_constant(patch);
      for (const vector& velocity : patch) moves = moves || Foam::mag(velocity) > 0;
    }
  return Foam::returnReduce(moves, Foam::orOp<bool>());
}

}  // namespace

void require_mesh_fits(const BulkGrid& grid, const Foam::fvMesh& mesh, bool has_moved) {
  for (const Foam::polyPatch& patch : mesh.boundaryMesh()) {
    if (!Foam::isA<Foam::cyclicAMIPolyPatch>(patch)) continue;
    const auto& interface = Foam::refCast<const Foam::cyclicAMIPolyPatch>(patch);
    if (interface.separated() || !interface.parallel())
      throw InputError(
          fmt::format("the fluid mesh's patch {} of type {} joins places that lie apart: particles cannot "
                      "follow the fluid "
                      "there. Join the ends of a period by patches of type cyclic",
                      patch.name(), patch.type()));
  }
  const AllEnds ends = find_ends(mesh);
  if (ends.cyclic_elsewhere > 0)
    throw InputError(
        "the fluid mesh has cyclic patches that do not lie in the ends of its box: particles cannot follow "
        "the fluid there");
  const MeshBox box = mesh_box(mesh);
  for (int axis = 0; axis < 3; ++axis) {
    require_cover(grid, box, axis, has_moved);
    const bool solved = mesh.geometricD()[axis] == 1;
    if (solved) require_same_kind(axis, grid.periodic()[axis], ends.along[axis]);
  }
}

std::string slope_without_effect(const Foam::fvMesh& mesh, const GravityTable& gravity) {
  const AllEnds ends = find_ends(mesh);
  for (int axis = 0; axis < 3; ++axis) {
    if (ends.along[axis].cyclic == 0) continue;
    const auto along = [axis](const GravityTable::Row& row) { return std::abs(row.gravity[axis]); };
    const Vec3 g =
        std::max_element(gravity.rows.begin(), gravity.rows.end(), [&](const auto& a, const auto& b) {
          return along(a) < along(b);
        })->gravity;
    if (std::abs(g[axis]) > tolerance * norm(g))
      return fmt::format(
          "Gravity has {} m/s2 along {}, where the mesh is periodic: p_rgh balances it, so that it moves "
          "particles and "
          "not the fluid. Drive the fluid by constant/fvOptions (meanVelocityForce, "
          "vectorSemiImplicitSource) (docs/warnings.md, Gravity along a periodic direction)",
          g[axis], "xyz"[axis]);
  }
  return {};
}

void require_same_motion(const Flow& flow, const std::vector<std::string>& moved) {
  const bool mesh_moves = extras(flow).motion != MeshMotion::never;
  if (!moved.empty() && !mesh_moves && !has_wall_with_velocity(flow))
    throw InputError(fmt::format(
        "foam_side and dem_side do not agree: the script moves a surface (fix {}), but no wall of "
        "the "
        "fluid moves: the particles would be pushed through a fluid that stands still. A wall that moves "
        "along "
        "itself, as a drum about its axis, needs its velocity in the fluid case's U (rotatingWallVelocity, "
        "fixedValue); for any other motion the fluid's mesh has to move (constant/dynamicMeshDict). A "
        "surface "
        "that the fluid may flow through (a sieve, a thin paddle): name the fix in particles.unseen_surfaces",
        moved.front()));
  if (mesh_moves && flow_moves_bodies(flow.mesh))
    throw InputError(
        "constant/dynamicMeshDict: the flow moves bodies of the fluid's mesh (rigidBodyMotion, "
        "sixDoFRigidBodyMotion), and no surface of the script can follow them: with particles walls that "
        "move as prescribed, the same in the script (fix move/mesh), or a body that stays");
  if (moved.empty() && mesh_moves && has_wall_that_moves(flow))
    throw InputError(
        "foam_side and dem_side do not agree: walls of the fluid's mesh move (constant/dynamicMeshDict, "
        "movingWallVelocity), but no surface of the script does: move the same walls there with fix "
        "move/mesh");
}

}  // namespace demvof
