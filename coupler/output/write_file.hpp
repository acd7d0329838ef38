// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>

namespace demvof {

/// Whether a file has to be on the disk before it gets its name, so that it is whole after a loss of power,
/// too. It takes a disk's time: for what a run is continued from, not for what is written every second.
enum class Durable { no, yes };

/// Replaces the file's content in one step: a reader, or a run killed in the middle, finds the old
/// content or the new one, never a part. Throws std::runtime_error with path and reason.
void write_file_atomically(const std::filesystem::path& path, const std::string& content,
                           Durable durable = Durable::no);

/// Renames a file that is complete to its final name, in the same folder.
/// Throws std::runtime_error with both paths and the reason.
void publish_file(const std::filesystem::path& complete, const std::filesystem::path& path);

/// Returns when the content of a file, or the names in a folder, are on the disk. Throws std::runtime_error.
void bring_to_disk(const std::filesystem::path& path);

/// The name under which a file is written before it is published; of this process alone.
std::filesystem::path part_name(const std::filesystem::path& path);

}  // namespace demvof
