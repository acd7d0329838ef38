// SPDX-License-Identifier: GPL-3.0-or-later
#include "foam_side/scene_facts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "coupler/base/errors.hpp"
#include "foam_side/fine_mesh.hpp"
#include "localIOdictionary.H"
#include "turbulenceModel.H"

namespace demvof {

namespace {

using Foam::IOobject;
using Foam::word;

Foam::dictionary read_dictionary(const Foam::Time& time, const Foam::fileName& folder, const word& name) {
  return Foam::IOdictionary(IOobject(name, folder, time, IOobject::MUST_READ, IOobject::NO_WRITE, false));
}

/// True when every value that an entry like "uniform 1" or "nonuniform List ..." states is the same
/// as reference; the first value seen becomes the reference.
bool only_value(const Foam::entry& entry, std::optional<scalar>& reference) {
  if (!entry.isStream()) return true;
  Foam::ITstream& stream = entry.stream();
  stream.rewind();
  const Foam::token first(stream);
  scalar value = 0;
  if (first.isWord() && first.wordToken() == "uniform")
    stream >> value;
  else if (first.isNumber())
    value = first.number();
  else
    return !(first.isWord() && first.wordToken() == "nonuniform");
  if (!reference) reference = value;
  return value == *reference;
}

/// The fraction of the first phase everywhere; none when both fluids are present, at the start or at a
/// boundary where one can come in.
std::optional<scalar> fraction_everywhere(const Foam::Time& time, const word& phase) {
  const Foam::localIOdictionary alpha(
      IOobject("alpha." + phase, time.timeName(), time, IOobject::MUST_READ, IOobject::NO_WRITE, false),
      "volScalarField");
  std::optional<scalar> value;
  bool one = only_value(alpha.lookupEntry("internalField", Foam::keyType::LITERAL), value);
  for (const Foam::entry& patch : alpha.subDict("boundaryField"))
    if (patch.isDict() && patch.dict().lookupOrDefault<word>("type", "") != "zeroGradient")
      for (const char* key : {"inletValue", "value"})
        if (const Foam::entry* entry = patch.dict().findEntry(key, Foam::keyType::LITERAL))
          one = only_value(*entry, value) && one;
  // A rank with one fluid alone may have the other one's neighbour.
  const scalar low = Foam::returnReduce(value.value_or(1), Foam::minOp<scalar>());
  const scalar high = Foam::returnReduce(value.value_or(0), Foam::maxOp<scalar>());
  return Foam::returnReduce(one, Foam::andOp<bool>()) && low == high ? std::optional(high) : std::nullopt;
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
  const std::optional<scalar> fraction = fraction_everywhere(time, phases[0]);
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
