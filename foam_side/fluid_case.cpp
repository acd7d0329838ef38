// SPDX-License-Identifier: GPL-3.0-or-later
#include "foam_side/fluid_case.hpp"

#include <fmt/format.h>

#include <cerrno>
#include <cstring>
#include <fstream>
#include <iostream>
#include <string>
#include <vector>

#include "coupler/base/errors.hpp"

namespace demvof {

namespace fs = std::filesystem;

namespace {

void require_prepared(const fs::path& folder, int ranks) {
  if (!fs::exists(folder / "system" / "controlDict"))
    throw InputError(
        fmt::format("no prepared fluid case in {}: run `demvof prepare` with the same case file "
                    "and --out first (`demvof run` does it by itself)",
                    folder.string()));
  int decomposed = 0;
  while (fs::exists(folder / fmt::format("processor{}", decomposed))) ++decomposed;
  if (ranks > 1 && decomposed != ranks)
    throw InputError(fmt::format(
        "the fluid case in {} is {}, but foam_side runs on {} ranks: run `demvof prepare` with --set "
        "fluid.ranks={} first",
        folder.string(), decomposed == 0 ? "not decomposed" : fmt::format("decomposed for {}", decomposed),
        ranks, ranks));
  const fs::path mesh = (ranks > 1 ? folder / "processor0" : folder) / "constant" / "polyMesh" / "faces";
  if (!fs::exists(mesh) && !fs::exists(mesh.string() + ".gz"))
    throw InputError(
        fmt::format("the fluid case in {} has no mesh ({} is missing): does fluid.prepare make one?",
                    folder.string(), mesh.string()));
}

/// A file that remembers the first error of a write, and takes everything all the same: OpenFOAM ends the
/// program where its stream is bad, mostly in a place from which nothing can be thrown.
class LogFile : public std::filebuf {
 public:
  int error() const { return error_; }

 protected:
  int_type overflow(int_type c) override {
    if (traits_type::eq_int_type(std::filebuf::overflow(c), traits_type::eof())) note();
    return traits_type::not_eof(c);
  }
  std::streamsize xsputn(const char* bytes, std::streamsize count) override {
    if (std::filebuf::xsputn(bytes, count) != count) note();
    return count;
  }
  int sync() override {
    if (std::filebuf::sync() != 0) note();
    return 0;
  }

 private:
  void note() {
    if (is_open() && error_ == 0) error_ = errno;
  }
  int error_ = 0;
};

// Never destroyed: std::cout writes into it until the very end of the program.
LogFile& log_file = *new LogFile;
fs::path log_name;

}  // namespace

void send_output_to(const fs::path& log, int rank) {
  log_name = log;
  if (rank == 0) log_file.open(log, std::ios::out);
  std::cout.rdbuf(&log_file);
}

void require_whole_log() {
  log_file.pubsync();
  if (log_file.error() != 0)
    throw RunError(fmt::format("cannot write {}: {}", log_name.string(), std::strerror(log_file.error())));
}

Foam::argList* open_case(const fs::path& folder, const OwnWorld& world) {
  require_prepared(folder, world.size());
  std::vector<std::string> words = {"foam_side", "-case", folder.string()};
  if (world.size() > 1) words.push_back("-parallel");
  std::vector<char*> pointers;
  for (std::string& word : words) pointers.push_back(word.data());
  int count = static_cast<int>(pointers.size());
  char** begin = pointers.data();
  Foam::FatalError.throwExceptions();
  Foam::FatalIOError.throwExceptions();
  // Known to the end, as the leak sanitizer wants it; volatile, for nobody reads it.
  static Foam::argList* volatile kept = nullptr;
  kept = new Foam::argList(count, begin, false, true);
  return kept;
}

}  // namespace demvof
