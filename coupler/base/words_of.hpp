// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <exception>
#include <new>
#include <string>

namespace demvof {

/// What an exception says; that of a failed allocation says nothing by itself.
inline std::string words_of(const std::exception& error) {
  if (!dynamic_cast<const std::bad_alloc*>(&error)) return error.what();
  return "the machine has no more memory for it.\nWhat to try: a coarser mesh or bulk grid, or more "
         "machines.";
}

}  // namespace demvof
