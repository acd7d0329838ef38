// SPDX-License-Identifier: GPL-3.0-or-later
// Who moves a sphere. One that no fix moves would hang in the fluid and take impulse from it for ever, as a
// frozen one does; with a velocity of its own it would drag the fluid along from where it stays. Where that
// is meant, 'fix freeze' says so, and costs a line: so it is refused, beside clumps and without.

#include "dem_side/moved_once.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <climits>
#include <string_view>

#include "atom.h"
#include "coupler/base/mpi_check.hpp"
#include "fix.h"
#include "lammps.h"
#include "modify.h"
#include "update.h"
// clang-format off
#include "multisphere.h"
#include "fix_multisphere.h"
// clang-format on

namespace demvof {
namespace {

constexpr int group_all = 1;  // bit

struct Mover {
  const LAMMPS_NS::Fix* fix;
  bool integrates;  // by the forces
};

std::vector<Mover> movers(const LAMMPS_NS::LAMMPS& liggghts) {
  std::vector<Mover> found;
  for (int i = 0; i < liggghts.modify->nfix; ++i) {
    const LAMMPS_NS::Fix& fix = *liggghts.modify->fix[i];
    const std::string_view style = fix.style;
    const bool integrates = style == "nve/sphere" || style == "nve";
    if (integrates || style == "move" || style == "nve/noforce") found.push_back({&fix, integrates});
  }
  return found;
}

int frozen_bits(const LAMMPS_NS::LAMMPS& liggghts) {
  int bits = 0;
  for (int i = 0; i < liggghts.modify->nfix; ++i)
    if (std::string_view(liggghts.modify->fix[i]->style) == "freeze")
      bits |= liggghts.modify->fix[i]->groupbit;
  return bits;
}

/// Spheres to which something applies, over all ranks.
struct Found {
  int count = 0, first = INT_MAX;  // id
  void add(int id) {
    ++count;
    first = std::min(first, id);
  }
  void over(MPI_Comm world) {
    check_mpi(MPI_Allreduce(MPI_IN_PLACE, &count, 1, MPI_INT, MPI_SUM, world), "MPI_Allreduce");
    check_mpi(MPI_Allreduce(MPI_IN_PLACE, &first, 1, MPI_INT, MPI_MIN, world), "MPI_Allreduce");
  }
  std::string ids() const { return fmt::format("(id {}{})", first, count > 1 ? " and others" : ""); }
};

std::string nothing_moves(const Found& found, bool clumps) {
  const bool one = found.count == 1;
  return fmt::format(
      "nothing moves {}{} {}{}. Add 'fix move_them GROUP nve/sphere' with a group of them; to hold them, "
      "'fix hold GROUP freeze'",
      one ? "a sphere" : fmt::format("{} spheres", found.count),
      !clumps ? ""
      : one   ? " that belongs to no clump"
              : " that belong to no clump",
      found.ids(), clumps ? ": fix multisphere moves clumps alone" : ", which would hang in the fluid");
}

std::string twice(const Mover& a, const Mover& b) {
  return fmt::format("fix {} {} and fix {} {} both move", a.fix->id, a.fix->style, b.fix->id, b.fix->style);
}

constexpr const char* leave_one =
    "would be moved twice in a step. Leave one of the two out, or give them groups without a common sphere";

}  // namespace

std::vector<std::string> not_moved_once(LAMMPS_NS::LAMMPS& liggghts,
                                        const LAMMPS_NS::FixMultisphere* clumps) {
  const std::vector<Mover> all = movers(liggghts);
  const bool integrated =
      clumps || std::any_of(all.begin(), all.end(), [](const Mover& m) { return m.integrates; });
  if (!integrated) return {};  // which is said elsewhere
  int known = frozen_bits(liggghts);
  for (const Mover& mover : all) known |= mover.fix->groupbit;

  const LAMMPS_NS::Atom& atom = *liggghts.atom;
  std::vector<std::string> mistakes;
  Found unmoved;
  for (int i = 0; i < atom.nlocal; ++i)
    if (!(atom.mask[i] & known) && !(clumps && clumps->belongs_to(i) >= 0)) unmoved.add(atom.tag[i]);
  unmoved.over(liggghts.world);
  if (unmoved.count > 0) mistakes.push_back(nothing_moves(unmoved, clumps != nullptr));

  // What an insertion puts in belongs to all and to the insertion's own group.
  std::vector<const LAMMPS_NS::Fix*> insertions;
  for (int i = 0; i < liggghts.modify->nfix; ++i) {
    const LAMMPS_NS::Fix* fix = liggghts.modify->fix[i];
    if (!clumps && std::string_view(fix->style).substr(0, 7) == "insert/" &&
        fix->next_reneighbor > liggghts.update->ntimestep)
      insertions.push_back(fix);
  }
  for (const LAMMPS_NS::Fix* insertion : insertions)
    if (!((group_all | insertion->groupbit) & known))
      mistakes.push_back(fmt::format(
          "nothing moves the spheres that fix {} {} puts in: they belong to the groups all and {}. Give fix "
          "nve/sphere one of these",
          insertion->id, insertion->style, insertion->igroup == 0 ? "no other" : "that of the fix"));

  for (std::size_t a = 0; a < all.size(); ++a)
    for (std::size_t b = a + 1; b < all.size(); ++b) {
      const auto both = [&](int mask) {
        return (mask & all[a].fix->groupbit) && (mask & all[b].fix->groupbit);
      };
      Found moved;
      for (int i = 0; i < atom.nlocal; ++i)
        if (both(atom.mask[i])) moved.add(atom.tag[i]);
      moved.over(liggghts.world);
      if (moved.count > 0)
        mistakes.push_back(fmt::format("{} {} {}, which {}", twice(all[a], all[b]),
                                       moved.count == 1 ? "a sphere" : fmt::format("{} spheres", moved.count),
                                       moved.ids(), leave_one));
      for (const LAMMPS_NS::Fix* insertion : insertions)
        if (moved.count == 0 && both(group_all | insertion->groupbit))
          mistakes.push_back(fmt::format("{} what fix {} {} puts in, which {}", twice(all[a], all[b]),
                                         insertion->id, insertion->style, leave_one));
    }
  return mistakes;
}

}  // namespace demvof
