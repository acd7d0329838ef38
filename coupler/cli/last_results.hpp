// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "coupler/cli/launch.hpp"
#include "coupler/config/parameters.hpp"

namespace demvof {

/// results.json of a run whose programs ended before either could write one: in the first instants, or with
/// mpirun. Leaves a results.json alone that is there:
/// this run wrote it, or it is that of the run which this one was to go on with.
void write_last_results(const std::filesystem::path& folder, const CaseParameters& parameters,
                        const std::vector<std::string>& command, const End& end);

/// Away with the notes of failing processes (coupler/link/failure.hpp).
void remove_notes(const std::filesystem::path& folder);

}  // namespace demvof
