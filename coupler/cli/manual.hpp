// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <CLI/Formatter.hpp>
#include <string>

namespace demvof {

/// Help in the form of a manual page. An application's description is its one-line NAME, its footer
/// everything that follows the options, in sections of its own.
class ManualPage : public CLI::Formatter {
 public:
  ManualPage();
  std::string make_help(const CLI::App* app, std::string name, CLI::AppFormatMode mode) const override;
  std::string make_group(std::string group, bool is_positional,
                         std::vector<const CLI::Option*> options) const override;
};

// The sections behind the options.
extern const char* const main_manual;
extern const char* const new_manual;
extern const char* const check_manual;
extern const char* const prepare_manual;
extern const char* const run_manual;
extern const char* const report_manual;
extern const char* const study_manual;
extern const char* const schema_manual;
extern const char* const reference_manual;

}  // namespace demvof
