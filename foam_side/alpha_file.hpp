// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>

#include "foam_side/openfoam.hpp"
#include "localIOdictionary.H"

namespace demvof {

/// The field file of the first phase's fraction at the time of the start, before there is a mesh. On a
/// decomposed case each rank has its own.
class AlphaFile {
 public:
  /// Throws Foam::error when it cannot be read. Collective.
  AlphaFile(const Foam::Time& time, const Foam::word& phase);

  /// The fraction everywhere; none when both fluids are present, at the start or at a boundary where one can
  /// come in. Collective.
  std::optional<scalar> everywhere() const;

  /// Throws InputError for a number beyond [0, 1], in the field or at a patch: by more than round-off where
  /// somebody gives one number, and by more than an earlier run can have left in a list of them. Returns what
  /// to say about the latter, empty when there is nothing. Collective.
  std::string require_fractions() const;

 private:
  Foam::localIOdictionary file_;
  std::string name_;  // as the user knows it
};

}  // namespace demvof
