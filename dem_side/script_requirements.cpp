// SPDX-License-Identifier: GPL-3.0-or-later
#include "dem_side/script_requirements.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string_view>

#include "atom.h"
#include "comm.h"
#include "coupler/base/errors.hpp"
#include "coupler/base/mpi_check.hpp"
#include "coupler/base/sphere.hpp"
#include "dem_side/moved_once.hpp"
#include "domain.h"
#include "fix.h"
#include "lammps.h"
#include "modify.h"
#include "update.h"
// clang-format off
#include "multisphere.h"
#include "fix_multisphere.h"
#include "fix_template_multisphere.h"
// clang-format on

namespace demvof {
namespace {

bool starts_with(std::string_view text, std::string_view begin) {
  return text.substr(0, begin.size()) == begin;
}

// What stands in the way of following a fix's particles; empty: nothing.
std::string_view objection(std::string_view style) {
  if (starts_with(style, "rigid") || style == "concave" || style == "multisphere/break")
    return "clumps are coupled as fix multisphere makes them; use that";
  if (starts_with(style, "couple/cfd"))
    return "dem_side exchanges with the fluid itself; remove the line (its forces: 'forces' in the case "
           "file)";
  if (style == "buoyancy")
    return "the pressure gradient of the fluid already lifts the particles; remove the line, or unfix it "
           "before the script ends";
  if (style == "setforce" || style == "planeforce" || style == "lineforce" || style == "aveforce" ||
      style == "enforce2d")
    return "it takes away forces that stand when it acts, and the fluid's come after it: its particles would "
           "be moved by these alone. To hold particles: fix freeze, or fix move; a slice: walls, or one row "
           "of periodic cells";
  if (style == "dt/reset")
    return "a time step that changes is not followed: the particles' time would run away from the fluid's; "
           "give 'timestep' its smallest value, or unfix it before the script ends";
  if (style == "momentum")
    return "it takes momentum from the particles that the fluid has given them; remove the line, or unfix it "
           "before the script ends";
  if (style == "deform" || style == "box/relax" || starts_with(style, "npt") || starts_with(style, "nph") ||
      starts_with(style, "press/"))
    return "it changes the particles' box, and bulk grid and fluid stay as they are; remove the line, or "
           "unfix it before the script ends. Walls that move: fix move/mesh";
  if (style == "multisphere/nointegration")
    return "its clumps do not move by the forces on them; use fix multisphere";
  if (starts_with(style, "nve/") && style != "nve/sphere" && style != "nve/noforce")
    return "its particles do not move by the forces on them alone; use fix nve/sphere";
  return {};
}

bool holds(std::string_view style) {
  return style == "freeze" || style == "move" || style == "nve/noforce";
}

constexpr int all = 1;  // group bit

bool has_sphere_of_clump(int group, const LAMMPS_NS::FixMultisphere& clumps, const LAMMPS_NS::Atom& atom) {
  bool found = group == all;
  for (int i = 0; i < atom.nlocal && !found; ++i) found = (atom.mask[i] & group) && clumps.belongs_to(i) >= 0;
  return found;
}

// The same in a script with clumps.
std::string_view objection_beside_clumps(LAMMPS_NS::Fix& fix, const LAMMPS_NS::FixMultisphere& clumps,
                                         const LAMMPS_NS::Atom& atom) {
  const std::string_view style = fix.style;
  if (holds(style) && (fix.igroup == clumps.igroup || has_sphere_of_clump(fix.groupbit, clumps, atom)))
    return "LIGGGHTS moves clumps as if it were not there; give it a group of spheres that belong to no "
           "clump. "
           "What is to be held: spheres of their own, without fix multisphere";
  if (auto* shape = dynamic_cast<LAMMPS_NS::FixTemplateMultisphere*>(&fix)) {
    bool moved[3];
    shape->fflag(moved);
    if (!moved[0] || !moved[1] || !moved[2])
      return "clumps that forces do not move (fflag off) are not followed; remove fflag. What is to be held: "
             "spheres of their own, by fix freeze and without fix multisphere";
  }
  if ((style == "nve/sphere" || style == "nve") && (fix.igroup == clumps.igroup || fix.groupbit == all))
    return "fix multisphere moves these spheres already; remove the line, or give it a group of the spheres "
           "that belong to no clump";
  if (style == "insert/stream")
    return "clumps on their way out of its face are not followed; use insert/rate/region or insert/pack";
  return {};
}

// A sphere that 'create_atoms' makes is 1 m large until the script gives it a diameter; with such a one in a
// small box LIGGGHTS's set-up writes where it must not.
std::string larger_than_their_box(const LAMMPS_NS::LAMMPS& liggghts) {
  const LAMMPS_NS::Atom& atom = *liggghts.atom;
  const LAMMPS_NS::Domain& box = *liggghts.domain;
  if (!atom.radius_flag || box.nonperiodic == 2) return {};  // a box that shrinks onto centres says nothing
  double sum = 0, largest = 0;
  for (int i = 0; i < atom.nlocal; ++i) {
    sum += sphere_volume(atom.radius[i]);
    largest = std::max(largest, 2 * atom.radius[i]);
  }
  check_mpi(MPI_Allreduce(MPI_IN_PLACE, &sum, 1, MPI_DOUBLE, MPI_SUM, liggghts.world), "MPI_Allreduce");
  check_mpi(MPI_Allreduce(MPI_IN_PLACE, &largest, 1, MPI_DOUBLE, MPI_MAX, liggghts.world), "MPI_Allreduce");
  const double room =
      (box.boxhi[0] - box.boxlo[0]) * (box.boxhi[1] - box.boxlo[1]) * (box.boxhi[2] - box.boxlo[2]);
  if (sum <= room) return {};
  return fmt::format(
      "the particles' volume is {:.4g} m3, that of their box {:.4g} m3; the largest one has a diameter of "
      "{:.6g} m. What create_atoms makes has 1 m until 'set ... diameter ... density ...' says otherwise",
      sum, room, largest);
}

}  // namespace

void require_coupled_scene(LAMMPS_NS::LAMMPS& liggghts, const std::string& script) {
  std::string mistakes;
  const auto mistake = [&](const std::string& text) {
    mistakes += fmt::format("{}{}: {}", mistakes.empty() ? "" : "\n", script, text);
  };

  if (!liggghts.domain->box_exist)
    throw InputError(
        fmt::format("{}: no simulation box; the script needs create_box, read_data or read_restart", script));
  if (std::string_view(liggghts.update->unit_style) != "si")
    mistake(
        fmt::format("units are '{}'; the coupled run is in SI units: units si", liggghts.update->unit_style));
  const LAMMPS_NS::Atom& atom = *liggghts.atom;
  if (!atom.radius_flag || !atom.rmass_flag || atom.superquadric_flag)
    mistake(
        fmt::format("atom_style is '{}'; the particles must be spheres with a radius and a mass: "
                    "atom_style granular",
                    atom.atom_style));
  if (!liggghts.update->timestep_set)
    mistake("no timestep; add e.g. 'timestep 1e-5' (s)");
  else if (!(liggghts.update->dt > 0 && std::isfinite(liggghts.update->dt)))
    mistake(fmt::format("timestep: {:g} is not allowed; give a number above 0 (s)", liggghts.update->dt));
  if (liggghts.domain->triclinic) mistake("the box is skewed (triclinic); it must be rectangular");

  if (const std::string text = larger_than_their_box(liggghts); !text.empty()) mistake(text);

  int integrators = 0, gravities = 0;
  const LAMMPS_NS::FixMultisphere* clumps = nullptr;
  for (int i = 0; i < liggghts.modify->nfix; ++i)
    if (auto* found = dynamic_cast<LAMMPS_NS::FixMultisphere*>(liggghts.modify->fix[i])) clumps = found;
  for (int i = 0; i < liggghts.modify->nfix; ++i) {
    LAMMPS_NS::Fix& fix = *liggghts.modify->fix[i];
    const std::string_view style = fix.style;
    integrators += style == "nve/sphere" || style == "nve" || style == "multisphere";
    gravities += style == "gravity";
    auto reason = objection(style);
    if (clumps && reason.empty()) reason = objection_beside_clumps(fix, *clumps, atom);
    if (!reason.empty()) mistake(fmt::format("fix {} {}: {}", fix.id, style, reason));
  }
  if (clumps && liggghts.comm->nprocs > 1)
    mistake(
        fmt::format("fix {} multisphere: LIGGGHTS follows clumps on one rank only, and loses them on {}: "
                    "particles.ranks: 1 in the case file",
                    clumps->id, liggghts.comm->nprocs));
  for (const std::string& text : not_moved_once(liggghts, clumps)) mistake(text);
  if (integrators == 0) mistake("nothing moves the particles; add 'fix move_them all nve/sphere'");
  if (gravities > 1) mistake(fmt::format("{} fixes of style gravity; there must be at most one", gravities));
  if (!mistakes.empty()) throw InputError(mistakes);
}

}  // namespace demvof
