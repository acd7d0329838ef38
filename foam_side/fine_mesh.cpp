// SPDX-License-Identifier: GPL-3.0-or-later
#include "foam_side/fine_mesh.hpp"

#include <algorithm>
#include <limits>

namespace demvof {

namespace {

Polyhedron polyhedron(const Foam::fvMesh& mesh, int cell) {
  Polyhedron shape;
  for (const label face : mesh.cells()[cell]) {
    std::vector<Vec3> corners;
    for (const label point : mesh.faces()[face]) corners.push_back(to_vec3(mesh.points()[point]));
    // OpenFOAM's face normals point from owner to neighbour: out of the owner.
    if (mesh.faceOwner()[face] != cell) std::reverse(corners.begin(), corners.end());
    shape.faces.push_back(std::move(corners));
  }
  return shape;
}

}  // namespace

FineMesh fine_mesh(const Foam::fvMesh& mesh) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  const std::size_t count = static_cast<std::size_t>(mesh.nCells());
  FineMesh fine;
  fine.volume.assign(mesh.V().begin(), mesh.V().end());
  fine.centre.resize(count);
  for (std::size_t cell = 0; cell < count; ++cell) fine.centre[cell] = to_vec3(mesh.cellCentres()[cell]);

  fine.lower.assign(count, {infinity, infinity, infinity});
  fine.upper.assign(count, {-infinity, -infinity, -infinity});
  const auto widen = [&](label cell, const Vec3& lower, const Vec3& upper) {
    for (int axis = 0; axis < 3; ++axis) {
      fine.lower[cell][axis] = std::min(fine.lower[cell][axis], lower[axis]);
      fine.upper[cell][axis] = std::max(fine.upper[cell][axis], upper[axis]);
    }
  };
  for (label face = 0; face < mesh.nFaces(); ++face) {
    Vec3 lower{infinity, infinity, infinity}, upper{-infinity, -infinity, -infinity};
    for (const label point : mesh.faces()[face])
      for (int axis = 0; axis < 3; ++axis) {
        lower[axis] = std::min(lower[axis], mesh.points()[point][axis]);
        upper[axis] = std::max(upper[axis], mesh.points()[point][axis]);
      }
    widen(mesh.faceOwner()[face], lower, upper);
    if (face < mesh.nInternalFaces()) widen(mesh.faceNeighbour()[face], lower, upper);
  }
  fine.shape = [&mesh](int cell) { return polyhedron(mesh, cell); };
  return fine;
}

MeshBox mesh_box(const Foam::fvMesh& mesh) {
  return {to_vec3(mesh.bounds().min()), to_vec3(mesh.bounds().max())};  // global bounds
}

}  // namespace demvof
