// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <limits>
#include <map>
#include <string>
#include <vector>

#include "coupler/config/parameters.hpp"

namespace demvof {

/// Where the user gave a value: a line of the case file, or an override.
struct Source {
  static constexpr int override_line = std::numeric_limits<int>::max();  // sorts behind the file

  std::string name;  // the file, or "--set"
  int line = 0;      // from 1; 0: the whole file
};

struct Mistake {
  Source source;
  std::string key;   // path; empty: none
  std::string text;  // value given, and what is allowed
};
using Mistakes = std::vector<Mistake>;

/// One line per mistake, "file:line: key: text", in the order of the file.
std::string report(Mistakes mistakes);

/// Checks that concern several keys or the file system. A check is left out when one of its keys is
/// wrong already. sources: where each given key and section stands.
void check_case(const CaseParameters& parameters, const std::map<std::string, Source>& sources,
                Mistakes& mistakes);

}  // namespace demvof
