// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "coupler/base/errors.hpp"
#include "coupler/config/parameters.hpp"

namespace demvof {

/// Reads and checks a case file. overrides: "coupling.window=1e-4", applied on top, same checks.
/// Throws InputError with every mistake found in the file, one per line.
CaseParameters read_case(const std::string& file, const std::vector<std::string>& overrides = {});

/// A path of the case file (fluid.case, particles.script), which counts from the case file's folder.
std::filesystem::path beside_case_file(const CaseParameters& parameters, const std::string& path);

/// The resolved configuration, defaults included, as JSON text. It is a case file itself: read again
/// (beside the same files), it gives the same parameters.
std::string resolved_configuration(const CaseParameters& parameters);
/// 16 hexadecimal digits (FNV-1a of the resolved configuration without the rank counts, which change no
/// result and may be given to mpirun alone); equal on both sides exactly when they run the same case.
std::string configuration_hash(const CaseParameters& parameters);

}  // namespace demvof
