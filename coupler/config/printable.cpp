// SPDX-License-Identifier: GPL-3.0-or-later
#include "coupler/config/printable.hpp"

#include <fmt/format.h>

namespace demvof {
namespace {

unsigned char byte(char c) {
  return static_cast<unsigned char>(c);
}

}  // namespace

std::string printable(const std::string& text) {
  std::string shown;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const unsigned char c = byte(text[i]);
    // U+0080 to U+009F, in UTF-8 0xc2 and one more, are control characters, too.
    const bool second_set = c == 0xc2 && i + 1 < text.size() && byte(text[i + 1]) < 0xa0;
    if (c >= 0x20 && c != 0x7f && !second_set) {
      shown += text[i];
      continue;
    }
    shown += fmt::format("\\x{:02x}", c);
    if (second_set) shown += fmt::format("\\x{:02x}", byte(text[++i]));
  }
  return shown;
}

std::string cut(const std::string& text, std::size_t longest) {
  if (text.size() <= longest) return text;
  while (longest > 0 && (byte(text[longest]) & 0xc0U) == 0x80U) --longest;  // inside of a character
  return text.substr(0, longest) + "...";
}

}  // namespace demvof
