// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "foam_side/flow.hpp"

namespace demvof {

/// Throws Foam::error for a source of fvOptions that no equation here has a place for. Part of open_flow.
void require_sources_to_act(const Flow& flow);

/// Throws Foam::error for a source whose cells would not be the same when the mesh has refined itself. Part
/// of open_flow.
void require_sources_to_follow(const Flow& flow);

/// Sources that go on from what they did: writes where they stand into the present time folder, where
/// OpenFOAM's own look for it when a run goes on; by themselves they write in steps alone that are known to
/// be an output's. Throws RunError when it cannot be written.
void write_source_states(const Flow& flow);

/// Sources that keep what nobody can ask them for: a run with them cannot go on. One line, or empty.
std::string sources_that_forget(const Flow& flow);

/// Sources of which nobody here knows whether they do. One line, or empty.
std::string unknown_sources(const Flow& flow);

}  // namespace demvof
