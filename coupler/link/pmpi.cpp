// SPDX-License-Identifier: GPL-3.0-or-later
// The MPI profiling interface: a program may define MPI_X itself and reach the library's own as
// PMPI_X. LIGGGHTS and OpenFOAM begin and end MPI as if they were alone; here they are told apart
// from the pair.
#include "coupler/link/pmpi.hpp"

#include <exception>
#include <string>

#include "coupler/base/errors.hpp"

namespace demvof {
namespace {

MPI_Comm own_world = MPI_COMM_NULL;
bool announced = false;
void (*sudden_end)(const char*) = nullptr;

bool in_pair() {
  return own_world != MPI_COMM_NULL;
}

// LIGGGHTS: Error::all calls MPI_Finalize, Error::one MPI_Abort. OpenFOAM: UPstream::exit and abort.
void solver_ends(const std::string& call) {
  const std::string why = "a solver library ended the program (" + call + ")";
  if (std::uncaught_exceptions() > 0 && sudden_end) sudden_end(why.c_str());
  throw SolverStopped(why);
}

}  // namespace

void substitute_world(MPI_Comm world) {
  own_world = world;
}

MPI_Comm own(MPI_Comm named) {
  return named == MPI_COMM_WORLD && in_pair() ? own_world : named;
}

void announce_end() {
  announced = true;
}
bool end_announced() {
  return announced;
}
void on_sudden_end(void (*handler)(const char*)) {
  sudden_end = handler;
}

}  // namespace demvof

extern "C" {

int MPI_Init(int* argc, char*** argv) {
  return demvof::in_pair() ? MPI_SUCCESS : PMPI_Init(argc, argv);
}

int MPI_Init_thread(int* argc, char*** argv, int required, int* provided) {
  return demvof::in_pair() ? PMPI_Query_thread(provided) : PMPI_Init_thread(argc, argv, required, provided);
}

int MPI_Finalize() {
  if (!demvof::in_pair()) return PMPI_Finalize();
  if (!demvof::announced) demvof::solver_ends("MPI_Finalize");
  return MPI_SUCCESS;
}

int MPI_Abort(MPI_Comm comm, int code) {
  if (demvof::in_pair() && !demvof::announced) demvof::solver_ends("MPI_Abort, code " + std::to_string(code));
  // The real world: no side survives the other.
  return PMPI_Abort(demvof::in_pair() ? MPI_COMM_WORLD : comm, code);
}
}
