// SPDX-License-Identifier: GPL-3.0-or-later
#include "foam_side/run_warnings.hpp"

#include <fmt/format.h>

#include "coupler/config/quantities.hpp"
#include "foam_side/fine_mesh.hpp"
#include "foam_side/replacement.hpp"
#include "foam_side/unsettled_corrections.hpp"

namespace demvof {

std::vector<std::string> run_warnings(const Flow& flow, const ActedLimits& limits, double gone_impulse,
                                      const std::vector<RunResults::ClosureUse>& closures) {
  constexpr double unbounded = 1e-8;  // of alpha; what MULES promises
  std::vector<std::string> lines = flow.scene.advice;
  if (flow.alpha_excess > unbounded)
    lines.push_back(fmt::format(
        "alpha left [0, 1] by up to {:.2g}: nLimiterIter 10 (MULES's own is 3), more "
        "nAlphaSubCycles or a smaller maxAlphaCo (docs/warnings.md, Liquid fraction out of bounds)",
        flow.alpha_excess));
  if (const UnsettledCorrections open = unsettled_corrections(flow); open.predictions > 0)
    lines.push_back(fmt::format(
        "in {:.0f} momentum predictions of a thick liquid the pressure corrections were given up while they "
        "still changed the velocity by up to {:.2g} of itself: the flow lags behind its forces. What to try: "
        "shorter steps, tighter relTol of U and p_rgh (docs/warnings.md, Unsettled corrections)",
        open.predictions, open.most));
  if (limits.relieved_cells > 0)
    lines.push_back(
        fmt::format("bulk cells above coupling.averaging.maximum_solid_fraction passed {:.3g} m3 to their "
                    "neighbours, {} times (docs/warnings.md, Too much solid in a bulk cell)",
                    limits.relieved_volume, limits.relieved_cells));
  if (limits.unplaced_volume > 0)
    lines.push_back(
        fmt::format("no room on the bulk grid for up to {:.3g} m3 above the maximum solid fraction "
                    "(docs/warnings.md, Too much solid in a bulk cell)",
                    limits.unplaced_volume));
  if (limits.negative_cells > 0)
    lines.push_back(fmt::format(
        "coupling.mapping.to_fine interpolated a solid fraction below 0, {} times: it was taken as "
        "0, and conservation.solid_volume has the error (docs/warnings.md, Negative solid fraction)",
        limits.negative_cells));
  if (limits.full_cells > 0)
    lines.push_back(fmt::format(
        "fine cells kept a void fraction of 0.05 though particles fill more of them, {} times: so much is "
        "not "
        "displaced, and conservation.solid_volume has the error. Try a coarser bulk_grid, a larger "
        "coupling.averaging.width or a smaller coupling.averaging.maximum_solid_fraction (docs/warnings.md, "
        "Full fine cells)",
        limits.full_cells));
  if (limits.held_back.cells > 0)
    lines.push_back(
        fmt::format("bulk cells that hold next to no particles owed them more pressure than ten times the "
                    "steepest there, {} times: up to {:.3g} N s waited for a later window (docs/warnings.md, "
                    "Owed pressure)",
                    limits.held_back.cells, limits.held_back.impulse));
  if (limits.beside.cells > 0)
    lines.push_back(
        fmt::format("the mesh had left bulk cells before their fluid got what is due to it, {} times: up to "
                    "{:.3g} N s in a window went to the fluid beside them. What to try: shorter windows "
                    "(docs/warnings.md, Bulk cells that the mesh leaves)",
                    limits.beside.cells, limits.beside.impulse));
  if (limits.waiting_particles > 0)
    lines.push_back(
        fmt::format("particles felt no fluid {} times: new in a window, or where there is none "
                    "(docs/warnings.md, Particles without fluid)",
                    limits.waiting_particles));
  if (limits.outside_particles > 0)
    lines.push_back(
        fmt::format("particles were outside the fluid's mesh {} times: there they displace nothing and feel "
                    "nothing (docs/warnings.md, Particles outside the fluid)",
                    limits.outside_particles));
  if (limits.soft_windows > 0)
    lines.push_back(
        fmt::format("in {} windows particles hung on springs that the drag outruns: fluid and particles may "
                    "slide to and fro "
                    "with growing energy. What to try: windows of {:.2g} s and longer, of {:.2g} s and "
                    "shorter, or stiffer contacts (docs/warnings.md, Soft contacts)",
                    limits.soft_windows, limits.holding_window, limits.mild_window));
  if (gone_impulse > 0)
    lines.push_back(
        fmt::format("impulse of {:.3g} N s went with particles in the window in which they left "
                    "(docs/warnings.md, Impulse that left)",
                    gone_impulse));
  if (limits.drop_resolution < drop_resolution * (1 - 1e-6))
    lines.push_back(fmt::format(
        "particles became liquid with {:.3g} fine cells per diameter: replacement needs {} for the shape "
        "of the drop, refine the mesh at the interface (docs/warnings.md, Drops on a coarse mesh)",
        limits.drop_resolution, drop_resolution));
  if (limits.crossing_windows > 0)
    lines.push_back(
        fmt::format("there were particles at the interface in {} windows, against "
                    "coupling.phase_interchange: none (docs/warnings.md, Particles at the surface)",
                    limits.crossing_windows));
  if (limits.unplaced_left_over > 0)
    lines.push_back(
        fmt::format("left-over impulse of {:.3g} N s found no particle to receive it (docs/warnings.md, "
                    "Left-over without receiver)",
                    limits.unplaced_left_over));
  for (const auto& [name, evaluations, outside] : closures)
    if (outside > 0)
      lines.push_back(
          fmt::format("{} was evaluated outside the range it was fitted for in {} of {} cases ({:.3g} %) "
                      "(docs/warnings.md, Range of a law)",
                      name, outside, evaluations, 100.0 * outside / evaluations));
  return lines;
}

}  // namespace demvof
