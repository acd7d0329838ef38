// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "foam_side/openfoam.hpp"

namespace demvof {

struct Flow;

/// What particles do to the balance of a face and its two cells, in one momentum prediction.
///
/// Cell, with A and H of inertia and stress, h = H/A, k = C/A, a = eps/A:
///
///   (1 + k) u = h + k u_ref + F/A - a grad p
///
/// Void fraction, drag and force may jump from one cell to the next, and the pressure then has a kink
/// at the face between them. What does not jump is the flux past the particles, w = eps (u - v).S, v their
/// velocity: each side of the face has u.S = v.S + w/eps. With J_v the flux of a fluid that goes with the
/// particles (solid_motion.cpp; v.S less the solid's own flux),
///
///   phi = J_v + w,   u_f.S = v.S + w/e,   1/e = mean(1/eps)
///
/// so that a fluid that goes with its particles has u = v on both sides of any jump, wherever in the cell
/// the edge of the bed is. Each side obeys its own balance with its own pressure gradient; the mean of both
/// gradients is the one of the face:
///
///   (1/e + kappa) w = mean(h).S - v.S + kappa R + B - a_f grad p.S,   a_f = mean(a)
///
///   kappa = a_f mean(C/eps^2)       R = mean(C (u_ref - v)/eps).S / mean(C/eps^2)
///   B     = a_f mean(F/eps).S
///
/// and what pressure and F do to the cell as seen from its own side of the face is
///
///   (a/a_f) (w/eps - (e/eps) (mean(h) - v).S) + (k/eps) (w - R)
///
/// In a uniform medium this is a (F/eps - grad p).S. The mean of A/eps times that of both sides is what the
/// face has, or momentum would be lost there; where drag outweighs A, how A jumps (a surface, viscosity) does
/// not matter. With one pressure gradient for both sides instead, the free fluid beside a bed is pushed by
/// half the bed's pressure gradient (velocity errors of 125 % at k = 100;
/// tests/verification/foam_flow/porous_plug.cpp).
struct FaceDrag {
  /// A: diagonal of the momentum matrix per volume, without drag, kg/(m3 s); force: F, N/m3.
  FaceDrag(const Flow& flow, const volScalarField& A, const Foam::vectorField& force);

  surfaceScalarField eps_f;       // e, -
  surfaceScalarField response;    // a_f, m3 s/kg
  surfaceScalarField resistance;  // kappa, -
  surfaceScalarField reference;   // R, m3/s
  surfaceScalarField push;        // B, m3/s
  scalarField stiffness;          // k, -

  /// Flux per pressure gradient, a_f/(1/e + kappa), m3 s/kg.
  tmp<surfaceScalarField> mobility() const { return response / (1.0 / eps_f + resistance); }
};

}  // namespace demvof
