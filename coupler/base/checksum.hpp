// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace demvof {

/// 64-bit FNV-1a (Fowler, Noll, Vo), byte by byte: each step is one to one, so that one changed byte always
/// shows. Against damage, not against forgery.
class Checksum {
 public:
  Checksum& add(const char* bytes, std::size_t count) {
    std::uint64_t hash = hash_;
    for (std::size_t i = 0; i < count; ++i)
      hash = (hash ^ static_cast<unsigned char>(bytes[i])) * 1099511628211ULL;
    hash_ = hash;
    return *this;
  }
  Checksum& add(std::string_view text) { return add(text.data(), text.size()); }

  /// 16 hexadecimal digits.
  std::string text() const {
    std::string digits(16, '0');
    for (std::size_t i = 0; i < 16; ++i) digits[15 - i] = "0123456789abcdef"[(hash_ >> (4 * i)) & 15U];
    return digits;
  }

 private:
  std::uint64_t hash_ = 14695981039346656037ULL;
};

}  // namespace demvof
