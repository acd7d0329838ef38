// SPDX-License-Identifier: GPL-3.0-or-later
#include "coupler/output/state_files.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <vector>

#include "coupler/base/checksum.hpp"
#include "coupler/output/write_file.hpp"

namespace demvof {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

/// Of the first bytes of a file; fewer when it is shorter.
FileFacts read_facts(const fs::path& file, std::uint64_t longest) {
  std::ifstream stream(file, std::ios::binary);
  if (!stream) throw std::runtime_error(fmt::format("cannot read {}", file.string()));
  std::vector<char> buffer(1 << 20);
  FileFacts facts;
  Checksum checksum;
  while (stream && facts.bytes < longest) {
    const auto wanted = std::min<std::uint64_t>(buffer.size(), longest - facts.bytes);
    stream.read(buffer.data(), static_cast<std::streamsize>(wanted));
    checksum.add(buffer.data(), static_cast<std::size_t>(stream.gcount()));
    facts.bytes += static_cast<std::uint64_t>(stream.gcount());
  }
  if (stream.bad()) throw std::runtime_error(fmt::format("cannot read {}", file.string()));
  facts.checksum = checksum.text();
  return facts;
}

std::string damage_of(const fs::path& file, const FileFacts& then) {
  std::error_code error;
  if (!fs::is_regular_file(file, error)) return "is not there";
  const std::uint64_t bytes = fs::file_size(file, error);
  if (error) return error.message();
  if (then.grows ? bytes < then.bytes : bytes != then.bytes)
    return fmt::format("has {} bytes, but {} were written", bytes, then.bytes);
  try {
    if (read_facts(file, then.bytes).checksum != then.checksum) return "is not what was written";
  } catch (const std::runtime_error& unreadable) {
    return unreadable.what();
  }
  return "";
}

}  // namespace

void add_state_file(StateFiles& files, const fs::path& run, const fs::path& file, bool grows) {
  bring_to_disk(file);
  FileFacts facts = read_facts(file, fs::file_size(file));
  facts.grows = grows;
  files[file.lexically_relative(run).generic_string()] = facts;
}

void add_state_folder(StateFiles& files, const fs::path& run, const fs::path& folder) {
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(folder))
    if (entry.is_regular_file())
      add_state_file(files, run, entry.path());
    else if (entry.is_directory())
      bring_to_disk(entry.path());
  bring_to_disk(folder);
  bring_to_disk(folder.parent_path());
}

std::string to_text(const StateFiles& files) {
  json text = json::object();
  for (const auto& [name, facts] : files) {
    text[name] = {{"bytes", facts.bytes}, {"checksum", facts.checksum}};
    if (facts.grows) text[name]["grows"] = true;
  }
  return text.dump();
}

StateFiles state_files(const std::string& text) {
  StateFiles files;
  try {
    const json all = json::parse(text);
    for (const auto& [name, facts] : all.items())
      files[name] = {facts.at("bytes").get<std::uint64_t>(), facts.at("checksum").get<std::string>(),
                     facts.value("grows", false)};
  } catch (const json::exception& error) {
    throw std::runtime_error(fmt::format("the list of a state's files: {}", error.what()));
  }
  return files;
}

std::string find_damage(const StateFiles& files, const fs::path& run,
                        const std::function<bool(const std::string& name)>& wanted) {
  for (const auto& [name, facts] : files) {
    if (!wanted(name)) continue;
    const std::string damage = damage_of(run / name, facts);
    if (!damage.empty()) return name + " " + damage;
  }
  return "";
}

}  // namespace demvof
