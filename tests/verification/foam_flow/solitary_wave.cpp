// SPDX-License-Identifier: GPL-3.0-or-later
// A solitary wave starts at its patch: OpenFOAM's own constructor reads the place from memory it gave back.

#include <gtest/gtest.h>

#include "BoussinesqWaveModel.H"
#include "foam_case.hpp"

namespace demvof::test {
namespace {

TEST(SolitaryWave, StartsAtItsPatch) {
  const FoamCase box("solitary_wave",
                     {{"lx", "0.1"}, {"ly", "0.1"}, {"lz", "0.1"}, {"nx", "10"}, {"ny", "10"}, {"nz", "10"}});
  const auto flow = box.open(scene(false, false, false));
  for (const char* name : {"bottom", "walls"}) {
    const Foam::polyPatch& patch = flow->mesh.boundaryMesh()[name];
    // false: neither dictionary nor paddles, which a lid has not.
    const Foam::waveModels::Boussinesq wave(Foam::dictionary(), flow->mesh, patch, false);
    Foam::OStringStream said;
    wave.info(said);
    const std::string text = said.str(), key = "x0: ";
    ASSERT_NE(text.find(key), std::string::npos) << text;
    EXPECT_NEAR(std::stod(text.substr(text.find(key) + key.size())),
                name == std::string("bottom") ? 0.005 : 0, 1e-12)
        << name;
  }
}

}  // namespace
}  // namespace demvof::test
