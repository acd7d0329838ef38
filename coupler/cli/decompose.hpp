// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <filesystem>
#include <functional>
#include <string>

namespace demvof {

/// Pieces of a mesh along x, y, z, as OpenFOAM's method `simple` cuts it.
using Cut = std::array<int, 3>;

/// All ranks along the longest side of the mesh's box.
Cut cut_along_longest(const std::array<double, 3>& sides, int ranks);
/// A cut for this number of ranks in the directions of a given one, as near to its proportions as whole
/// numbers allow; along the longest side where the given one cuts nothing.
Cut cut_like(const Cut& given, const std::array<double, 3>& sides, int ranks);

/// Runs one command in the case's folder; throws InputError with the end of its output when it fails.
using RunLogged = std::function<void(const std::string& command)>;

/// Decomposes the case in a folder for several ranks, by this command. Its system/decomposeParDict is changed
/// where it was written for another number of ranks, or asks for a method that this installation has as a
/// stub only, and made where it is missing; say is told of each change.
void decompose(const std::filesystem::path& fluid, int ranks, const std::string& command,
               const RunLogged& run, const std::function<void(const std::string&)>& say);

}  // namespace demvof
