// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "coupler/config/parameters.hpp"

namespace demvof {

/// What the programs found in a scene before the first step.
struct SceneFacts {
  double surface_tension = 0;         // largest coefficient in the fluid case, N/m
  bool two_fluids = true;             // both fluids present at the start or at an inlet
  bool mesh_moves = false;            // the fluid's mesh: its points, that is
  bool turbulent = false;             // a turbulence model other than laminar
  bool particles = false;             // a particle script is given
  long particle_count = 0;            // at the start
  bool inserts_particles = false;     // the script adds particles during the run
  double largest_solid_fraction = 0;  // on the bulk grid at the start, -
  double liquid_density = 0;          // of the first phase, kg/m3; 0: there is none of it
  double gas_density = 0;             // of the second
  double lightest_particle = 0;       // density at the start, kg/m3; 0 without particles
  double dem_time_step = 0;           // s
  double collision_time = 0;          // shortest in a linear spring, s; 0: not known
  double rayleigh_time = 0;           // of the particle with the shortest, s; 0: not known
  std::vector<std::string> advice;    // what was seen on the way; empty texts are none
};

struct Decision {
  std::string decision;  // e.g. "surface tension"
  bool on = false;
  std::string reason;  // one sentence that names the fact or the forcing key
};

/// What a run has switched on, and why.
struct Scene {
  bool particles = false;
  bool surface_tension = false;
  bool two_fluids = false;  // liquid and gas are told apart where the surface cuts a bulk cell
  bool interface_advection = true;
  bool porosity = false;
  PhaseInterchange interchange = PhaseInterchange::none;  // how particles cross the interface
  bool turbulence = false;
  bool mesh_moves = false;  // the particles hear in each window what the mesh leaves of the bulk grid
  SuspensionViscosity suspension_viscosity = SuspensionViscosity::none;
  std::vector<Decision> decisions;
  std::vector<std::string> advice;  // what the facts speak against, a sentence each; nothing is changed by it
};

/// Pure: the plan from the facts and what the case file forces.
/// Throws InputError, one line per key, when the case file forces what the scene cannot have.
Scene plan_scene(const SceneParameters& forced, const SceneFacts& facts, const ForceParameters& forces = {},
                 PhaseInterchange interchange = PhaseInterchange::porous);

/// The decisions as a table for people, one line each: "on   surface tension   reason".
std::string scene_table(const std::vector<Decision>& decisions);

}  // namespace demvof
