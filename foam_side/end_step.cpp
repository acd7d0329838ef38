// SPDX-License-Identifier: GPL-3.0-or-later
// After the last correction of a step: total pressure, impulse of the implicit particle force, books, bounds.

#include <algorithm>

#include "foam_side/extras.hpp"
#include "foam_side/flow.hpp"
#include "foam_side/fluid_books.hpp"

namespace demvof {

void update_total_pressure(Flow& flow) {
  flow.p == flow.p_rgh + flow.rho* flow.gh;
  if (!flow.p_rgh.needReference()) return;
  flow.p += dimensionedScalar("shift", flow.p.dimensions(),
                              flow.p_reference - Foam::getRefCellValue(flow.p, flow.p_reference_cell));
  flow.p_rgh = flow.p - flow.rho * flow.gh;
}

namespace {

/// The last correction gave u = (H + ...)/A with C in A and C u_ref in H: what the fluid received is
/// C (u_ref - u) with this very u.
void accumulate_impulse(const Flow& flow, ParticleSource& source) {
  const scalar dt = flow.time.deltaTValue();
  forAll(source.implicit_impulse, cell) source.implicit_impulse[cell] +=
      dt * source.coefficient[cell] * (source.reference[cell] - flow.U[cell]);
}

void watch_bounds(Flow& flow) {
  const double low = Foam::gMin(flow.alpha.primitiveField());
  const double high = Foam::gMax(flow.alpha.primitiveField());
  flow.alpha_excess = std::max({flow.alpha_excess, -low, high - 1});
  Foam::Info << flow.alpha.name() << " in [" << low << ", " << high << "]" << Foam::endl;
}

}  // namespace

void end_step(Flow& flow) {
  update_total_pressure(flow);
  if (flow.source) accumulate_impulse(flow, *flow.source);
  if (flow.source && !flow.pressure_system.viscous) {
    note_boundary_stress(flow);
    note_sources(flow);
  }
  keep_books(flow);
  watch_bounds(flow);
  if (!flow.clock.windowed) flow.time.write();
}

}  // namespace demvof
