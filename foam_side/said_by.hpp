// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>

#include "foam_side/openfoam.hpp"

namespace demvof {

/// What an error of OpenFOAM says, with the file and the line; and where it names none, the files of the
/// case that it is about, as far as they tell: field files for dimensions that do not fit, fvSolution for a
/// solver's part that does not exist. folder: of the prepared case.
std::string said_by(const Foam::error& error, const std::filesystem::path& folder);

}  // namespace demvof
