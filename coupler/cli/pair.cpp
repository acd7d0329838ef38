// SPDX-License-Identifier: GPL-3.0-or-later
// demvof_pair: what mpirun starts on every rank of a pair; it looks at its rank and becomes the program of
// that side. mpirun's own way to start two programs (`mpirun -np 1 a : -np 1 b`) is not to be relied on: that
// of Open MPI 5.0 as packaged by Debian 13 and by Ubuntu 25.04 to 26.04 crashes (open-mpi/ompi issue 13303),
// and srun has another one.
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <string>
#include <vector>

#include "coupler/base/place_in_job.hpp"

namespace {

namespace fs = std::filesystem;

const char* const usage =
    "usage: mpirun -np A+B demvof_pair -np A PROGRAM [ARGUMENT...] + -np B PROGRAM [ARGUMENT...]\n"
    "   or  srun -n A+B demvof_pair ...\n"
    "The first A ranks become the first program, the next B the second. (A `:` would be mpirun's own.)\n"
    "A program without a folder is looked for beside demvof_pair first, then in PATH.\n";

/// One of the programs, and on how many ranks.
struct Part {
  int ranks = 0;
  std::vector<char*> words;  // program and arguments
};

/// Ends the process; all ranks find the same fault, one of them says so.
[[noreturn]] void refuse(const std::string& what) {
  if (demvof::rank_in_job().value_or(0) == 0)
    std::fprintf(stderr, "demvof_pair: %s\n%s", what.c_str(), usage);
  std::exit(2);
}

std::vector<Part> read_parts(int argc, char** argv) {
  std::vector<Part> parts;
  for (int i = 1; i < argc;) {
    if (std::strcmp(argv[i], "-np") != 0 && std::strcmp(argv[i], "-n") != 0)
      refuse(std::string("-np is missing before '") + argv[i] + "'");
    Part part;
    char* end = nullptr;
    const long ranks = i + 1 < argc ? std::strtol(argv[i + 1], &end, 10) : 0;
    if (ranks < 1 || ranks > 1 << 24 || *end)
      refuse(std::string("-np wants a number of ranks, not '") + (i + 1 < argc ? argv[i + 1] : "") + "'");
    part.ranks = static_cast<int>(ranks);
    for (i += 2; i < argc && std::strcmp(argv[i], "+") != 0; ++i) part.words.push_back(argv[i]);
    if (part.words.empty()) refuse("-np without a program");
    part.words.push_back(nullptr);
    parts.push_back(part);
    if (i < argc && ++i == argc) refuse("nothing after the '+'");
  }
  if (parts.empty()) refuse("no program");
  return parts;
}

std::string location(const char* program) {
  if (std::strchr(program, '/')) return program;
  std::error_code none;
  const fs::path beside = fs::read_symlink("/proc/self/exe", none).parent_path() / program;
  return fs::exists(beside, none) ? beside.string() : program;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc == 2 && (std::strcmp(argv[1], "--help") == 0 || std::strcmp(argv[1], "-h") == 0)) {
    std::fputs(usage, stdout);
    return 0;
  }
  const std::vector<Part> parts = read_parts(argc, argv);
  const auto rank = demvof::rank_in_job();
  if (!rank) refuse("started alone; it takes its place in a job of mpirun or srun");
  int all = 0;
  for (const Part& part : parts) all += part.ranks;
  const int ranks = demvof::ranks_of_job().value_or(all);
  if (ranks != all || *rank >= all)
    refuse("the programs want " + std::to_string(all) + " ranks, the job has " + std::to_string(ranks));

  int first = 0;
  for (const Part& part : parts) {
    first += part.ranks;
    if (*rank >= first) continue;
    execvp(location(part.words[0]).c_str(), part.words.data());
    std::fprintf(stderr, "demvof_pair: rank %d cannot start %s: %s\n", *rank, part.words[0],
                 std::strerror(errno));
    return 3;
  }
}
