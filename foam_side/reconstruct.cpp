// SPDX-License-Identifier: GPL-3.0-or-later
#include "foam_side/reconstruct.hpp"

namespace demvof {

Reconstruction::Reconstruction(const Foam::fvMesh& mesh)
    : mesh_(mesh),
      inverse_(Foam::inv(fvc::surfaceSum(mesh.Sf() * mesh.Sf() / mesh.magSf())().primitiveField())) {}

}  // namespace demvof
