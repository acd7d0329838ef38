// SPDX-License-Identifier: GPL-3.0-or-later
#include "coupler/cli/versions.hpp"

#include <fmt/format.h>

#include "coupler/cli/mpirun.hpp"
#include "coupler/output/machine.hpp"

namespace demvof {

std::string versions() {
  return fmt::format("demvof {}\nOpenFOAM {}\nLIGGGHTS {}\n{}\nyaml-cpp {}\nVTK {}\n", version(),
                     DEMVOF_OPENFOAM, DEMVOF_LIGGGHTS, mpi_library(), DEMVOF_YAML_CPP, DEMVOF_VTK);
}

}  // namespace demvof
