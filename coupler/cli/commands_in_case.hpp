// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "coupler/config/parameters.hpp"

namespace demvof {

/// What a case would execute, or write outside of the run's folder, beyond computing: one line each, with
/// file and line. For cases of strangers (docs/security.md). It looks at words, not at meaning: it may name
/// what is harmless, and a case that it finds nothing in is still no reason for trust.
std::vector<std::string> commands_in_case(const CaseParameters& parameters);

/// Throws InputError with these lines, if there are any.
void require_no_commands(const CaseParameters& parameters);

}  // namespace demvof
