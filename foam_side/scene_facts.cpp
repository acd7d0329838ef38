// SPDX-License-Identifier: GPL-3.0-or-later
#include "foam_side/scene_facts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <optional>

#include "coupler/base/errors.hpp"
#include "foam_side/alpha_file.hpp"
#include "foam_side/fine_mesh.hpp"
#include "turbulenceModel.H"

namespace demvof {

namespace {

using Foam::IOobject;
using Foam::word;

Foam::dictionary read_dictionary(const Foam::Time& time, const Foam::fileName& folder, const word& name) {
  return Foam::IOdictionary(IOobject(name, folder, time, IOobject::MUST_READ, IOobject::NO_WRITE, false));
}

/// As constant/dynamicMeshDict says. A mesh that only refines itself stays where it is.
bool mesh_moves(const Foam::Time& time) {
  const Foam::dictionary mesh = Foam::IOdictionary(IOobject(
      "dynamicMeshDict", time.constant(), time, IOobject::READ_IF_PRESENT, IOobject::NO_WRITE, false));
  const auto type = mesh.lookupOrDefault<word>("dynamicFvMesh", "staticFvMesh");
  return type != "staticFvMesh" && type != "dynamicRefineFvMesh";
}

/// A property of the fluids that can be; else the file, the line and what is allowed.
scalar property(const Foam::dictionary& dictionary, const char* key, const Foam::dimensionSet& dimensions,
                double lowest, double highest, const char* unit) {
  const scalar value = dimensionedScalar(key, dimensions, dictionary).value();
  if (value >= lowest && value <= highest) return value;
  throw InputError(fmt::format(
      "constant/transportProperties:{}: {}: {:g} is not allowed; give a number from {:g} to {:g} ({})",
      dictionary.lookupEntry(key, Foam::keyType::LITERAL).startLineNumber(), key, value, lowest, highest,
      unit));
}

void require_fluid(const Foam::dictionary& transport, const word& phase) {
  const Foam::dictionary& fluid = transport.subDict(phase);
  property(fluid, "rho", Foam::dimDensity, 1e-6, 1e6, "kg/m3");
  if (fluid.lookupOrDefault<word>("transportModel", "") == "Newtonian")
    property(fluid, "nu", Foam::dimViscosity, 0, 1e3, "m2/s");
}

/// What to say where commands that set the fluids' places have left one alone; empty else. fraction: of the
/// first phase everywhere.
std::string one_fluid_alone(const Foam::Time& time, const Foam::wordList& phases, scalar fraction) {
  if (fraction != 0 && fraction != 1) return {};
  const word field = "alpha." + phases[0];
  for (const char* name : {"setFieldsDict", "setAlphaFieldDict"}) {
    const Foam::fileName file = time.globalPath() / time.system() / name;
    std::ifstream stream(file);
    const std::string text(std::istreambuf_iterator<char>(stream), {});
    if (text.find(field) == std::string::npos) continue;
    return fmt::format(
        "{} is {:g} everywhere, and no patch brings anything else: there is no {} in this run, though "
        "system/{} "
        "has regions for it. Do they lie in the mesh, in metres as it is (docs/warnings.md, One fluid "
        "alone)?",
        field.c_str(), fraction, phases[fraction == 0 ? 0 : 1].c_str(), name);
  }
  return {};
}

}  // namespace

// Lives until the program ends: with it the libraries that controlDict names would be unloaded, and what
// they have registered in OpenFOAM's tables points to nothing then.
const Foam::Time& case_time(const Foam::argList& args) {
  static const Foam::Time* const time = new Foam::Time(Foam::Time::controlDictName, args);
  return *time;
}

SceneFacts fluid_facts(const Foam::argList& args) {
  const Foam::Time& time = case_time(args);
  const Foam::dictionary transport = read_dictionary(time, time.constant(), "transportProperties");
  const Foam::wordList phases(transport.lookup("phases"));
  SceneFacts facts;
  facts.surface_tension = property(transport, "sigma", Foam::dimForce / Foam::dimLength, 0, 1e3, "N/m");
  for (const word& phase : phases) require_fluid(transport, phase);
  const AlphaFile alpha(time, phases[0]);
  facts.advice.push_back(alpha.require_fractions());
  const std::optional<scalar> fraction = alpha.everywhere();
  if (fraction) facts.advice.push_back(one_fluid_alone(time, phases, *fraction));
  facts.two_fluids = !fraction;
  const auto density = [&transport](const word& phase) {
    return dimensionedScalar("rho", Foam::dimDensity, transport.subDict(phase)).value();
  };
  if (!fraction || *fraction > 0) facts.liquid_density = density(phases[0]);
  if (!fraction || *fraction < 1) facts.gas_density = density(phases[1]);
  const Foam::dictionary turbulence =
      read_dictionary(time, time.constant(), Foam::turbulenceModel::propertiesName);
  facts.mesh_moves = mesh_moves(time);
  facts.turbulent = word(turbulence.lookup("simulationType")) != "laminar";
  return facts;
}

Vec3 case_gravity(const Foam::argList& args) {
  const Foam::Time& time = case_time(args);
  const Foam::uniformDimensionedVectorField g(
      IOobject("g", time.constant(), time, IOobject::MUST_READ, IOobject::NO_WRITE, false));
  return to_vec3(g.value());
}

std::string gravity_that_jumps(const Vec3& of_case, const GravityTable& gravity, double start) {
  constexpr double typed_twice = 1e-6;  // relative
  const Vec3 first = gravity.at(start);
  if (norm(first - of_case) <= typed_twice * norm(of_case)) return {};
  return fmt::format(
      "gravity.table begins with [{}, {}, {}] m/s2, constant/g and fix gravity have [{}, {}, {}]: the table "
      "has the "
      "whole of gravity, and the run starts with its first one (docs/warnings.md, Gravity of a table)",
      first.x, first.y, first.z, of_case.x, of_case.y, of_case.z);
}

}  // namespace demvof
