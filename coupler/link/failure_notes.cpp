// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include <fstream>
#include <string>

#include "coupler/link/failure.hpp"

namespace demvof {
namespace {

namespace fs = std::filesystem;

fs::path folder_of_notes;  // empty: no notes
Process writer;

fs::path note_file(const Process& process) {
  return folder_of_notes / fmt::format(".failed.{}.{}", side_name(process.side), process.rank);
}

// Tells the note of this process from that of an earlier one of the same rank.
std::string mark(const Process& process) {
  return fmt::format("{} {} {}", process.pid, process.start, process.host);
}

}  // namespace

void leave_notes_in(const fs::path& folder, const Process& self) {
  folder_of_notes = folder;
  writer = self;
  std::error_code ignored;
  fs::remove(note_file(self), ignored);
}

void leave_note(const Failure& failure) noexcept {
  try {
    if (folder_of_notes.empty()) return;
    const fs::path note = note_file(writer), part = note.string() + ".part";
    std::ofstream stream(part);
    stream << mark(writer) << "\n" << to_text(failure) << "\n";
    stream.close();
    std::error_code ignored;
    if (stream) fs::rename(part, note, ignored);
  } catch (...) {
  }
}

std::optional<Failure> note_of(const Process& process) {
  if (folder_of_notes.empty()) return std::nullopt;
  std::ifstream stream(note_file(process));
  std::string whose, text;
  if (!std::getline(stream, whose) || whose != mark(process) || !std::getline(stream, text))
    return std::nullopt;
  return failure_from(text);
}

}  // namespace demvof
