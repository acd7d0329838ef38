// SPDX-License-Identifier: GPL-3.0-or-later
// In front of the MPI library (LD_PRELOAD), counts what a program sends on communicators whose name begins
// with "demvof"; solvers' own are left out. At its end each process writes
//   {"program": ..., "tallies": {COMMUNICATOR: {FUNCTION: {"calls": n, "bytes": n, "receivers": [...]}}}}
// into the folder DEMVOF_MESSAGE_COUNTS. bytes, receivers (ranks in the communicator): of messages to one
// rank, none for collectives.
#include <dlfcn.h>
#include <mpi.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <fstream>
#include <map>
#include <set>
#include <string>
#include <utility>

namespace {

struct Tally {
  long calls = 0, bytes = 0;
  std::set<int> receivers;
};

class Tallies {
 public:
  Tally& of(MPI_Comm comm, const char* function) { return tallies_[name_of(comm)][function]; }
  ~Tallies() {
    const char* folder = std::getenv("DEMVOF_MESSAGE_COUNTS");
    if (!folder || tallies_.empty()) return;
    std::ofstream file(std::string(folder) + "/" + std::to_string(getpid()) + ".json");
    file << "{\"program\": \"" << program_invocation_short_name << "\", \"tallies\": {";
    const char* next = "";
    for (const auto& [comm, functions] : tallies_) {
      if (comm.rfind("demvof", 0) != 0) continue;
      file << next << "\"" << comm << "\": {";
      next = ", ";
      const char* following = "";
      for (const auto& [function, tally] : functions) {
        file << following << "\"" << function << "\": {\"calls\": " << tally.calls
             << ", \"bytes\": " << tally.bytes << ", \"receivers\": [";
        following = ", ";
        const char* comma = "";
        for (const int rank : tally.receivers) file << std::exchange(comma, ", ") << rank;
        file << "]}";
      }
      file << "}";
    }
    file << "}}\n";
  }

 private:
  static std::string name_of(MPI_Comm comm) {
    char name[MPI_MAX_OBJECT_NAME] = "";
    int length = 0;
    PMPI_Comm_get_name(comm, name, &length);
    return {name, static_cast<std::size_t>(length)};
  }
  std::map<std::string, std::map<std::string, Tally>> tallies_;
};

Tallies& tallies() {
  static Tallies all;
  return all;
}

void sends(const char* function, int count, MPI_Datatype type, int to, MPI_Comm comm) {
  int size = 0;
  PMPI_Type_size(type, &size);
  Tally& tally = tallies().of(comm, function);
  ++tally.calls;
  tally.bytes += static_cast<long>(count) * size;
  tally.receivers.insert(to);
}

template <class Function>
Function next(const char* name) {
  return reinterpret_cast<Function>(dlsym(RTLD_NEXT, name));
}

template <class... Arguments>
int pass(const char* name, Arguments... arguments) {
  return next<int (*)(Arguments...)>(name)(arguments...);
}

template <class... Arguments>
int collective(const char* name, MPI_Comm comm, Arguments... arguments) {
  ++tallies().of(comm, name + 1).calls;  // without the P
  return pass(name, arguments...);
}

}  // namespace

// The programs define MPI_X themselves, and call PMPI_X.
extern "C" {

int PMPI_Isend(const void* data, int count, MPI_Datatype type, int to, int tag, MPI_Comm comm,
               MPI_Request* request) {
  sends("MPI_Isend", count, type, to, comm);
  return pass("PMPI_Isend", data, count, type, to, tag, comm, request);
}
int PMPI_Issend(const void* data, int count, MPI_Datatype type, int to, int tag, MPI_Comm comm,
                MPI_Request* request) {
  sends("MPI_Issend", count, type, to, comm);
  return pass("PMPI_Issend", data, count, type, to, tag, comm, request);
}
int PMPI_Send(const void* data, int count, MPI_Datatype type, int to, int tag, MPI_Comm comm) {
  sends("MPI_Send", count, type, to, comm);
  return pass("PMPI_Send", data, count, type, to, tag, comm);
}
int PMPI_Ibarrier(MPI_Comm comm, MPI_Request* request) {
  return collective("PMPI_Ibarrier", comm, comm, request);
}
int PMPI_Ibcast(void* data, int count, MPI_Datatype type, int root, MPI_Comm comm, MPI_Request* request) {
  return collective("PMPI_Ibcast", comm, data, count, type, root, comm, request);
}
int PMPI_Bcast(void* data, int count, MPI_Datatype type, int root, MPI_Comm comm) {
  return collective("PMPI_Bcast", comm, data, count, type, root, comm);
}
int PMPI_Iallreduce(const void* out, void* in, int count, MPI_Datatype type, MPI_Op op, MPI_Comm comm,
                    MPI_Request* request) {
  return collective("PMPI_Iallreduce", comm, out, in, count, type, op, comm, request);
}
int PMPI_Allreduce(const void* out, void* in, int count, MPI_Datatype type, MPI_Op op, MPI_Comm comm) {
  return collective("PMPI_Allreduce", comm, out, in, count, type, op, comm);
}
int PMPI_Reduce(const void* out, void* in, int count, MPI_Datatype type, MPI_Op op, int root, MPI_Comm comm) {
  return collective("PMPI_Reduce", comm, out, in, count, type, op, root, comm);
}
int PMPI_Gather(const void* out, int out_count, MPI_Datatype out_type, void* in, int in_count,
                MPI_Datatype in_type, int root, MPI_Comm comm) {
  return collective("PMPI_Gather", comm, out, out_count, out_type, in, in_count, in_type, root, comm);
}
int PMPI_Gatherv(const void* out, int out_count, MPI_Datatype out_type, void* in, const int* in_counts,
                 const int* in_starts, MPI_Datatype in_type, int root, MPI_Comm comm) {
  return collective("PMPI_Gatherv", comm, out, out_count, out_type, in, in_counts, in_starts, in_type, root,
                    comm);
}
int PMPI_Allgather(const void* out, int out_count, MPI_Datatype out_type, void* in, int in_count,
                   MPI_Datatype in_type, MPI_Comm comm) {
  return collective("PMPI_Allgather", comm, out, out_count, out_type, in, in_count, in_type, comm);
}
int PMPI_Alltoall(const void* out, int out_count, MPI_Datatype out_type, void* in, int in_count,
                  MPI_Datatype in_type, MPI_Comm comm) {
  return collective("PMPI_Alltoall", comm, out, out_count, out_type, in, in_count, in_type, comm);
}
int PMPI_Alltoallv(const void* out, const int* out_counts, const int* out_starts, MPI_Datatype out_type,
                   void* in, const int* in_counts, const int* in_starts, MPI_Datatype in_type,
                   MPI_Comm comm) {
  return collective("PMPI_Alltoallv", comm, out, out_counts, out_starts, out_type, in, in_counts, in_starts,
                    in_type, comm);
}
}
