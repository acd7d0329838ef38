// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

namespace demvof {

/// JSON Schema (draft 2020-12) of the case file, for editors that complete YAML.
std::string case_file_schema();

/// The reference of the case file, in Markdown.
std::string case_file_reference();

}  // namespace demvof
