// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <string_view>

// The quantities that a run can record in history.csv (case file: output.history). foam_side
// computes them; liquid is the fluid of alpha = 1, gas that of alpha = 0, eps the void fraction,
// integrals run over the fine mesh. Formulas: docs/outputs.md.

namespace demvof {

struct Quantity {
  std::string_view name;
  std::string_view unit;
  std::string_view meaning;
};

inline constexpr std::array known_quantities = {
    Quantity{"kinetic_energy", "J", "of the fluids: integral of eps rho u.u / 2"},
    Quantity{"potential_energy", "J",
             "of the fluids: minus integral of eps rho g.x, lowest corner of the mesh at 0"},
    Quantity{"kinetic_energy_ratio", "-", "kinetic_energy over potential_energy at the start"},
    Quantity{"velocity_squared_integral", "m5/s2", "integral of eps u.u"},
    Quantity{"velocity_squared_integral_x", "m5/s2", "integral of eps u_x^2"},
    Quantity{"velocity_squared_integral_liquid", "m5/s2", "integral of eps alpha u.u"},
    Quantity{"velocity_squared_integral_gas", "m5/s2", "integral of eps (1 - alpha) u.u"},
    Quantity{"pressure_squared_integral", "Pa2 m3", "integral of p^2"},
    Quantity{"solid_volume_mesh", "m3", "integral of 1 - eps"},
    Quantity{"liquid_volume", "m3", "integral of eps alpha"},
    Quantity{"liquid_in_interface_cells", "m3", "integral of eps alpha over cells with 0.01 < alpha < 0.99"},
    Quantity{"liquid_front", "m", "largest x of the alpha = 0.5 surface"},
    Quantity{"solid_front", "m", "largest x that a particle's surface reaches"},
    Quantity{"mean_level", "m",
             "liquid and particle volume below the surface over the floor area, along minus gravity"},
    Quantity{"max_speed", "m/s", "largest fluid speed in a cell"},
    Quantity{"max_speed_x", "m", "where that cell is, x"},
    Quantity{"max_speed_y", "m", "where that cell is, y"},
    Quantity{"max_speed_z", "m", "where that cell is, z"},
    Quantity{"particle_kinetic_energy", "J", "sum of m v.v / 2 (translation)"},
    Quantity{"particle_potential_energy", "J", "sum of -m g.x, lowest corner of the mesh at 0"},
    Quantity{"mechanical_energy", "J", "kinetic and potential energy of fluids and particles"},
    Quantity{"fluid_momentum_x", "kg m/s", "integral of eps rho u, x"},
    Quantity{"fluid_momentum_y", "kg m/s", "its y component"},
    Quantity{"fluid_momentum_z", "kg m/s", "its z component"},
    Quantity{"particle_momentum_x", "kg m/s",
             "sum of m v + dt f/2, DEM half steps; without held particles, x"},
    Quantity{"particle_momentum_y", "kg m/s", "its y component"},
    Quantity{"particle_momentum_z", "kg m/s", "its z component"},
    Quantity{"pending_momentum_x", "kg m/s", "received by one side, still owed to the other, x"},
    Quantity{"pending_momentum_y", "kg m/s", "its y component"},
    Quantity{"pending_momentum_z", "kg m/s", "its z component"},
    Quantity{"particles", "-", "number of particles in the run"},
    Quantity{"window", "s", "length of the last window, where windows have their own lengths"},
    Quantity{"window_error", "-", "its error over what is allowed"},
    Quantity{"active_bulk_cells", "-", "bulk cells that were averaged and exchanged in the last window"},
    Quantity{"smallest_relaxation", "-", "smallest relaxation factor of what particles were told in it"},
    Quantity{"fine_cells", "-", "cells of the fluid's mesh, where fluid.refinement changes it"},
};

/// The table's entry, or nullptr when there is no quantity of that name.
constexpr const Quantity* find_quantity(std::string_view name) {
  for (const Quantity& quantity : known_quantities)
    if (quantity.name == name) return &quantity;
  return nullptr;
}

}  // namespace demvof
