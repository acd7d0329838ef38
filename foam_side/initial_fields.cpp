// SPDX-License-Identifier: GPL-3.0-or-later
#include "foam_side/initial_fields.hpp"

#include <optional>

#include "cellSet.H"
#include "foam_side/flow.hpp"
#include "topoSetSource.H"

namespace demvof {
namespace {

template <class Type>
using VolField = Foam::GeometricField<Type, Foam::fvPatchField, Foam::volMesh>;

/// What a list like ( volScalarFieldValue alpha.water 1 ... ) says about the field.
template <class Type>
std::optional<Type> listed_value(const Foam::dictionary& dictionary, const Foam::word& list,
                                 const VolField<Type>& field) {
  std::optional<Type> value;
  if (!dictionary.found(list)) return value;
  const Foam::word kind = field.type() + "Value";
  Foam::ITstream& in = dictionary.lookup(list);
  while (in.nRemainingTokens() > 0) {
    const Foam::token next(in);
    if (!next.isWord() || next.wordToken() != kind) continue;
    if (const Foam::word name(in); name != field.name()) continue;
    Type read;
    in >> read;
    value = read;
  }
  return value;
}

/// The field as the file says it; nothing when it does not name it.
template <class Type>
std::optional<Foam::Field<Type>> field_as_given(const Foam::dictionary& dictionary,
                                                const VolField<Type>& field) {
  if (!dictionary.found("regions")) return {};
  Foam::Field<Type> values(field.primitiveField());
  const std::optional<Type> elsewhere = listed_value(dictionary, "defaultFieldValues", field);
  if (elsewhere) values = *elsewhere;
  bool named = elsewhere.has_value();
  const Foam::PtrList<Foam::entry> regions(dictionary.lookup("regions"));
  forAll(regions, i) {
    const std::optional<Type> inside = listed_value(regions[i].dict(), "fieldValues", field);
    if (!inside) continue;
    auto source = Foam::topoSetSource::New(regions[i].keyword(), field.mesh(), regions[i].dict());
    if (source->setType() != Foam::topoSetSource::CELLSET_SOURCE) continue;
    source->verbose(false);
    Foam::cellSet cells(field.mesh(), "cellsOfRegion", field.mesh().nCells() / 10 + 1);
    source->applyToSet(Foam::topoSetSource::NEW, cells);
    for (const label cell : cells) values[cell] = *inside;
    named = true;
  }
  if (!named) return {};
  return values;
}

template <class Type>
bool is_as_given(const Foam::dictionary& dictionary, const VolField<Type>& field) {
  constexpr double written = 1e-5;  // fields may have been written with six digits
  const auto values = field_as_given(dictionary, field);
  bool same = values.has_value();
  if (same)
    forAll(field, cell) same =
        same && Foam::mag(field[cell] - (*values)[cell]) <= written * Foam::mag((*values)[cell]);
  return Foam::returnReduce(same, Foam::andOp<bool>());
}

}  // namespace

InitialFields::InitialFields(const Flow& flow)
    : dictionary_(Foam::IOobject("setFieldsDict", flow.time.system(), flow.time,
                                 Foam::IOobject::READ_IF_PRESENT, Foam::IOobject::NO_WRITE, false)),
      alpha_(is_as_given(dictionary_, flow.alpha)),
      velocity_(is_as_given(dictionary_, flow.U)) {}

void InitialFields::set(Flow& flow) const {
  if (alpha_) flow.alpha.primitiveFieldRef() = *field_as_given(dictionary_, flow.alpha);
  if (velocity_) flow.U.primitiveFieldRef() = *field_as_given(dictionary_, flow.U);
  flow.alpha.correctBoundaryConditions();
  flow.U.correctBoundaryConditions();
  flow.mixture.alpha2() = 1.0 - flow.alpha;
  flow.mixture.correct();
  flow.rho == flow.alpha* flow.mixture.rho1() + flow.mixture.alpha2() * flow.mixture.rho2();
}

}  // namespace demvof
