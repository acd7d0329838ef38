// SPDX-License-Identifier: GPL-3.0-or-later
#include "foam_side/case_sources.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <string_view>
#include <vector>

#include "OFstream.H"
#include "cellSetOption.H"
#include "coupler/base/errors.hpp"
#include "dynamicRefineFvMesh.H"
#include "foam_side/extras.hpp"
#include "meanVelocityForce.H"

namespace demvof {
namespace {

using Foam::word;
using Foam::fv::meanVelocityForce;
using Foam::fv::option;

/// Their derived classes may look at these.
struct OpenOption : option {
  static const Foam::wordList& fields(const option& source) { return source.*(&OpenOption::fieldNames_); }
  static const word& type(const option& source) { return source.*(&OpenOption::modelType_); }
};
struct OpenMeanVelocity : meanVelocityForce {
  static scalar gradient(const meanVelocityForce& source) {
    return source.*(&OpenMeanVelocity::gradP0_) + source.*(&OpenMeanVelocity::dGradP_);
  }
};

/// Of OpenFOAM's own: what they give follows from dictionary, time and flow.
constexpr std::array without_memory = {"vectorSemiImplicitSource",
                                       "vectorFixedValueConstraint",
                                       "explicitPorositySource",
                                       "actuationDiskSource",
                                       "radialActuationDiskSource",
                                       "rotorDisk",
                                       "tabulatedAccelerationSource",
                                       "buoyancyForce",
                                       "acousticDampingSource",
                                       "velocityDampingConstraint",
                                       "limitVelocity",
                                       "multiphaseMangrovesSource",
                                       "vectorPhaseLimitStabilization"};
constexpr std::array of_other_kinds = {"scalar", "sphericalTensor", "symmTensor", "tensor"};

bool begins_with(std::string_view text, std::string_view begin) {
  return text.substr(0, begin.size()) == begin;
}

const std::string& type_of(const option& source) {
  return OpenOption::type(source);
}

std::vector<const option*> active_sources(const Flow& flow) {
  std::vector<const option*> active;
  const Foam::fv::optionList& all = extras(flow).sources;
  forAll(all, i) if (all[i].active()) active.push_back(&all[i]);
  return active;
}

/// Functions of controlDict, as scalarTransport, have equations of their own.
bool named_by_function(const Flow& flow, const word& field) {
  for (const Foam::entry& function : flow.time.controlDict().subOrEmptyDict("functions")) {
    if (!function.isDict()) continue;
    const Foam::entry* names = nullptr;
    for (const char* key : {"field", "fields"})
      if (!names) names = function.dict().findEntry(key, Foam::keyType::LITERAL);
    if (!names) {
      if (function.dict().lookupOrDefault<word>("type", "") == "scalarTransport" && field == "s") return true;
      continue;
    }
    for (const Foam::token& token : names->stream())
      if (token.isWord() && token.wordToken() == field) return true;
  }
  return false;
}

bool acts_on(const Flow& flow, const option& source, const word& field) {
  if (field == flow.U.name()) {
    const std::string type = type_of(source);
    return std::none_of(of_other_kinds.begin(), of_other_kinds.end(),
                        [&](const char* kind) { return begins_with(type, kind); });
  }
  if (named_by_function(flow, field)) return true;
  const word alpha = flow.alpha.member();
  const bool of_flow = begins_with(field, alpha + ".") || field == flow.p.name() ||
                       field == flow.p_rgh.name() || field == flow.rho.name();
  return flow.scene.turbulence && !of_flow && flow.mesh.thisDb().found(field);  // of the turbulence model
}

/// Trimmed rotors, and gradients of each cell's own.
bool forgets(const option& source) {
  const std::string& type = type_of(source);
  if (type == "directionalPressureGradientExplicitSource") return true;
  return type == "rotorDisk" &&
         source.coeffs().lookupOrDefault<word>("trimModel", "fixedTrim") != "fixedTrim";
}

std::string said_of(const Flow& flow, const option& source) {
  const Foam::fv::options& all = extras(flow).sources;
  const Foam::dictionary& file = all.found("options") ? all.subDict("options") : all;
  const Foam::dictionary* const own = file.findDict(source.name(), Foam::keyType::LITERAL);
  const std::string line = own ? fmt::format(":{}", own->startLineNumber()) : "";
  return fmt::format("{}/fvOptions{}: {} ({})", static_cast<const std::string&>(all.instance()), line,
                     source.name(), type_of(source));
}

}  // namespace

void require_sources_to_act(const Flow& flow) {
  for (const option* source : active_sources(flow)) {
    const Foam::wordList& fields = OpenOption::fields(*source);
    const auto acts = [&](const word& field) { return acts_on(flow, *source, field); };
    if (fields.empty() || std::any_of(fields.begin(), fields.end(), acts)) continue;
    FatalErrorInFunction
        << fmt::format(
               "{}: it would do nothing to {}: sources act on {}{}, each by those of its kind (vector...): "
               "remove it, or give it a field that it can change",
               said_of(flow, *source),
               fmt::join(std::vector<std::string>(fields.begin(), fields.end()), ", "), flow.U.name(),
               flow.scene.turbulence ? " and what the turbulence model solves for" : " alone in this case")
               .c_str()
        << Foam::exit(Foam::FatalError);  // throws
  }
}

void require_sources_to_follow(const Flow& flow) {
  if (!Foam::isA<Foam::dynamicRefineFvMesh>(flow.mesh)) return;
  using Cells = Foam::fv::cellSetOption;
  for (const option* source : active_sources(flow)) {
    const auto* cells = dynamic_cast<const Cells*>(source);
    if (!cells) continue;
    if (cells->selectionMode() == Cells::smAll || cells->selectionMode() == Cells::smCellZone) continue;
    FatalErrorInFunction
        << fmt::format(
               "{}: selectionMode: on a mesh that refines itself all or cellZone: a set and points keep the "
               "cells that they had, or their volume (a zone from a set: topoSet's cellZoneSet, "
               "setToCellZone)",
               said_of(flow, *source))
               .c_str()
        << Foam::exit(Foam::FatalError);  // throws
  }
}

void write_source_states(const Flow& flow) {
  for (const option* source : active_sources(flow)) {
    const auto* force = dynamic_cast<const meanVelocityForce*>(source);
    if (!force) continue;
    Foam::IOdictionary state(Foam::IOobject(source->name() + "Properties", flow.time.timeName(), "uniform",
                                            flow.mesh, Foam::IOobject::NO_READ, Foam::IOobject::NO_WRITE,
                                            false));
    state.add("gradient", OpenMeanVelocity::gradient(*force));
    const Foam::fileName file = state.objectPath();
    Foam::mkDir(file.path());
    Foam::OFstream stream(file);
    stream.precision(17);  // whatever the case writes its fields with
    bool written = state.writeHeader(stream) && state.writeData(stream);
    Foam::IOobject::writeEndDivider(stream);
    stream.flush();
    if (!written || !stream.good())
      throw RunError(
          fmt::format("cannot write {}: is the disk full?", static_cast<const std::string&>(file)));
  }
}

std::string sources_that_forget(const Flow& flow) {
  std::vector<std::string> names;
  for (const option* source : active_sources(flow))
    if (forgets(*source)) names.push_back(said_of(flow, *source));
  if (names.empty()) return {};
  return fmt::format(
      "{}: what this source keeps from step to step cannot be had from it: the run cannot be continued "
      "(docs/warnings.md, Sources without a state)",
      fmt::join(names, ", "));
}

std::string unknown_sources(const Flow& flow) {
  std::vector<std::string> names;
  for (const option* source : active_sources(flow)) {
    const std::string& type = type_of(*source);
    const bool known = dynamic_cast<const meanVelocityForce*>(source) != nullptr || forgets(*source) ||
                       std::find(without_memory.begin(), without_memory.end(), type) != without_memory.end();
    if (!known && source->applyToField(flow.U.name()) != -1) names.push_back(said_of(flow, *source));
  }
  if (names.empty()) return {};
  return fmt::format(
      "{}: what such a source may keep from step to step is not in the states of the run: with --continue it "
      "begins anew (docs/warnings.md, Sources without a state)",
      fmt::join(names, ", "));
}

}  // namespace demvof
