// SPDX-License-Identifier: GPL-3.0-or-later
// Where a solitary wave (waveModel Boussinesq, Grimshaw, McCowan) starts: x0 = min over the patch of x cos(a)
// + y sin(a).
//
// OpenFOAM's constructor keeps a reference to the field of that sum, which is a temporary, and reads x0 from
// the memory after it was given back: it ends by SIGFPE in six of ten starts (interFoam does as well), or the
// wave starts elsewhere. This is that constructor with a field that lives. The program's symbol comes before
// the library's, whose models call theirs through the dynamic linker's table; left out where the class keeps
// the field itself (CMakeLists.txt).

#include <list>

#include "SubField.H"
#include "polyPatch.H"
#include "solitaryWaveModel.H"

namespace {

// x of the patch's faces (the angle is 0 until the dictionary is read); a wave or two in a run.
const Foam::scalarField& kept_positions(const Foam::polyPatch& patch) {
  static std::list<Foam::scalarField> kept;
  return kept.emplace_back(patch.faceCentres().component(0));
}

}  // namespace

Foam::waveModels::solitaryWaveModel::solitaryWaveModel(const dictionary& dict, const fvMesh& mesh,
                                                       const polyPatch& patch, const bool readFields)
    : waveGenerationModel(dict, mesh, patch, false),
      waveHeight_(0),
      waveAngle_(0),
      x_(kept_positions(patch)),
      x0_(gMin(x_)) {
  if (readFields) readDict(dict);
}
