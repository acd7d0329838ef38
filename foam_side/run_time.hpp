// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "foam_side/openfoam.hpp"

namespace demvof {

/// OpenFOAM's clock.
class RunTime : public Foam::Time {
 public:
  /// start: where to start in place of what controlDict says; nullptr: as it says.
  RunTime(const Foam::argList& args, const Foam::instant* start) : Time(controlDictName, args) {
    if (start) setTime(*start, startTimeIndex());
  }
  /// From here on only writeNow() writes, whatever controlDict says.
  void write_when_told() { writeControl_ = wcNone; }
};

}  // namespace demvof
