// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The OpenFOAM headers this program uses, in one place: they are slow to compile and go into the
// precompiled header. Below, the few names that every formula needs.

#include "CMULES.H"
#include "EulerDdtScheme.H"
#include "MULES.H"
#include "adjustPhi.H"
#include "alphaContactAngleTwoPhaseFvPatchScalarField.H"
#include "argList.H"
#include "constrainHbyA.H"
#include "constrainPressure.H"
#include "dynamicFvMesh.H"
#include "findRefCell.H"
#include "fixedValueFvPatchFields.H"
#include "fvc.H"
#include "fvm.H"
#include "gaussConvectionScheme.H"
#include "gravityMeshObject.H"
#include "immiscibleIncompressibleTwoPhaseMixture.H"
#include "pimpleControl.H"
#include "subCycle.H"
#include "turbulentTransportModel.H"
#include "uniformDimensionedFields.H"
#include "upwind.H"
#include "zeroGradientFvPatchFields.H"

namespace demvof {

namespace fvc = Foam::fvc;
namespace fvm = Foam::fvm;
using Foam::dimensionedScalar;
using Foam::label;
using Foam::scalar;
using Foam::scalarField;
using Foam::surfaceScalarField;
using Foam::surfaceVectorField;
using Foam::tmp;
using Foam::vector;
using Foam::volScalarField;
using Foam::volVectorField;

}  // namespace demvof
