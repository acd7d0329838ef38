// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>

namespace demvof {

/// What to do about an error of LIGGGHTS while it read the script: the line at fault and its replacement, as
/// far as the error tells; empty when it says enough by itself.
std::string advice_on(const std::string& error, const std::filesystem::path& script);

/// Throws InputError for a command on which LIGGGHTS would crash.
void refuse_before_it_is_read(const std::filesystem::path& script);

/// True when the script's line that makes the fix of this name has the word: what LIGGGHTS does not tell.
bool fix_has_word(const std::filesystem::path& script, const std::string& fix, const std::string& word);

}  // namespace demvof
