// SPDX-License-Identifier: GPL-3.0-or-later
// foam_side: two fluids on a fine mesh, coupled with particles over the bulk grid (docs/protocol.md).

#include "coupler/config/program_options.hpp"
#include "coupler/link/main_guard.hpp"
#include "foam_side/run.hpp"

int main(int argc, char** argv) {
  using namespace demvof;
  const ProgramOptions options = read_program_options(
      "foam_side", "Two-fluid (VOF) side of a DEM-VOF pair; alone, a plain VOF solver.", argc, argv);
  OwnWorld world(argc, argv, Side::fluid, start_limit_seconds(options), options.out);
  return guarded_main(world, [&] { return run_fluid(options, world); });
}
