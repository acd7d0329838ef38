// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Phase interchange `replacement` (paper, section 5.2): on the fine mesh a particle becomes a drop of
// liquid of its volume that moves with its velocity, and later takes its place back.
//
// A fine cell is full of solid, liquid and gas before and after, so that nothing has to flow for it:
//   1. what the particle displaced, a solid fraction psi on the bulk scale, is filled with the fluid that
//      is there:  eps += psi, alpha and u as they are;  liquid gained S = sum alpha psi V
//   2. in a sphere around its centre gas becomes liquid until the liquid has grown by V_p in all:
//      D = V_p - S more. The sphere is the particle's, or as much larger as it takes to find D of gas.
// Taking its place back is the same with the opposite sign: eps -= psi, and V_p - S of the nearest liquid
// becomes gas. So the liquid changes by exactly V_p, the gas by exactly nothing.
//
// Momentum: liquid of step 2 has the velocity that particle and drop come to when they stick together,
// gas takes its own with it; filling and taking out is fluid of the cell's velocity. The sum comes out of the
// particle's momentum, as a left-over of the exchange that its bulk cell owes: in the coming window, shared
// by drag with the others there, if any. What no particle can take (none is there, or the exchange scheme
// hands nothing back) comes from outside and is booked so.

#include <functional>
#include <limits>
#include <vector>

#include "coupler/exchange/crossing.hpp"
#include "foam_side/flow.hpp"

namespace demvof {

/// Fine cells per diameter that a drop needs for its shape.
constexpr double drop_resolution = 4;

/// What replacements did to the fluid; sums over the run.
struct ReplacementBooks {
  long became_liquid = 0, took_place_back = 0;  // particles
  double liquid_in = 0, liquid_out = 0;         // m3
  double worst_volume_error = 0;                // |change of liquid - V_p| / V_p of one particle, -
  Vec3 impulse;                                 // momentum that came with it, N s
  Vec3 from_outside;                            // what of it no particle gave, N s
  double worst_impulse_error = 0;               // against the change of the fluid's momentum, -
  double worst_resolution = std::numeric_limits<double>::infinity();  // cells per diameter of a drop
  double liquid() const { return liquid_in - liquid_out; }
};

/// Carries out what dem_side decided for the coming window; before the window's void fraction and sources.
/// solid_fraction_of: what one particle displaces, per fine cell. owe: takes an impulse (N s) that the fluid
/// got at a place from the particles there; false when none can give it. Collective.
/// Throws RunError when a particle becomes liquid where the mesh has fewer than 2 cells per diameter.
void replace_particles(
    Flow& flow, const std::vector<Droplet>& droplets,
    const std::function<scalarField(const Vec3& position, double volume)>& solid_fraction_of,
    const std::function<bool(const Vec3& position, const Vec3& impulse)>& owe, ReplacementBooks& books);

/// Throws InputError when the mesh has nowhere 2 cells per diameter of the smallest particle (m).
void require_mesh_resolves_particles(const Foam::fvMesh& mesh, double diameter);

}  // namespace demvof
