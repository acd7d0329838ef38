// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <mpi.h>

#include <string>

#include "coupler/base/errors.hpp"

namespace demvof {

/// Throws RunError with MPI's own words when a call did not succeed. Our communicators return their
/// errors (MPI_ERRORS_RETURN); a failed call nobody looks at is a hang later on.
inline void check_mpi(int code, const char* call) {
  if (code == MPI_SUCCESS) return;
  char text[MPI_MAX_ERROR_STRING];
  int length = 0;
  if (MPI_Error_string(code, text, &length) != MPI_SUCCESS) length = 0;
  throw RunError(std::string(call) + " failed: " + std::string(text, length));
}

}  // namespace demvof
