// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// LIGGGHTS's granular walls. Their header wants the lists of contact models, which are made when LIGGGHTS is
// built and are not installed; of them its templates name what stands for none, with the values below.
// Nothing here depends on a model.

#define CONTACT_MODEL_CONSTANTS_H_
namespace LIGGGHTS {
namespace ContactModels {
constexpr int NORMAL_OFF = 9, TANGENTIAL_OFF = 0, COHESION_OFF = 0, ROLLING_OFF = 0;
}  // namespace ContactModels
}  // namespace LIGGGHTS

#include "fix_mesh_surface.h"
#include "fix_neighlist_mesh.h"
#include "fix_wall_gran.h"
#include "primitive_wall.h"
