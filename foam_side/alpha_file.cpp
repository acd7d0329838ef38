// SPDX-License-Identifier: GPL-3.0-or-later
#include "foam_side/alpha_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "coupler/base/errors.hpp"

namespace demvof {
namespace {

using Foam::IOobject;
using Foam::word;

constexpr scalar typed = 1e-6;  // beyond [0, 1]: round-off of decimal input, and of files with six digits
// The same in a list of values, which a program has made: what transport of the surface, or a mapping of its
// result onto this mesh, leaves.
constexpr scalar computed = 1e-2;

// What a patch type gives to the fluid that comes in, or keeps; 'value' beside it is what it gives at the
// start.
constexpr std::array keys = {"inletValue", "uniformInletValue", "uniformValue", "refValue", "value"};

/// Calls look(value) for each number of an entry like "uniform 1", "1", "constant 1", "table ((0 0) (1 1))"
/// or "nonuniform List ..."; false when it is none of these. (A rank without cells has an empty list.)
template <class Look>
bool each_value(const Foam::entry& entry, const Look& look) {
  if (!entry.isStream()) return false;
  const Foam::tokenList& tokens = entry.stream();
  if (tokens.empty()) return false;
  if (tokens[0].isNumber()) {
    look(tokens[0].number());
    return true;
  }
  const word kind = tokens[0].isWord() ? tokens[0].wordToken() : word();
  if (kind == "uniform" || kind == "constant") {
    if (tokens.size() < 2 || !tokens[1].isNumber()) return false;
    look(tokens[1].number());
    return true;
  }
  if (kind == "table") {  // pairs of time and value
    for (label i = 0; i + 2 < tokens.size(); ++i)
      if (tokens[i].isNumber() && tokens[i + 1].isNumber() && tokens[i + 2] == Foam::token::END_LIST)
        look(tokens[i + 1].number());
    return true;
  }
  using Values = Foam::token::Compound<Foam::List<scalar>>;
  for (const Foam::token& token : tokens)
    if (token.isCompound())
      if (const auto* values = dynamic_cast<const Values*>(&token.compoundToken()))
        for (const scalar value : *values) look(value);
  return kind == "nonuniform";
}

bool is_list(const Foam::entry& entry) {
  const Foam::tokenList& tokens = entry.stream();
  return !tokens.empty() && tokens[0].isWord() && tokens[0].wordToken() == "nonuniform";
}

/// Calls look(patch, entry) for all that says what fluid there is at the patches.
template <class Look>
void each_patch_entry(const Foam::dictionary& file, const Look& look) {
  for (const Foam::entry& patch : file.subDict("boundaryField")) {
    if (!patch.isDict() || patch.dict().lookupOrDefault<word>("type", "") == "zeroGradient") continue;
    for (const char* key : keys)
      if (const Foam::entry* entry = patch.dict().findEntry(key, Foam::keyType::LITERAL)) look(patch, *entry);
  }
}

scalar beyond(scalar value) {
  return std::isfinite(value) ? std::max({scalar(0), -value, value - 1}) : Foam::GREAT;
}

/// The worst so far of what is beyond, and where it stands.
struct Worst {
  scalar excess = 0;
  std::string text;
  void look(const Foam::entry& entry, const std::string& where, scalar allowed) {
    each_value(entry, [&](scalar value) {
      const scalar excess_here = beyond(value);
      if (excess_here <= std::max(allowed, excess)) return;
      excess = excess_here;
      text = fmt::format("{}: {:g}", where, value);
    });
  }
};

std::string name_for_user(const Foam::Time& time, const std::string& field) {
  return (time.globalPath() / time.timeName() / field).c_str();
}

}  // namespace

AlphaFile::AlphaFile(const Foam::Time& time, const word& phase)
    : file_(IOobject("alpha." + phase, time.timeName(), time, IOobject::MUST_READ, IOobject::NO_WRITE, false),
            "volScalarField"),
      name_(name_for_user(time, "alpha." + phase)) {}

std::optional<scalar> AlphaFile::everywhere() const {
  std::optional<scalar> reference;
  bool one = true;
  const auto compare = [&](const Foam::entry& entry) {
    if (!entry.isStream()) return;
    one = one && !is_list(entry);
    each_value(entry, [&](scalar value) {
      if (!reference) reference = value;
      one = one && value == *reference;
    });
  };
  compare(file_.lookupEntry("internalField", Foam::keyType::LITERAL));
  each_patch_entry(file_, [&](const Foam::entry&, const Foam::entry& entry) { compare(entry); });
  // A rank with one fluid alone may have the other one's neighbour.
  const scalar low = Foam::returnReduce(reference.value_or(1), Foam::minOp<scalar>());
  const scalar high = Foam::returnReduce(reference.value_or(0), Foam::maxOp<scalar>());
  return Foam::returnReduce(one, Foam::andOp<bool>()) && low == high ? std::optional(high) : std::nullopt;
}

std::string AlphaFile::require_fractions() const {
  Worst wrong, list;
  const auto look = [&](const Foam::entry& entry, const std::string& where) {
    if (!entry.isStream()) return;
    wrong.look(entry, where, is_list(entry) ? computed : typed);
    if (is_list(entry)) list.look(entry, where, typed);
  };
  look(file_.lookupEntry("internalField", Foam::keyType::LITERAL), "internalField");
  each_patch_entry(file_, [&](const Foam::entry& patch, const Foam::entry& entry) {
    look(entry, fmt::format("boundaryField: {}: {}", static_cast<const std::string&>(patch.keyword()),
                            static_cast<const std::string&>(entry.keyword())));
  });
  Foam::List<Foam::string> texts(Foam::Pstream::nProcs());
  texts[Foam::Pstream::myProcNo()] = wrong.text;
  Foam::Pstream::gatherList(texts);
  Foam::Pstream::scatterList(texts);
  for (const Foam::string& text : texts)
    if (!text.empty())
      throw InputError(fmt::format("{}: {} is not allowed; the fraction of a fluid is a number from 0 to 1",
                                   name_, text.c_str()));
  const scalar most = Foam::returnReduce(list.excess, Foam::maxOp<scalar>());
  if (most == 0) return {};
  return fmt::format(
      "{} begins beyond [0, 1] by up to {:.2g}, and keeps that; an earlier run that left it: see there "
      "(docs/warnings.md, Liquid fraction out of bounds)",
      file_.name().c_str(), most);
}

}  // namespace demvof
