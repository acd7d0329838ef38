// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

namespace demvof {

/// demvof and everything it is built from, a line each: what to write down beside a result.
std::string versions();

}  // namespace demvof
