// SPDX-License-Identifier: GPL-3.0-or-later
#include "foam_side/said_by.hpp"

#include <fmt/format.h>

#include <fstream>
#include <regex>

#include "IFstream.H"
#include "StringStream.H"

namespace demvof {
namespace {

namespace fs = std::filesystem;
using Foam::dimensionSet;
using Foam::word;

Foam::dictionary read(const fs::path& file) {
  Foam::IFstream stream(file.string());
  return stream.good() ? Foam::dictionary(stream) : Foam::dictionary();
}

/// What stands before the values of a field, which may be binary.
Foam::dictionary read_head(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  std::string head, line;
  while (std::getline(stream, line)) {
    const auto values = line.find("internalField");
    head += line.substr(0, values) + "\n";
    if (values != std::string::npos) break;
  }
  Foam::IStringStream text(head);
  return Foam::dictionary(text);
}

/// A time's folder that holds fields: 0, or the latest that has one.
fs::path start_folder(const fs::path& folder) {
  fs::path found = folder / "0";
  double latest = 0;
  for (const auto& entry : fs::directory_iterator(folder)) {
    char* end = nullptr;
    const std::string name = entry.path().filename().string();
    const double time = std::strtod(name.c_str(), &end);
    if (end == name.c_str() || *end != 0 || time < latest || !fs::exists(entry.path() / "U")) continue;
    latest = time;
    found = entry.path();
  }
  return found;
}

std::string text_of(const dimensionSet& dimensions) {
  Foam::OStringStream stream;
  stream << dimensions;
  return stream.str();
}

/// The fields whose dimensions are not what they must be.
std::string wrong_dimensions(const fs::path& folder) {
  const fs::path start = start_folder(folder);
  std::vector<std::pair<fs::path, dimensionSet>> expected = {
      {start / "U", Foam::dimVelocity},
      {start / "p_rgh", Foam::dimPressure},
      {folder / "constant" / "g", Foam::dimAcceleration}};
  if (fs::exists(start))
    for (const auto& entry : fs::directory_iterator(start))
      if (entry.path().filename().string().rfind("alpha.", 0) == 0)
        expected.emplace_back(entry.path(), Foam::dimless);
  std::string wrong;
  for (const auto& [file, dimensions] : expected) {
    const Foam::dictionary field = read_head(file);
    if (!field.found("dimensions")) continue;
    const dimensionSet given(field.lookup("dimensions"));
    if (given != dimensions)
      wrong += fmt::format("{}: dimensions {} are not those of {}; give {}\n", file.string(), text_of(given),
                           file.filename().string(), text_of(dimensions));
  }
  if (!wrong.empty()) wrong.pop_back();
  return wrong;
}

/// Entries of fvSolution below "solvers" that name what does not exist.
std::string solvers_with(const fs::path& folder, const std::string& name) {
  std::string found;
  const Foam::dictionary solvers = read(folder / "system" / "fvSolution").subOrEmptyDict("solvers");
  for (const Foam::entry& solver : solvers) {
    if (!solver.isDict()) continue;
    for (const char* key : {"solver", "preconditioner", "smoother"}) {
      const Foam::entry* entry = solver.dict().findEntry(key, Foam::keyType::LITERAL);
      if (!entry) continue;
      const Foam::dictionary& part = entry->isDict() ? entry->dict() : solver.dict();
      if (part.lookupOrDefault<word>(key, "") == name)
        found += fmt::format("{}{}: {} {}", found.empty() ? "" : ", ",
                             static_cast<const std::string&>(solver.keyword()), key, name);
    }
  }
  return found;
}

}  // namespace

// Of an unknown interpolation scheme OpenFOAM says the reason to one stream, and exits through the other.
std::string said_by(const Foam::error& caught, const fs::path& folder) try {
  const bool elsewhere = caught.message().empty() && !Foam::FatalIOError.message().empty();
  const Foam::error& error = elsewhere ? Foam::FatalIOError : caught;
  const std::string message = error.message();
  if (message.find("IOstream \"sha1\"") != std::string::npos)
    return "system/controlDict: functions: this OpenFOAM cannot read function objects, nor can its own "
           "interFoam "
           "(Debian 13's package): take them out (docs/versions.md)";
  const auto* input = dynamic_cast<const Foam::IOerror*>(&error);
  if (!input) {  // not every operator says the word
    const std::string wrong = wrong_dimensions(folder);
    return wrong.empty() ? message : wrong;
  }
  if (!input->ioFileName().empty())
    return fmt::format("{}, line {}: {}", input->ioFileName().c_str(), input->ioStartLineNumber(), message);
  std::smatch unknown;
  if (std::regex_search(message, unknown,
                        std::regex("Unknown .*(preconditioner|smoother|solver)\\D* (\\w+)\n")))
    if (const std::string entries = solvers_with(folder, unknown[2]); !entries.empty())
      return fmt::format("system/fvSolution: solvers: {}: {}", entries, message);
  return message;
} catch (const std::exception&) {
  return caught.message();
}

}  // namespace demvof
