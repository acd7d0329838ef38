// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

namespace demvof {

/// A text of somebody's file as a message may show it: what a terminal would take for a command, or for the
/// end of a line, is spelled out ("\\x1b").
std::string printable(const std::string& text);

/// At most so many bytes, whole characters of UTF-8, with "..." for the rest.
std::string cut(const std::string& text, std::size_t longest);

}  // namespace demvof
