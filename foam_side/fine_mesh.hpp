// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "coupler/transfer/remap.hpp"
#include "foam_side/openfoam.hpp"

namespace demvof {

/// This rank's OpenFOAM mesh as the coupler sees it. The result refers to the mesh, which must
/// outlive it and keep its topology.
FineMesh fine_mesh(const Foam::fvMesh& mesh);

/// Corners of the whole mesh, all ranks, m.
struct MeshBox {
  Vec3 lower, upper;
};
MeshBox mesh_box(const Foam::fvMesh& mesh);

inline Vec3 to_vec3(const Foam::vector& v) {
  return {v.x(), v.y(), v.z()};
}
inline Foam::vector to_foam(const Vec3& v) {
  return {v.x, v.y, v.z};
}

}  // namespace demvof
