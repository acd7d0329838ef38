// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "foam_side/openfoam.hpp"

namespace demvof {

template <class Type>
using VolField = Foam::GeometricField<Type, Foam::fvPatchField, Foam::volMesh>;

/// Cell values as a field with a boundary, continued to walls unchanged. Registered, since OpenFOAM's
/// interpolations keep point values by name and look at the event number.
template <class Type>
VolField<Type> with_boundary(const Foam::word& name, const Foam::fvMesh& mesh,
                             const Foam::dimensionSet& dimensions, const Foam::Field<Type>& cells) {
  VolField<Type> field(Foam::IOobject(name, mesh.time().timeName(), mesh), mesh,
                       Foam::dimensioned<Type>(dimensions, Foam::Zero),
                       Foam::zeroGradientFvPatchField<Type>::typeName);
  field.primitiveFieldRef() = cells;
  field.correctBoundaryConditions();
  return field;
}

}  // namespace demvof
