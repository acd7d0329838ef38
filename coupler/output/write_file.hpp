// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>

namespace demvof {

/// Replaces the file's content in one step: a reader, or a run killed in the middle, finds the old
/// content or the new one, never a part. Throws std::runtime_error with path and reason.
void write_file_atomically(const std::filesystem::path& path, const std::string& content);

/// Renames a file that is complete to its final name, in the same folder.
/// Throws std::runtime_error with both paths and the reason.
void publish_file(const std::filesystem::path& complete, const std::filesystem::path& path);

}  // namespace demvof
