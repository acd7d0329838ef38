// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

namespace demvof {

/// The word closest to a mistyped one by edit distance (insert, delete, replace, swap of neighbours);
/// empty when none is near enough to be meant.
std::string nearest(const std::string& typed, const std::vector<std::string>& words);

/// "; did you mean 'window'?", or empty.
std::string did_you_mean(const std::string& typed, const std::vector<std::string>& words);

}  // namespace demvof
