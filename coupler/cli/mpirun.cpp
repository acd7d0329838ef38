// SPDX-License-Identifier: GPL-3.0-or-later
#include "coupler/cli/mpirun.hpp"

#include <fmt/format.h>
#include <mpi.h>

#include <algorithm>
#include <regex>
#include <stdexcept>
#include <string>

#include "coupler/cli/child_process.hpp"

namespace demvof {
namespace {

/// Name and version in what an MPI says of itself; its first line where it is not Open MPI.
Mpirun read_version(const std::string& said) {
  Mpirun mpi;
  std::smatch found;
  if (std::regex_search(said, found, std::regex(R"(Open MPI\)? v?(([0-9]+)\.[0-9.a-z]*))"))) {
    mpi.version = "Open MPI " + found[1].str();
    mpi.open_mpi = std::stoi(found[2].str());
  } else {
    mpi.version = said.substr(0, said.find('\n'));
  }
  return mpi;
}

}  // namespace

Mpirun find_mpirun() {
  std::string said;
  try {
    said = output_of({"mpirun", "--version"}).text;
  } catch (const std::runtime_error& error) {
    throw std::runtime_error(
        fmt::format("{}: it starts the programs' ranks (Debian: package openmpi-bin) and has to be in PATH",
                    error.what()));
  }
  const Mpirun mpirun = read_version(said);
  const std::string library = mpi_library();
  if (mpirun.open_mpi != read_version(library).open_mpi)
    throw std::runtime_error(fmt::format(
        "the first mpirun in PATH is of {}, but demvof runs with {}: put the folder of the latter's mpirun "
        "first in PATH",
        mpirun.version, library));
  return mpirun;
}

std::string mpi_library() {
  char text[MPI_MAX_LIBRARY_VERSION_STRING] = {};
  int length = 0;
  MPI_Get_library_version(text, &length);
  return read_version(text).version;
}

std::vector<std::string> mpirun_options(const Mpirun& mpirun, double time_out, int time_to_write) {
  if (mpirun.open_mpi == 0) return {};
  // More ranks than cores are allowed (Open MPI then yields the core while it waits), and ranks are not
  // pinned: two runs on one machine would be pinned to the same cores.
  std::vector<std::string> words = {"--oversubscribe", "--bind-to", "none"};
  if (mpirun.open_mpi < 5) {
    const auto set = [&words](const char* name, const std::string& value) {
      words.insert(words.end(), {"--mca", name, value});
    };
    // When a rank ends badly, mpirun waits twice this time, s, before it kills the others.
    set("odls_base_sigkill_timeout", std::to_string(time_to_write / 2));
    // A host that does not answer is lost after half the time that both sides wait for each other, and not
    // before a quarter: mpirun then ends the run, and its other half there what it has started.
    const auto seconds = [time_out](double share) {
      return std::to_string(std::max(1L, static_cast<long>(std::min(1e5, time_out) * share)));
    };
    set("oob_tcp_keepalive_time", seconds(0.25));
    set("oob_tcp_keepalive_intvl", seconds(0.0625));
    set("oob_tcp_keepalive_probes", "4");
    // Containers often forbid to read another process's memory.
    set("btl_vader_single_copy_mechanism", "none");
  }
  return words;
}

}  // namespace demvof
