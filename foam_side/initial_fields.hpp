// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "IOdictionary.H"

namespace demvof {

struct Flow;

/// Liquid and velocity at the start as system/setFieldsDict gives them, for a mesh that gets finer.
///
/// A field counts as given by that file when it is named there and has, in every cell, the value that the
/// file's regions say. So neither a run that goes on from a later time nor fields made in another way are
/// ever set again.
class InitialFields {
 public:
  explicit InitialFields(const Flow& flow);
  bool given() const { return alpha_ || velocity_; }
  /// The same fields on the mesh as it is now.
  void set(Flow& flow) const;

 private:
  Foam::IOdictionary dictionary_;
  bool alpha_, velocity_;
};

}  // namespace demvof
