// SPDX-License-Identifier: GPL-3.0-or-later
// Every file in bad/ is a case file with one kind of mistake. Its last lines say what a user has to be told:
//   # set: <an override that is given with it>
//   # expect: <one line of the message>   with case.yaml for the file itself, BAD for its folder, * for any
//   text
#include <fnmatch.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "coupler/config/read_case.hpp"

namespace {

namespace fs = std::filesystem;

const fs::path folder = fs::path(DEMVOF_TEST_FOLDER) / "bad";

std::vector<std::string> names() {
  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator(folder))
    if (entry.path().extension() == ".yaml") names.push_back(entry.path().stem().string());
  std::sort(names.begin(), names.end());
  return names;
}

struct BadCase {
  std::vector<std::string> overrides, expected;
};

void replace(std::string& text, const std::string& what, const std::string& by) {
  if (const std::size_t at = text.find(what); at != std::string::npos) text.replace(at, what.size(), by);
}

BadCase read_comments(const fs::path& file) {
  const std::string set = "# set: ", expect = "# expect: ";
  BadCase bad;
  std::ifstream stream(file);
  for (std::string line; std::getline(stream, line);) {
    if (line.rfind(set, 0) == 0) bad.overrides.push_back(line.substr(set.size()));
    if (line.rfind(expect, 0) != 0) continue;
    std::string text = line.substr(expect.size());
    replace(text, "case.yaml", file.string());
    replace(text, "BAD", folder.string());
    bad.expected.push_back(text);
  }
  return bad;
}

std::vector<std::string> message(const fs::path& file, const std::vector<std::string>& overrides) {
  try {
    demvof::read_case(file.string(), overrides);
  } catch (const demvof::InputError& error) {
    std::istringstream stream(error.what());
    std::vector<std::string> lines;
    for (std::string line; std::getline(stream, line);) lines.push_back(line);
    return lines;
  }
  return {};
}

bool matches(const std::string& line, std::string pattern) {
  // Only * is special; [ ] ? and \ stand in messages.
  std::string escaped;
  for (const char c : pattern)
    escaped += (std::string("[]?\\").find(c) == std::string::npos ? "" : "\\") + std::string(1, c);
  return fnmatch(escaped.c_str(), line.c_str(), 0) == 0;
}

class BadCaseFile : public testing::TestWithParam<std::string> {};

TEST_P(BadCaseFile, IsAnsweredAsExpected) {
  const fs::path file = folder / (GetParam() + ".yaml");
  const BadCase bad = read_comments(file);
  ASSERT_FALSE(bad.expected.empty()) << file << " expects nothing";
  const std::vector<std::string> lines = message(file, bad.overrides);
  EXPECT_EQ(lines.size(), bad.expected.size());
  for (std::size_t i = 0; i < std::min(lines.size(), bad.expected.size()); ++i)
    EXPECT_TRUE(matches(lines[i], bad.expected[i]))
        << "told:     " << lines[i] << "\nexpected: " << bad.expected[i];
}

INSTANTIATE_TEST_SUITE_P(Each, BadCaseFile, testing::ValuesIn(names()),
                         [](const auto& test) { return test.param; });

TEST(BadCaseFiles, AreManyKinds) {
  EXPECT_GE(names().size(), 40u);
}

TEST(BadCaseFiles, AFileThatIsNotThereIsNamed) {
  const std::string file = (folder / "no_such_case.yaml").string();
  EXPECT_EQ(message(file, {}), std::vector<std::string>{file + ": the case file cannot be read"});
  EXPECT_EQ(message(folder, {}),
            std::vector<std::string>{folder.string() + ": the case file cannot be read"});
}

TEST(BadCaseFiles, ManyMistakesAreCountedNotListed) {
  const fs::path file = fs::path(testing::TempDir()) / "many_mistakes.yaml";
  std::ofstream many(file);
  many << "fluid: {case: fluid}\ncoupling: {end_time: 1, window: 0.1}\n";
  for (int i = 0; i < 20000; ++i) many << "key_" << i << ": 1\n";
  many.close();
  const std::vector<std::string> lines = message(file, {});
  ASSERT_EQ(lines.size(), 51u);
  EXPECT_EQ(lines.back(), "... and 19951 more mistakes");
  fs::remove(file);
}

TEST(BadCaseFiles, AHugeFileIsNoCase) {
  const fs::path file = fs::path(testing::TempDir()) / "huge.yaml";
  std::ofstream(file) << std::string(1000001, 'a');
  EXPECT_EQ(message(file, {}),
            std::vector<std::string>{file.string() + ": a case file has at most 1000000 bytes"});
  fs::remove(file);
}

}  // namespace
