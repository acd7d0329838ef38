// SPDX-License-Identifier: GPL-3.0-or-later
// dem_side: particles by LIGGGHTS, coupled with a fluid over the bulk grid (docs/protocol.md).

#include "coupler/config/program_options.hpp"
#include "coupler/link/main_guard.hpp"
#include "dem_side/run.hpp"

int main(int argc, char** argv) {
  using namespace demvof;
  const ProgramOptions options =
      read_program_options("dem_side", "Particle (DEM) side of a DEM-VOF pair.", argc, argv);
  OwnWorld world(argc, argv, Side::particles, start_limit_seconds(options), options.out);
  return guarded_main(world, [&] { return run_particles(options, world); });
}
