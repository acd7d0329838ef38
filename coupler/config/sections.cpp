// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>

#include "coupler/config/keys.hpp"

namespace demvof {
namespace {

template <class Access>
Section optional_section(const std::string& path, const std::string& doc, Access at) {
  return {path,
          doc,
          Section::Presence::optional,
          false,
          [at](const CaseParameters& c) { return at(c).has_value(); },
          [at](CaseParameters& c) { at(c).emplace(); }};
}

#define DEMVOF_AT(member) \
  [](auto& c) -> auto& {  \
    return c.member;      \
  }

std::vector<Section> make_sections() {
  using Presence = Section::Presence;
  Section forces{"forces",
                 "Forces between fluid and particles: a list; what a given list does not name is off."};
  forces.is_list = true;
  return {
      {"fluid", "The OpenFOAM side: an ordinary interFoam case.", Presence::required},
      optional_section("fluid.refinement",
                       "Fine cells where they matter: the mesh of the case is refined at the interface, and "
                       "coarsened behind it, while the run goes on.",
                       DEMVOF_AT(fluid.refinement)),
      optional_section("particles", "The LIGGGHTS side; without this section the run is plain VOF.",
                       DEMVOF_AT(particles)),
      optional_section(
          "bulk_grid",
          "The coarse Cartesian grid on which particles and fluid meet, 2-4 particle diameters per "
          "cell; needed with particles.",
          DEMVOF_AT(bulk_grid)),
      optional_section(
          "gravity",
          "Gravity that changes, as in a tank that is shaken: in the run it acts on both sides in place of "
          "constant/g and fix gravity, which have to be there and agree (docs/theory.md).",
          DEMVOF_AT(gravity)),
      {"coupling", "When and how the two sides exchange.", Presence::required},
      optional_section(
          "coupling.window",
          "In place of a number: windows as long as their error allows, each a whole number of DEM "
          "time steps; fields, particles and states are written at their times exactly "
          "(docs/theory.md, Windows of their own lengths).",
          DEMVOF_AT(coupling.adaptive_window)),
      {"coupling.averaging", "How particles are averaged onto the bulk grid."},
      {"coupling.mapping", "How values go between the bulk grid and the fine mesh."},
      forces,
      optional_section("forces.lubrication",
                       "Film of fluid between particles that are near each other, and between particles and "
                       "granular walls (fix wall/gran): resists their normal motion; written lubrication, or "
                       "{lubrication: {roughness: 1e-4}}.",
                       DEMVOF_AT(forces.lubrication)),
      {"scene", "What the run solves: found from the scene (auto) or forced (on, off)."},
      {"output", "What is written, and when."},
      {"limits",
       "What a run may not exceed: beyond, its status is failed. A tenth of each is a warning, and so is the "
       "first lost particle."},
  };
}

#undef DEMVOF_AT

}  // namespace

const std::vector<Section>& case_sections() {
  static const std::vector<Section> sections = make_sections();
  return sections;
}

const Section* find_section(const std::string& path) {
  const auto found = std::find_if(case_sections().begin(), case_sections().end(),
                                  [&path](const Section& section) { return section.path == path; });
  return found == case_sections().end() ? nullptr : &*found;
}

}  // namespace demvof
