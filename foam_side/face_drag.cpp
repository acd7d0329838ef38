// SPDX-License-Identifier: GPL-3.0-or-later
#include "foam_side/face_drag.hpp"

#include "foam_side/cell_field.hpp"
#include "foam_side/flow.hpp"

namespace demvof {
namespace {

/// A field of cells alone, continued to the boundary.
template <class Type>
Foam::GeometricField<Type, Foam::fvPatchField, Foam::volMesh> with_boundary(
    const Foam::DimensionedField<Type, Foam::volMesh>& cells) {
  Foam::GeometricField<Type, Foam::fvPatchField, Foam::volMesh> field(
      Foam::IOobject(cells.name() + "OnFaces", cells.time().timeName(), cells.mesh(), Foam::IOobject::NO_READ,
                     Foam::IOobject::NO_WRITE, false),
      cells.mesh(), Foam::dimensioned<Type>(cells.dimensions(), Foam::Zero),
      Foam::zeroGradientFvPatchField<Type>::typeName);
  field.primitiveFieldRef() = cells.field();
  field.correctBoundaryConditions();
  return field;
}

}  // namespace

FaceDrag::FaceDrag(const Flow& flow, const volScalarField& A, const Foam::vectorField& force)
    : eps_f("eps_f", flow.porosity ? face_void_fraction(flow.porosity->eps)
                                   : surfaceScalarField::New("eps_f", flow.mesh,
                                                             dimensionedScalar("one", Foam::dimless, 1))),
      response("response", fvc::interpolate(1.0 / A)),
      resistance("resistance", 0 * eps_f),
      reference("reference", 0 * flow.phi),
      push("push", 0 * flow.phi),
      stiffness(flow.source->coefficient.field() / A.primitiveField()) {
  volScalarField drag(with_boundary(flow.source->coefficient));
  volVectorField pushed(with_boundary("force", flow.mesh, Foam::dimForce / Foam::dimVolume, force));
  volVectorField towards(drag * with_boundary(flow.source->reference));  // C u_ref
  if (flow.porosity) {
    // At the ends of the fluid the cell has the only side, whatever void fraction the patch gives the flux.
    const volScalarField eps(with_boundary(flow.porosity->eps()));
    response = fvc::interpolate(eps / A);
    drag /= Foam::sqr(eps);
    pushed /= eps;
    towards /= eps;
  }
  const surfaceScalarField drag_f(fvc::interpolate(drag));
  const dimensionedScalar tiny("tiny", drag.dimensions(), Foam::VSMALL);
  resistance = response * drag_f;
  reference = fvc::dotInterpolate(flow.mesh.Sf(), towards) / (drag_f + tiny);
  if (flow.porosity) {
    const volScalarField eps_drag("drag", with_boundary(flow.porosity->eps()) * drag);  // C/eps
    reference -= fvc::interpolate(eps_drag) / (drag_f + tiny) * flow.porosity->along;
  }
  push = response * fvc::dotInterpolate(flow.mesh.Sf(), pushed);
}

}  // namespace demvof
