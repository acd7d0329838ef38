// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <fmt/format.h>

#include <string>

namespace demvof {

inline unsigned char byte_of(char c) {
  return static_cast<unsigned char>(c);
}

/// A text of somebody's file as a message may show it: what a terminal would take for a command, or for the
/// end of a line, is spelled out ("\\x1b"). kept: control characters that are let through.
inline std::string printable(const std::string& text, const char* kept = "") {
  const std::string let_through = kept;
  std::string shown;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const unsigned char c = byte_of(text[i]);
    // U+0080 to U+009F, in UTF-8 0xc2 and one more, are control characters, too.
    const bool second_set = c == 0xc2 && i + 1 < text.size() && byte_of(text[i + 1]) < 0xa0;
    if ((c >= 0x20 && c != 0x7f && !second_set) || let_through.find(text[i]) != std::string::npos) {
      shown += text[i];
      continue;
    }
    shown += fmt::format("\\x{:02x}", c);
    if (second_set) shown += fmt::format("\\x{:02x}", byte_of(text[++i]));
  }
  return shown;
}

/// A whole message, of several lines, whatever files and programs it quotes.
inline std::string printable_lines(const std::string& text) {
  return printable(text, "\n\t");
}

/// At most so many bytes, whole characters of UTF-8, with "..." for the rest.
inline std::string cut(const std::string& text, std::size_t longest) {
  if (text.size() <= longest) return text;
  while (longest > 0 && (byte_of(text[longest]) & 0xc0U) == 0x80U) --longest;  // inside of a character
  return text.substr(0, longest) + "...";
}

}  // namespace demvof
