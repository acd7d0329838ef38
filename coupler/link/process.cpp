// SPDX-License-Identifier: GPL-3.0-or-later
#include "coupler/link/process.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <cstring>
#include <fstream>
#include <sstream>

#include "coupler/base/mpi_check.hpp"

namespace demvof {
namespace {

// What travels: the same layout on all ranks.
struct Card {
  int side, rank;
  long pid;
  unsigned long long start;
  char host[64];
};

struct KernelView {
  char state = 'X';
  double cpu_ticks = 0;
  unsigned long long start = 0;
};

// /proc/PID/stat: "pid (name) state ...", CPU time in fields 14 and 15, the start time is field 22. The name
// may hold anything.
KernelView look_up(long pid) {
  std::ifstream file(fmt::format("/proc/{}/stat", pid));
  std::string line;
  if (!std::getline(file, line)) return {};
  std::istringstream fields(line.substr(line.rfind(')') + 1));
  char state = 'X';
  fields >> state;
  std::string skipped;
  for (int field = 4; field < 14; ++field) fields >> skipped;
  double user = 0, system = 0;
  fields >> user >> system;
  for (int field = 16; field < 22; ++field) fields >> skipped;
  KernelView view;
  fields >> view.start;
  view.state = state;
  view.cpu_ticks = user + system;
  return view;
}

std::string host_name() {
  char name[64] = {};
  gethostname(name, sizeof name - 1);
  return name;
}

}  // namespace

const char* side_name(Side side) {
  return side == Side::fluid ? "fluid" : "particles";
}
const char* program_name(Side side) {
  return side == Side::fluid ? "foam_side" : "dem_side";
}

std::string Process::name() const {
  return fmt::format("{} rank {} (process {} on {})", program_name(side), rank, pid, host);
}

Process this_process(Side side, int rank) {
  const long pid = getpid();
  return {side, rank, pid, look_up(pid).start, host_name()};
}

std::vector<Process> all_processes(MPI_Comm comm, const Process& self) {
  Card mine{static_cast<int>(self.side), self.rank, self.pid, self.start, {}};
  std::strncpy(mine.host, self.host.c_str(), sizeof mine.host - 1);
  int size = 0;
  check_mpi(PMPI_Comm_size(comm, &size), "MPI_Comm_size");
  std::vector<Card> cards(size);
  check_mpi(PMPI_Allgather(&mine, sizeof mine, MPI_BYTE, cards.data(), sizeof mine, MPI_BYTE, comm),
            "MPI_Allgather of process cards");
  std::vector<Process> processes;
  for (const Card& card : cards)
    processes.push_back({static_cast<Side>(card.side), card.rank, card.pid, card.start, card.host});
  return processes;
}

Activity activity_of(const Process& process) {
  const KernelView seen = look_up(process.pid);
  if (seen.start != process.start) return {};
  return {seen.state, seen.cpu_ticks / static_cast<double>(sysconf(_SC_CLK_TCK))};
}

bool is_running(const Process& process) {
  const KernelView seen = look_up(process.pid);
  const bool running = seen.state != 'Z' && seen.state != 'X' && seen.state != 'x';
  return running && seen.start == process.start;
}

}  // namespace demvof
