// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Particles that hang on springs which the drag outruns. The exchange counts a particle in contact as held by
// something that does not give way. Where over a window (dt)
//
//   k_t dt < 2 n beta    and    A = n beta dt (1 - eps)/(rho eps V) > 0.6
//
// it goes with the fluid instead, the fluid hears of the spring too late, and both slide to and fro with more
// and more energy: for the linear map of a particle on a spring, docs/stability.md. This counts them; nothing
// is done about it.

#include "dem_side/contact_stiffness.hpp"
#include "dem_side/forces.hpp"

namespace demvof {

/// Least A at which the map grows, -.
constexpr double stiff_in_a_window = 0.6;

struct SoftContacts {
  double touching = 0;        // particles that forces move, in contact for half of the window and longer
  double soft = 0;            // of these, those that hang so
  double holding_window = 0;  // the longest 2 n beta/k_t among them, s
  double rate = 0;            // the largest A/dt among them, 1/s
};

/// Of the window that was last simulated, on this rank.
SoftContacts count_soft_contacts(const Dem& dem, const FluidForces& forces,
                                 const ContactStiffness& stiffness);

}  // namespace demvof
