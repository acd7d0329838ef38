// SPDX-License-Identifier: GPL-3.0-or-later
#include "coupler/cli/slurm_options.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <sstream>

#include "coupler/base/errors.hpp"
#include "coupler/base/printable.hpp"

namespace demvof {
namespace {

[[noreturn]] void refuse(const std::string& what) {
  throw InputError("demvof run: --slurm-option: " + what);
}

void require_option(const std::string& option) {
  const auto control = [](unsigned char c) { return c < ' ' || c == 0x7f; };
  if (option.size() < 2 || option[0] != '-' || std::any_of(option.begin(), option.end(), control))
    refuse(
        fmt::format("'{}' is no option of sbatch; it takes one as it stands behind #SBATCH, e.g. "
                    "--slurm-option=--time=2:00:00",
                    printable(option)));
}

/// Long names and values; the last one of a name counts.
std::map<std::string, std::string> values_of(const std::vector<std::string>& options) {
  static const std::map<char, std::string> long_names = {
      {'t', "time"}, {'n', "ntasks"}, {'a', "array"}, {'D', "chdir"}};
  std::map<std::string, std::string> values;
  for (const std::string& line : options) {
    std::string waiting;  // for its value, which may be the next word
    std::istringstream words(line);
    for (std::string word; words >> word;) {
      if (word[0] != '-') {
        if (!waiting.empty()) values[waiting] = word;
        waiting.clear();
      } else if (word.rfind("--", 0) == 0) {
        const auto equals = word.find('=');
        waiting = equals == std::string::npos ? word.substr(2) : "";
        values[word.substr(2, equals - 2)] = equals == std::string::npos ? "" : word.substr(equals + 1);
      } else {
        const auto name = long_names.find(word.size() > 1 ? word[1] : ' ');
        waiting = name != long_names.end() && word.size() == 2 ? name->second : "";
        if (name != long_names.end()) values[name->second] = word.substr(2);
      }
    }
  }
  return values;
}

std::optional<long> whole_number(const std::string& text) {
  const bool digits =
      !text.empty() && text.size() < 10 &&
      std::all_of(text.begin(), text.end(), [](unsigned char c) { return c >= '0' && c <= '9'; });
  if (!digits) return std::nullopt;
  return std::stol(text);
}

/// Seconds before the limit at which demvof run is told to stop.
long lead_time(const std::string& signal) {
  const auto at = signal.find('@');
  const std::string target = signal.substr(0, at);
  std::string name = target.substr(0, 2) == "B:" ? target.substr(2) : "";
  if (name.rfind("SIG", 0) == 0) name.erase(0, 3);
  const std::optional<long> seconds = at == std::string::npos ? 60 : whole_number(signal.substr(at + 1));
  if ((name != "TERM" && name != "15" && name != "INT" && name != "2") || !seconds)
    refuse(fmt::format(
        "--signal={}: demvof run, which is the job's own process, stops with a state on TERM: give "
        "--signal=B:TERM@SECONDS",
        signal));
  return *seconds;
}

}  // namespace

std::optional<double> slurm_time(const std::string& text) {
  if (text == "UNLIMITED" || text == "INFINITE" || text == "infinite" || text == "unlimited") return HUGE_VAL;
  const auto dash = text.find('-');
  std::vector<double> parts;
  std::istringstream clock(dash == std::string::npos ? text : text.substr(dash + 1));
  for (std::string part; std::getline(clock, part, ':');) {
    const std::optional<long> number = whole_number(part);
    if (!number) return std::nullopt;
    parts.push_back(static_cast<double>(*number));
  }
  if (parts.empty() || parts.size() > 3 || text.back() == ':') return std::nullopt;
  double seconds = 0;
  if (dash != std::string::npos) {
    const std::optional<long> days = whole_number(text.substr(0, dash));
    if (!days) return std::nullopt;
    parts.resize(3);  // hours, minutes, seconds
    seconds = 86400.0 * static_cast<double>(*days) + 3600 * parts[0] + 60 * parts[1] + parts[2];
  } else if (parts.size() == 3) {
    seconds = 3600 * parts[0] + 60 * parts[1] + parts[2];
  } else {
    parts.resize(2);  // minutes, seconds
    seconds = 60 * parts[0] + parts[1];
  }
  return seconds > 0 ? seconds : HUGE_VAL;
}

void require_slurm_options(const std::vector<std::string>& options, int ranks) {
  for (const std::string& option : options) require_option(option);
  const std::map<std::string, std::string> given = values_of(options);
  if (given.count("array"))
    refuse("--array: its jobs would all write into one folder; submit the same script again instead");
  if (given.count("wrap")) refuse("--wrap: the script is the job");
  if (given.count("chdir"))
    refuse(
        fmt::format("--chdir={}: the paths in the script are seen from where demvof run --slurm was called; "
                    "call it there",
                    given.at("chdir")));
  if (const auto tasks = given.find("ntasks"); tasks != given.end()) {
    const std::optional<long> number = whole_number(tasks->second);
    if (!number || *number < ranks)
      refuse(fmt::format(
          "--ntasks={}: the run has {} ranks, which fluid.ranks and particles.ranks say: leave it out",
          tasks->second, ranks));
  }
  const auto signal = given.find("signal");
  const long lead = signal == given.end() ? time_to_stop : lead_time(signal->second);
  const auto time = given.find("time");
  if (time == given.end()) return;
  const std::optional<double> limit = slurm_time(time->second);
  if (!limit)
    refuse(
        fmt::format("--time={} is no time; sbatch takes minutes, minutes:seconds, hours:minutes:seconds, "
                    "days-hours[:minutes[:seconds]]",
                    time->second));
  if (*limit <= static_cast<double>(lead))
    refuse(
        fmt::format("--time={} are {:g} s, but {} s before its end the run is told to stop: more time, or "
                    "--slurm-option=--signal=B:TERM@SECONDS with fewer",
                    time->second, *limit, lead));
}

}  // namespace demvof
