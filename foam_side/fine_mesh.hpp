// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "coupler/transfer/remap.hpp"
#include "foam_side/openfoam.hpp"
#include "foam_side/vectors.hpp"

namespace demvof {

/// This rank's OpenFOAM mesh as the coupler sees it. The result refers to the mesh, which must
/// outlive it and keep its topology.
FineMesh fine_mesh(const Foam::fvMesh& mesh);

/// Corners of the whole mesh, all ranks, m.
struct MeshBox {
  Vec3 lower, upper;
};
MeshBox mesh_box(const Foam::fvMesh& mesh);

}  // namespace demvof
