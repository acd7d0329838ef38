// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The OpenFOAM headers this program uses, in one place: they are slow to compile and go into the
// precompiled header. Names are used with their namespace.

#include "CMULES.H"
#include "EulerDdtScheme.H"
#include "MULES.H"
#include "adjustPhi.H"
#include "argList.H"
#include "constrainHbyA.H"
#include "constrainPressure.H"
#include "dynamicFvMesh.H"
#include "extrapolatedCalculatedFvPatchFields.H"
#include "findRefCell.H"
#include "fixedFluxPressureFvPatchScalarField.H"
#include "fvc.H"
#include "fvcSmooth.H"
#include "fvm.H"
#include "gaussConvectionScheme.H"
#include "immiscibleIncompressibleTwoPhaseMixture.H"
#include "pimpleControl.H"
#include "subCycle.H"
#include "turbulentTransportModel.H"
#include "uniformDimensionedFields.H"
#include "upwind.H"
#include "zeroGradientFvPatchFields.H"
