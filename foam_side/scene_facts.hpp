// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "coupler/scene/scene.hpp"
#include "foam_side/openfoam.hpp"

namespace demvof {

/// What an interFoam case says about its scene, read from its dictionaries alone, before any mesh or
/// field exists. Collective over the fluid side. Throws Foam::error on a case that cannot be read.
SceneFacts fluid_facts(const Foam::argList& args);

/// The case's clock and controlDict, alone.
const Foam::Time& case_time(const Foam::argList& args);

/// Gravity of the case, m/s2.
Vec3 case_gravity(const Foam::argList& args);
/// What to say when the run does not begin with that; empty when it does. start: of a new run, s.
std::string gravity_that_jumps(const Vec3& of_case, const GravityTable& gravity, double start);

}  // namespace demvof
