// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

#include "coupler/base/errors.hpp"

namespace demvof {

/// A text as it travels between the programs: its length in bytes, then the bytes.
inline std::vector<std::uint64_t> words_of(const std::string& text) {
  std::vector<std::uint64_t> words(1 + (text.size() + 7) / 8);
  words[0] = text.size();
  std::memcpy(words.data() + 1, text.data(), text.size());
  return words;
}

/// And back. Throws RunError when they are none of words_of().
inline std::string text_in(const std::vector<std::uint64_t>& words) {
  if (words.empty() || words[0] > 8 * (words.size() - 1))
    throw RunError("the partner sent a text that is not whole: is it of another version?");
  return {reinterpret_cast<const char*>(words.data() + 1), words[0]};
}

}  // namespace demvof
