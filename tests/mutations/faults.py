# SPDX-License-Identifier: GPL-3.0-or-later
"""Faults that the tests have to notice: (file, text, text with the fault, tests).

The text stands exactly once in the file, which `plant.py --check` sees to. Tests are default ones, and short."""

# Tests by what they look at, each with the targets that it needs.
CLOSURES = {f"^unit_{name}$": [f"unit_{name}"] for name in ("drag", "closures", "own_wake", "implicit_drag")}
EXCHANGE = {f"^unit_{name}$": [f"unit_{name}"] for name in ("exchange_stability", "added_mass_exchange", "relaxation",
                                                            "ledger", "books", "crossing")}
AVERAGING = {"^averaging_kernels$": ["averaging_kernels_test"], "^limit_solid_test.2$": ["limit_solid_test"],
             "^unit_kernel_weights$": ["unit_kernel_weights"]}
MAPPING = {"^unit_mesh_cut$": ["unit_mesh_cut"], "^remap_test.2$": ["remap_test"], "^mapping_test": ["mapping_test"]}
FORCES = {r"^mock_dem_forces\..*\.1$": ["mock_dem_forces"], "^mock_dem_settling.1$": ["dem_side", "mock_fluid"]}
START = {r"^mock_dem_start\..*\.1$": ["mock_dem_start"]}
SETTLING = {"^pair.batch_settling$": ["foam_side", "dem_side", "demvof", "demvof_pair"]}
DROP = {"^pair.replacement$": ["foam_side", "dem_side", "demvof", "demvof_pair"]}
PAIR = ["foam_side", "dem_side", "demvof", "demvof_pair"]
SHEAR, COMING, CARRIED, STREWN = ({f"^pair.{name}$": PAIR} for name in
                                  ("suspension_viscosity", "coming_and_going", "carried", "extremes"))
FLOW = {"^foam_flow.(MovingPorosity|Displacement)$": ["foam_flow_test"]}
HALF = {"^pair.half_submerged$": PAIR}
FALLING = {"^pair.terminal_velocity.short$": PAIR}
HISTORY = {r"^mock_dem_history\..*\.1$": ["mock_dem_history"]}
OSCILLATING = {"^pair.oscillating_flow$": PAIR}
OWN_WINDOWS = {"^unit_window_rule$": ["unit_window_rule"], "^unit_seen_fluid$": ["unit_seen_fluid"],
               "^unit_output_due$": ["unit_output_due"]}
OWED = {"^unit_owed_pressure$": ["unit_owed_pressure"], "^unit_seen_fluid$": ["unit_seen_fluid"]}
ORDER = {"^unit_seen_fluid$": ["unit_seen_fluid"], "^unit_continuation$": ["unit_continuation"]}
BED = {"^mock_foam_bed$": ["foam_side", "mock_particles", "demvof"]}

FAULTS = [
    # ---- closures
    ("coupler/closures/drag.hpp", "1 + 0.15 * std::pow(inertia / viscosity, 0.687)",
     "1 + 0.15 * std::pow(inertia / viscosity, 0.678)", CLOSURES),
    ("coupler/closures/drag.hpp", "return pi / 8 * 0.44 * inertia * diameter;",
     "return pi / 4 * 0.44 * inertia * diameter;", CLOSURES),
    ("coupler/closures/drag.hpp", "(150 * (1 - eps) + 1.75 * reynolds) / (18 * eps * eps)",
     "(150 * (1 - eps) + 1.75 * reynolds) / (18 * eps)", CLOSURES),
    ("coupler/closures/drag.hpp", "0.63 * std::sqrt(reynolds) + 4.8", "0.63 * std::sqrt(reynolds) - 4.8", CLOSURES),
    ("coupler/closures/drag.hpp", "3.7 - 0.65 * voidage_dip(reynolds)",
     "3.7 + 0.65 * voidage_dip(reynolds)", CLOSURES),
    ("coupler/closures/drag.hpp", "(slow + inertial * reynolds / 2)", "(slow + inertial * reynolds)", CLOSURES),
    ("coupler/closures/drag.hpp", "square * (1 + 1.5 * std::sqrt(phi))", "square * (1 + 1.5 * phi)", CLOSURES),
    ("coupler/closures/drag.hpp", "2.65 * (eps + 1)", "2.65 * (eps - 1)", CLOSURES),
    ("coupler/closures/lift.hpp", "cross(slip, vorticity)", "cross(vorticity, slip)", CLOSURES),
    ("coupler/closures/lift.hpp", "return (1 - root) * decay + root;", "return (1 - root) * decay;", CLOSURES),
    ("coupler/closures/own_wake.hpp", "return beta * stokes * mobility / width;",
     "return beta * stokes * mobility;", CLOSURES),
    ("dem_side/implicit_drag.hpp", "(phi - 1) * other", "(1 - phi) * other", CLOSURES),
    ("dem_side/implicit_drag.hpp", "(1 - contact_fraction) * free", "contact_fraction * free", CLOSURES),
    # ---- exchange
    ("coupler/exchange/momentum_exchange.hpp", "particles.response_weighted_velocity / particles.drag_response",
     "particles.response_weighted_velocity / particles.drag_factor", {**EXCHANGE, **BED}),
    ("coupler/exchange/momentum_exchange.hpp", "? solid_volume_now / solid_volume_then : 1.0",
     "? solid_volume_then / solid_volume_now : 1.0", {**EXCHANGE, **BED}),
    ("coupler/exchange/relaxation.hpp", "4 * std::max(solid - following, 0.0)",
     "0 * std::max(solid - following, 0.0)", EXCHANGE),
    ("coupler/exchange/relaxation.hpp", "? (1 + gain) / 1.2 :", "? (1 + gain) / 2.4 :", EXCHANGE),
    ("coupler/exchange/relaxation.hpp", "(2 + h * q) / (2 + q)", "(2 + q) / (2 + q)", EXCHANGE),
    ("coupler/exchange/relaxation.hpp", "3 * h * (1 - h)", "0", EXCHANGE),
    ("coupler/exchange/books.hpp", "volume_before_ = balance.particle_volume;", "", EXCHANGE),
    ("coupler/exchange/relaxation.hpp", "density * particles.pressure_mobility / fluid_volume",
     "density * particles.pressure_mobility", EXCHANGE),
    ("coupler/exchange/crossing.hpp", "closing > least_speed && distance <=",
     "closing > least_speed || distance <=", EXCHANGE),
    ("coupler/exchange/ledger.hpp", "window.drag_to_particles + window.left_over_to_particles + to_fluid",
     "window.drag_to_particles + to_fluid", EXCHANGE),
    ("coupler/exchange/books.hpp", "balance.pending = unplaced_ - fluid.implicit_impulse + fluid.kept_left_over",
     "balance.pending = unplaced_ - fluid.implicit_impulse", EXCHANGE),
    ("coupler/exchange/books.hpp", "outside.held = -particles.held_impulse",
     "outside.held = particles.held_impulse", EXCHANGE),
    ("coupler/exchange/support.hpp", "counts_as_held * norm(cell.contact) / asked",
     "counts_as_held * asked / norm(cell.contact)", FORCES),
    ("coupler/exchange/seen_fluid.cpp", "reference += free_share(cell) *",
     "reference -= free_share(cell) *", {**OWED, **SHEAR}),
    ("coupler/exchange/owed_pressure.cpp", "not_theirs = moved * step / exposed * impulse;",
     "not_theirs = {};", OWED),
    ("coupler/exchange/owed_pressure.cpp", "gradient -= part / (here->solid_volume * window);",
     "gradient += part / (here->solid_volume * window);", OWED),
    ("coupler/exchange/owed_pressure.cpp", "owed.impulse -= back;", "", OWED),
    ("coupler/exchange/owed_pressure.cpp", "size > most)", "size > 1e9 * most)", OWED),
    ("dem_side/forces.cpp", "row.waited += step;", "row.waited += 0 * step;", COMING),
    ("coupler/exchange/owed_pressure.cpp", "0.5 * pace * relaxation[i]", "0.5 / pace * relaxation[i]", OWED),
    ("coupler/exchange/seen_fluid.cpp", "ratio_ == 1 ? simulated : over_window(simulated, ratio_)", "simulated", OWN_WINDOWS),
    ("coupler/exchange/seen_fluid.cpp", "0.5 * ratio_ * weight", "0.5 * weight", ORDER),
    ("coupler/exchange/seen_fluid.cpp", "now.velocity - before->fluid_velocity", "now.velocity - before->velocity", ORDER),
    ("coupler/exchange/seen_fluid.cpp", "told.tellings > 2", "told.tellings > 1", ORDER),
    ("coupler/exchange/continuation.hpp", "2 - 8 * reaction", "2.0 + 0 * reaction", ORDER),
    ("coupler/exchange/window_rule.hpp", "const double response = response_times(theta) * theta;",
     "const double response = response_times(theta);", OWN_WINDOWS),
    ("coupler/exchange/window_rule.hpp", "particles.following_response *= kept * follow;",
     "particles.following_response *= kept;", OWN_WINDOWS),
    ("coupler/exchange/window_rule.hpp", "if (error > 1)", "if (error > 10)", OWN_WINDOWS),
    ("coupler/exchange/window_rule.hpp", "(distance + parts - 1) / parts", "distance / parts", OWN_WINDOWS),
    ("coupler/link/output_due.hpp", "(outputs_until(static_cast<double>(after) * step, interval) + 1) * interval",
     "(static_cast<double>(after) * step / interval + 1) * interval", OWN_WINDOWS),
    # ---- transfer
    ("coupler/transfer/axis_kernel.cpp", "add(first, 1.0 - upper_share);", "add(first, upper_share);", AVERAGING),
    ("coupler/transfer/axis_kernel.cpp", "m < count_ ? m : period - 1 - m", "m < count_ ? m : period - m", AVERAGING),
    ("coupler/transfer/axis_kernel.cpp", "add(index, (above - below) / (2 * end));",
     "add(index, (above - below) / 2);", AVERAGING),
    ("coupler/transfer/kernel_weights.cpp", "x.share[a] * (y.share[b] * z.share[c])",
     "x.share[a] * (y.share[c] * z.share[b])", AVERAGING),
    ("coupler/transfer/fluid_weights.hpp", "to[m] += weight * from[m];", "to[m] += weight * weight * from[m];", AVERAGING),
    ("coupler/transfer/fluid_weights.hpp", "factor * share * all_->weight[entry]", "factor * all_->weight[entry]", AVERAGING),
    ("dem_side/carried_fluid.hpp", "(exponent - 1) * (s / slip - 1)", "exponent * (s / slip - 1)", FALLING),
    ("coupler/transfer/kernel_weights.cpp", "weights.weight[entry] *= share[weights.slot[entry]] / sum",
     "weights.weight[entry] *= share[weights.slot[entry]]", {**AVERAGING, **MAPPING}),
    ("coupler/transfer/diffusion.cpp", "beyond_ = -1 / std::expm1(periodic ? log_row : 2 * log_row)",
     "beyond_ = -1 / std::expm1(log_row)", AVERAGING),
    ("coupler/transfer/diffusion.cpp", "0.25 * std::pow(bandwidth / grid.spacing()[axis], 2)",
     "0.5 * std::pow(bandwidth / grid.spacing()[axis], 2)", AVERAGING),
    ("coupler/transfer/averaging_in_fluid.cpp", "sample.left_over_rate = fluid.left_over / drag_factor",
     "sample.left_over_rate = fluid.left_over", AVERAGING),
    ("coupler/transfer/averaging_in_fluid.cpp", "mean.pressure_gradient / mean.fluid",
     "mean.velocity / mean.fluid", AVERAGING),
    ("coupler/transfer/limit_solid.cpp", "limit[open_share.cells[i] - around->cells().front()] *= open_share.values[i]",
     "limit[open_share.cells[i] - around->cells().front()] *= 1", AVERAGING),
    ("coupler/transfer/limit_solid.cpp", "|| limit[c] == 0) continue;", ") continue;", AVERAGING),
    ("coupler/transfer/limit_solid.cpp", "slot >= 0 && beside_place[slot].open > 0", "slot >= 0", AVERAGING),
    ("dem_side/history_force.cpp", "(share - before) / step_ * slip", "(before - share) / step_ * slip", HISTORY),
    ("coupler/transfer/relocation.hpp", "add(value, gift.share, beside[around_->beside()[gift.cell][face]]);",
     "add(value, 0 * gift.share, beside[around_->beside()[gift.cell][face]]);", AVERAGING),
    ("coupler/transfer/averaging_in_fluid.hpp", "if (!relocation_.empty()) owned = relocation_.gather(owned);",
     "", AVERAGING),
    ("coupler/transfer/averaging_in_fluid.hpp", "return relocation_.empty() ? owned : relocation_.spread(owned);",
     "return owned;", AVERAGING),
    ("foam_side/fluid_books.cpp", "Foam::cmptMultiply(momentum.internalCoeffs()[patch],",
     "1.001 * Foam::cmptMultiply(momentum.internalCoeffs()[patch],", OSCILLATING),
    ("coupler/transfer/limited_slopes.cpp", "if (excess > 1) slope *=", "if (excess > 2) slope *=", MAPPING),
    ("coupler/transfer/limited_slopes.cpp", "const double weight = 1 / dot(d, d) / determinant;",
     "const double weight = 1 / determinant;", MAPPING),
    ("coupler/transfer/tetrahedron.cpp", "part.add(a[1], a[2], b[0], b[1]);",
     "part.add(a[1], a[2], b[0], b[2]);", MAPPING),
    ("coupler/transfer/tetrahedron.cpp", "(plane - a[axis]) / (b[axis] - a[axis])",
     "(plane - b[axis]) / (b[axis] - a[axis])", MAPPING),
    # ---- forces on the particles
    ("dem_side/begin_window.cpp", "fluid.pressure_force = -volume * here.pressure_gradient",
     "fluid.pressure_force = volume * here.pressure_gradient", FORCES),
    ("dem_side/begin_window.cpp", "fluid.left_over_force = beta / window * here.left_over_rate",
     "fluid.left_over_force = beta * here.left_over_rate", FORCES),
    ("dem_side/forces.cpp", "sums.pressure += share * fluid.pressure_force;",
     "sums.pressure += fluid.pressure_force;", HALF),
    ("dem_side/forces.cpp", "gradients.other_impulse += step * (other + part.overdue);", "", FORCES),
    ("dem_side/forces.cpp", "store(external[i], given + steady + constant);",
     "store(external[i], given + steady);", FORCES),
    ("dem_side/forces.cpp", "if (half_step_ && !moves) {", "if (half_step_ && moves && !moves) {", START),
    ("dem_side/deposit_rows.cpp", "std::exchange(row.fluid[k].drag_impulse, {})", "Vec3{}", STREWN),
    ("dem_side/deposit_rows.cpp", "here.following_response = (1 - theta) *", "here.following_response = theta *", SHEAR),
    # ---- between fine mesh and bulk grid
    ("foam_side/particles_to_fine.cpp", "reference += shape(i) - sum.shape / sum.own;",
     "reference += sum.shape / sum.own - shape(i);", SHEAR),
    ("foam_side/particles_to_fine.cpp", "rise[i + 1 + axis] - rise[i] * rows[cell + 1 + axis]",
     "rise[i] * rows[cell + 1 + axis] - rise[i + 1 + axis]", SHEAR),
    ("foam_side/solid_motion.cpp", "2 * std::max(one, other) * along_face", "1000 * std::max(one, other) * along_face",
     COMING),
    ("foam_side/solid_motion.cpp", "- solid_flux + flux_that_makes_room(flow, solid_flux)",
     "- solid_flux + 0 * flux_that_makes_room(flow, solid_flux)", COMING),
    ("foam_side/solid_motion.cpp", "flow.porosity->rate.field() - moved().primitiveField()", "flow.porosity->rate.field()", CARRIED),
    ("foam_side/solid_fraction.cpp", "(rise[i] - here)", "0", COMING),
    ("foam_side/solid_fraction.cpp", "middle[slot] / most", "0", COMING),
    ("foam_side/solid_motion.cpp", "return porosity.along + (flux - porosity.carried)",
     "return porosity.along + (flux + porosity.carried)", CARRIED),
    ("foam_side/run.cpp", "return end + (end - before);", "return end + 0 * (end - before);", SETTLING),
    ("foam_side/run.cpp", "flow.porosity->goal.field() = goal;", "", DROP),
    ("foam_side/bridge.cpp", "left_over_[k].collect({{cell}, {-impulse}}, particles);",
     "left_over_[k].collect({{cell}, {impulse}}, particles);", DROP),
    ("foam_side/end_step.cpp", "dt * source.coefficient[cell] * (source.reference[cell] - flow.U[cell])",
     "dt * source.coefficient[cell] * (flow.U[cell] - source.reference[cell])", {**BED, **HALF}),
    ("foam_side/fluid_books.cpp", "inflow -= flux", "inflow += flux", BED),
    ("foam_side/porosity.cpp", "(eps - porosity.goal.field()) / (flow.clock",
     "(eps - porosity.eps.primitiveField()) / (flow.clock", FLOW),
    ("foam_side/face_drag.cpp", "drag /= Foam::sqr(eps);", "drag /= eps;", BED),
]
