// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace demvof {

/// How values go between the bulk grid and the fine mesh (remap.hpp, bulk_interpolation.hpp).
enum class Mapping { nearest, inverse_distance, cell_point, cell_point_face, conservative };

struct MappingParameters {
  Mapping to_fine = Mapping::conservative;
  Mapping to_bulk = Mapping::conservative;
};

}  // namespace demvof
