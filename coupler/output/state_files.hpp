// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <string>

namespace demvof {

/// What tells a file that is whole from one that was cut or changed.
struct FileFacts {
  std::uint64_t bytes = 0;
  std::string checksum;
  bool grows = false;  // more may follow behind these bytes
};

/// The files of a state, by their path from the folder of the run.
using StateFiles = std::map<std::string, FileFacts>;

/// Brings a file to the disk, reads it back and adds it; its name in the folder is not brought there. Throws
/// std::runtime_error.
void add_state_file(StateFiles& files, const std::filesystem::path& run, const std::filesystem::path& file,
                    bool grows = false);
/// The same for everything in a folder, and below, with its names.
void add_state_folder(StateFiles& files, const std::filesystem::path& run,
                      const std::filesystem::path& folder);

/// As JSON text, and back. Throws std::runtime_error when the text is none of to_text().
std::string to_text(const StateFiles& files);
StateFiles state_files(const std::string& text);

/// What is wrong with the first file that is not as it was, by name; empty when all are. wanted: those to
/// look at.
std::string find_damage(const StateFiles& files, const std::filesystem::path& run,
                        const std::function<bool(const std::string& name)>& wanted);

}  // namespace demvof
