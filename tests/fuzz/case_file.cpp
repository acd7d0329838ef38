// SPDX-License-Identifier: GPL-3.0-or-later
// A case file of any bytes is read, or refused with its name, the line and the key.
#include <unistd.h>

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <random>
#include <regex>
#include <sstream>
#include <string>
#include <vector>

#include "coupler/base/errors.hpp"
#include "coupler/config/keys.hpp"
#include "coupler/config/read_case.hpp"

extern "C" std::size_t LLVMFuzzerMutate(std::uint8_t* data, std::size_t size, std::size_t longest)
    __attribute__((weak));

namespace {

namespace fs = std::filesystem;

// ---- what a refusal has to be

[[noreturn]] void complain(const char* what, const std::string& text) {
  std::fprintf(stderr, "%s\n%s\n", what, text.c_str());
  std::abort();
}

void require_good_refusal(const std::string& file, const std::string& said) {
  constexpr std::size_t longest = 200000;
  if (said.empty() || said.size() > longest) complain("a refusal of no or endless words", said);
  static const std::regex line_and_what(R"(:[0-9]+: .+)");
  // Of the file as a whole, and of sections and keys that are not there.
  static const std::regex whole_file(
      R"(: (.*missing; .*|the case file (is empty|is no map|cannot be read).*|a case file has at most.*))");
  std::istringstream lines(said);
  for (std::string line; std::getline(lines, line);) {
    if (std::any_of(line.begin(), line.end(),
                    [](char c) { return static_cast<unsigned char>(c) < 0x20 || c == 0x7f; }))
      complain("a control character", said);
    if (line.rfind("... and ", 0) == 0) continue;
    const std::string rest = line.rfind(file, 0) == 0 ? line.substr(file.size()) : "";
    if (!std::regex_match(rest, line_and_what) && !std::regex_match(rest, whole_file))
      complain("a line without file and line", line);
  }
}

// ---- mutants that know what a case file looks like

using Random = std::minstd_rand;

template <class Items>
const auto& one_of(const Items& items, Random& random) {
  return items[random() % items.size()];
}

const std::vector<std::string>& odd_values() {
  static const std::vector<std::string> values = {"",
                                                  "0",
                                                  "-1",
                                                  "1",
                                                  "1e300",
                                                  "-1e-320",
                                                  "1e5000",
                                                  ".nan",
                                                  "-.inf",
                                                  "0x10",
                                                  "017",
                                                  "1_000",
                                                  "1 m",
                                                  "~",
                                                  "null",
                                                  "true",
                                                  "off",
                                                  "\"1\"",
                                                  "''",
                                                  "'",
                                                  "\"",
                                                  "[]",
                                                  "[1, 2]",
                                                  "[1, 2, 3]",
                                                  "[[[1]]]",
                                                  "{}",
                                                  "{a: b}",
                                                  "{drag: none}",
                                                  "[drag, {drag: stokes}]",
                                                  ",",
                                                  "]",
                                                  "}",
                                                  "- 1",
                                                  "? x",
                                                  ": x",
                                                  "|",
                                                  ">-",
                                                  "&a [*a]",
                                                  "*a",
                                                  "&a",
                                                  "!!binary x",
                                                  "!x",
                                                  "<<: *a",
                                                  "%YAML 3",
                                                  "---",
                                                  "...",
                                                  "# x",
                                                  "\t",
                                                  "\x1b[2J",
                                                  "\\",
                                                  "\"\\x1b\\n\"",
                                                  "\xff\xfe",
                                                  "\xc2\x85",
                                                  "9223372036854775808",
                                                  "1000000000000",
                                                  "[1000000, 1000000, 1000000]",
                                                  "../../../etc/passwd",
                                                  std::string(300, 'a'),
                                                  std::string(5000, 'b'),
                                                  std::string(500, '['),
                                                  std::string(2000, '{')};
  return values;
}

std::string random_value(Random& random) {
  const demvof::Key& key = one_of(demvof::case_keys(), random);
  if (!key.rule.choices.empty() && random() % 4 == 0) return one_of(key.rule.choices, random);
  return one_of(odd_values(), random);
}

std::string random_key(Random& random) {
  const std::string& path = random() % 4 == 0 ? one_of(demvof::case_sections(), random).path
                                              : one_of(demvof::case_keys(), random).path;
  return random() % 8 == 0 ? path : demvof::name_of_key(path);
}

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

/// Changes one line, or the order or number of lines.
std::string mutated_lines(const std::string& text, Random& random) {
  std::vector<std::string> lines = lines_of(text);
  if (lines.empty()) lines.emplace_back();
  const std::size_t at = random() % lines.size();
  std::string& line = lines[at];
  switch (random() % 7) {
    case 0:
      line = line.substr(0, line.find(':')) + ": " + random_value(random);
      break;
    case 1: {
      const std::string indent(2 * (random() % 3), ' ');
      const std::string added = indent + random_key(random) + ": " + random_value(random);
      lines.insert(lines.begin() + static_cast<std::ptrdiff_t>(at), added);
      break;
    }
    case 2:
      lines.erase(lines.begin() + static_cast<std::ptrdiff_t>(at));
      break;
    case 3:
      lines.insert(lines.begin() + static_cast<std::ptrdiff_t>(random() % lines.size()), std::string(line));
      break;
    case 4:
      std::swap(line, lines[random() % lines.size()]);
      break;
    case 5:
      line = random() % 2 ? "  " + line : line.substr(std::min<std::size_t>(2, line.size()));
      break;
    default:
      line = line.substr(0, line.find_first_not_of(" -")) + random_key(random) + ": " + random_value(random);
  }
  std::string joined;
  for (const std::string& one : lines) joined += one + "\n";
  return joined;
}

std::string mutated_bytes(std::string text, Random& random) {
  const std::size_t at = random() % (text.size() + 1);
  switch (random() % 4) {
    case 0:
      if (at < text.size()) text[at] = static_cast<char>(text[at] ^ (1 << random() % 8));
      return text;
    case 1:
      return text.erase(at, 1 + random() % 20);
    case 2:
      return text.insert(at, 1, static_cast<char>(random() % 256));
    default:
      return text.insert(at, one_of(odd_values(), random));
  }
}

}  // namespace

extern "C" {

std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size, std::size_t longest,
                                    unsigned seed) {
  Random random(seed);
  if (LLVMFuzzerMutate && random() % 4 == 0) return LLVMFuzzerMutate(data, size, longest);
  std::string text(reinterpret_cast<const char*>(data), size);
  for (unsigned more = 1 + random() % 3; more > 0; --more)
    text = random() % 4 == 0 ? mutated_bytes(text, random) : mutated_lines(text, random);
  const std::size_t kept = std::min(text.size(), longest);
  std::memcpy(data, text.data(), kept);
  return kept;
}

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const fs::path folder = [] {
    const fs::path made = fs::temp_directory_path() / ("demvof_fuzz_" + std::to_string(getpid()));
    fs::create_directories(made / "fluid" / "system");
    std::ofstream(made / "fluid" / "system" / "controlDict");
    std::ofstream(made / "in.script");
    std::atexit([] {
      std::error_code ignored;
      fs::remove_all(fs::temp_directory_path() / ("demvof_fuzz_" + std::to_string(getpid())), ignored);
    });
    return made;
  }();
  const std::string file = (folder / "case.yaml").string();
  fs::remove(file);  // some file systems bring a file that is replaced to the disk
  std::ofstream(file, std::ios::binary)
      .write(reinterpret_cast<const char*>(data), static_cast<std::streamsize>(size));
  try {
    const demvof::CaseParameters read = demvof::read_case(file, {});
    demvof::configuration_hash(read);
    demvof::resolved_configuration(read);
  } catch (const demvof::InputError& error) {
    require_good_refusal(file, error.what());
  }
  return 0;
}
}
