// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>

#include "coupler/link/own_world.hpp"

namespace demvof {

/// The one place where foam_side and dem_side turn the end of a run into an exit code and a message.
///
///   int main(int argc, char** argv) {
///     demvof::OwnWorld world(argc, argv, demvof::Side::fluid);
///     return demvof::guarded_main(world, [&] { ...; return 0; });
///   }
///
/// Runs the program and finalises MPI; returns its exit code. Does not return when it throws:
///   InputError 2, PartnerLost 4, everything else 3. The message (with side, stage and time, see
/// run_stage()) goes to stderr, the last words are spoken (set_last_words), the partner is told, and
/// the process ends without running any further destructor.
///
/// The program must have closed its link, or opened none, when it returns. Objects whose destructors
/// end the program (Foam::argList in a parallel run) must not live inside the body: unwinding would
/// hide the message.
int guarded_main(OwnWorld& world, const std::function<int()>& body);

}  // namespace demvof
