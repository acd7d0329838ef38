// SPDX-License-Identifier: GPL-3.0-or-later
#include "foam_side/numbers_of_case.hpp"

#include <algorithm>
#include <cmath>

#include "coupler/scene/plan_windows.hpp"
#include "foam_side/step_limits.hpp"

namespace demvof {

ResolvedNumbers resolved_numbers(const CaseParameters& parameters, const Flow& flow, double surface_tension,
                                 const std::optional<BulkGrid>& grid, const nlohmann::json& particles) {
  ResolvedNumbers numbers;
  numbers.fluid_time_step = flow.time.deltaTValue();
  numbers.fine_cells = Foam::returnReduce(flow.mesh.nCells(), Foam::sumOp<label>());
  if (particles.is_null()) return numbers;
  numbers.dem_time_step = particles.at("time_step");
  if (const auto& adaptive = parameters.coupling.adaptive_window) {
    const StepRange range = step_range(*adaptive, numbers.dem_time_step);
    numbers.window = static_cast<double>(range.shortest) * numbers.dem_time_step;
    numbers.longest_window = static_cast<double>(range.longest) * numbers.dem_time_step;
  } else {
    numbers.window = parameters.coupling.window;
    numbers.windows = std::lround((parameters.coupling.end_time - flow.time.value()) / numbers.window);
  }
  numbers.dem_steps = std::lround(numbers.window / numbers.dem_time_step);
  numbers.fluid_steps =
      std::max(1L, static_cast<long>(std::ceil(numbers.window / numbers.fluid_time_step - 1e-9)));
  numbers.fluid_time_step = numbers.window / static_cast<double>(numbers.fluid_steps);
  numbers.bulk_cells = static_cast<long>(grid->cell_count());
  numbers.bulk_spacing = std::min({grid->spacing().x, grid->spacing().y, grid->spacing().z});
  numbers.particles = particles.at("particle_count");
  const StepLimits limits(flow.time.controlDict());
  const double rate = limits.room(courant_rates(flow));
  if (limits.adjust && rate < 1e-3 / Foam::SMALL) numbers.courant_step = rate;
  if (limits.adjust && limits.step < Foam::GREAT) numbers.longest_step = limits.step;
  if (flow.scene.surface_tension) numbers.capillary_step = capillary_step(flow, surface_tension);
  numbers.collision_time = particles.at("collision_time");
  numbers.rayleigh_time = particles.at("rayleigh_time");
  if (const double viscosity = Foam::gMax(dynamic_viscosity(flow)()); viscosity > 0)
    numbers.drag_time = particles.at("lightest_response").get<double>() / viscosity;
  numbers.min_diameter = particles.at("min_diameter");
  numbers.max_diameter = particles.at("max_diameter");
  return numbers;
}

}  // namespace demvof
