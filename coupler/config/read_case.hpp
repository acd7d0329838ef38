// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <stdexcept>
#include <string>
#include <vector>

#include "coupler/config/parameters.hpp"

namespace demvof {

/// The user's input is wrong. what() names file, line, key, value and what is allowed. Exit code 2.
struct InputError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Reads and checks a case file. overrides: "coupling.window=1e-4", applied on top, same checks.
/// Throws InputError with every mistake found in the file, one per line.
CaseParameters read_case(const std::string& file, const std::vector<std::string>& overrides = {});

/// The resolved configuration, defaults included, as JSON text; its hash is the configuration hash.
std::string resolved_configuration(const CaseParameters& parameters);
/// 16 hexadecimal digits; equal on both sides if and only if they run the same configuration.
std::string configuration_hash(const CaseParameters& parameters);

}  // namespace demvof
