// SPDX-License-Identifier: GPL-3.0-or-later
// Without particles the solver is interFoam: the distribution's program on the same dam break.

#include <gtest/gtest.h>

#include <fstream>

#include "foam_case.hpp"

namespace demvof::test {
namespace {

struct Variant {
  const char* name;
  Settings settings;
  bool surface_tension;
  const char* sources = "";  // constant/fvOptions
};

FoamCase make_case(const std::string& side, const Variant& variant) {
  FoamCase made(side + "_" + variant.name, variant.settings);
  if (*variant.sources) {
    std::ofstream file(made.folder() + "/constant/fvOptions");
    file << "FoamFile { version 2.0; format ascii; class dictionary; object fvOptions; }\n"
         << variant.sources;
  }
  made.run("setFields");
  return made;
}

void PrintTo(const Variant& variant, std::ostream* out) {
  *out << variant.name;
}

class SameAsInterFoam : public testing::TestWithParam<Variant> {};

TEST_P(SameAsInterFoam, DamBreak50Steps) {
  const Variant& variant = GetParam();
  const FoamCase theirs = make_case("interfoam", variant), ours = make_case("foam_side", variant);
  theirs.run("interFoam");
  const auto flow = ours.open(scene(false, false, variant.surface_tension));
  advance(*flow);
  ASSERT_EQ(flow->clock.steps, 50);

  const Foam::fileName folder(theirs.folder());
  Foam::Time their_time(Foam::Time::controlDictName, folder.path(), Foam::fileName(folder.name()));
  their_time.setTime(their_time.times().last(), 0);
  EXPECT_NEAR(their_time.value(), flow->time.value(), 1e-9 * flow->time.value()) << "other time steps";
  const Foam::fvMesh their_mesh(Foam::IOobject(Foam::fvMesh::defaultRegion, their_time.timeName(), their_time,
                                               Foam::IOobject::MUST_READ));
  const auto file = [&](const char* name) {
    return Foam::IOobject(name, their_time.timeName(), their_mesh, Foam::IOobject::MUST_READ);
  };
  const volScalarField alpha(file("alpha.water"), their_mesh);
  const volVectorField U(file("U"), their_mesh);
  const volScalarField p(file("p"), their_mesh);
  const double speed = Foam::gMax(Foam::mag(U.primitiveField())());
  ASSERT_GT(speed, 0.3) << "the dam did not break";
  const double alpha_difference =
      Foam::gMax(Foam::mag(alpha.primitiveField() - flow->alpha.primitiveField())());
  const double U_difference = Foam::gMax(Foam::mag(U.primitiveField() - flow->U.primitiveField())());
  const double p_difference = Foam::gMax(Foam::mag(p.primitiveField() - flow->p.primitiveField())());
  std::cout << variant.name << ": largest difference after 50 steps: alpha " << alpha_difference << ", U "
            << U_difference << " m/s of " << speed << ", p " << p_difference << " Pa\n";
  EXPECT_LT(alpha_difference, 1e-6);
  EXPECT_LT(U_difference, 1e-5 * speed);
  EXPECT_LT(p_difference, 1e-4 * 1000 * 9.81 * 0.1);
}

const Settings tight{{"p_tolerance", "1e-10"}, {"p_rel_tol", "0"}};

Settings with(Settings settings) {
  settings.insert(tight.begin(), tight.end());
  return settings;
}

// Fluid that is pushed aside, explicitly and implicitly, through a medium that resists.
constexpr const char* push_and_resistance = R"(
push
{
    type            vectorSemiImplicitSource;
    selectionMode   all;
    volumeMode      specific;
    injectionRateSuSp { U ((100 0 0) -50); }
}
medium
{
    type            explicitPorositySource;
    explicitPorositySourceCoeffs
    {
        selectionMode   cellZone;
        cellZone        box;
        type            DarcyForchheimer;
        d               (1e6 1e6 1e6);
        f               (10 10 10);
        coordinateSystem { origin (0 0 0); e1 (1 0 0); e2 (0 1 0); }
    }
}
)";

INSTANTIATE_TEST_SUITE_P(
    Settings, SameAsInterFoam,
    testing::Values(
        Variant{"explicit_mules", with({}), false},
        Variant{"sub_cycles", with({{"alpha_sub_cycles", "3"}}), false},
        Variant{"surface_tension", with({{"sigma", "0.07"}, {"predictor", "yes"}}), true},
        Variant{"semi_implicit_mules", with({{"mules_corr", "yes"}, {"alpha_correctors", "2"}}), false},
        Variant{"outer_correctors", with({{"outer_correctors", "2"}, {"alpha_sub_cycles", "2"}}), false},
        Variant{"k_epsilon", with({{"turbulence", "RAS"}, {"ras_model", "kEpsilon"}}), false},
        Variant{"k_omega_sst",
                with({{"turbulence", "RAS"}, {"ras_model", "kOmegaSST"}, {"predictor", "yes"}}), false},
        Variant{"contact_angle",
                with({{"sigma", "0.07"},
                      {"alpha_sub_cycles", "2"},
                      {"walls_alpha",
                       "{ type constantAlphaContactAngle; theta0 60; limit gradient; value uniform 0; }"}}),
                true},
        // One correction: OpenFOAM's scheme evaluates the old derivative of the flux anew in each call of
        // ddtCorr, so that interFoam's memory of the flux depends on their number; here it is evaluated once
        // per step.
        Variant{"crank_nicolson",
                with({{"ddt", "CrankNicolson 0.9"}, {"predictor", "yes"}, {"pressure_correctors", "1"}}),
                false},
        Variant{"moving_mesh",
                with({{"mesh", "dynamicMotionSolverFvMesh"},
                      {"walls_U", "{ type movingWallVelocity; value uniform (0 0 0); }"},
                      {"bottom_U", "{ type movingWallVelocity; value uniform (0 0 0); }"}}),
                false},
        Variant{"relaxed_by_one", with({{"relaxation", "{ equations { \".*\" 1; } }"}, {"predictor", "yes"}}),
                false},
        Variant{"sources", with({{"predictor", "yes"}}), false, push_and_resistance},
        Variant{"as_shipped_tolerances", {{"sigma", "0.07"}}, true}),
    [](const testing::TestParamInfo<Variant>& info) { return info.param.name; });

}  // namespace
}  // namespace demvof::test
