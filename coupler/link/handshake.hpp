// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "coupler/link/link.hpp"

namespace demvof {

/// One line per item that both sides give and that differs: key, foam_side's value, dem_side's value.
/// The same text whichever side compares.
std::vector<std::string> disagreements(const std::vector<HandshakeItem>& fluid,
                                       const std::vector<HandshakeItem>& particles);

/// What a side says at the start. facts: JSON text of its own.
struct Handshake {
  std::vector<HandshakeItem> items;
  std::string facts;
};
std::string to_text(const Handshake& handshake);
/// Throws InputError when it is none of to_text().
Handshake read_handshake(const std::string& text);

}  // namespace demvof
