// SPDX-License-Identifier: GPL-3.0-or-later
#include "dem_side/random_streams.hpp"

#include <algorithm>

#include "domain.h"
#include "fix_insert.h"
#include "fix_insert_stream.h"
#include "fix_particledistribution_discrete.h"
#include "fix_template_sphere.h"
#include "lammps.h"
#include "modify.h"
#include "random_park.h"
#include "region.h"
#include "tri_mesh.h"

namespace demvof {
namespace {

using LAMMPS_NS::RanPark;

// The generators are protected members of their owners.
struct OfInsertion : LAMMPS_NS::FixInsert {
  static RanPark* in(FixInsert& fix) { return fix.*&OfInsertion::random; }
};
struct OfDistribution : LAMMPS_NS::FixParticledistributionDiscrete {
  static RanPark* in(FixParticledistributionDiscrete& fix) { return fix.*&OfDistribution::random; }
};
struct OfTemplate : LAMMPS_NS::FixTemplateSphere {
  static RanPark* insertion(FixTemplateSphere& fix) { return fix.*&OfTemplate::random_insertion; }
  static RanPark* size(FixTemplateSphere& fix) { return fix.*&OfTemplate::random_mc; }
};
struct OfRegion : LAMMPS_NS::Region {
  static RanPark* in(Region& region) { return region.*&OfRegion::random; }
};
struct OfMesh : LAMMPS_NS::TriMesh {
  static RanPark* in(TriMesh& mesh) { return mesh.*&OfMesh::random_; }
};

template <class Function>
void for_each_stream(const LAMMPS_NS::LAMMPS& liggghts, Function&& function) {
  const auto take = [&](const std::string& name, RanPark* stream) {
    if (stream) function(name, *stream);
  };
  for (int i = 0; i < liggghts.modify->nfix; ++i) {
    LAMMPS_NS::Fix* fix = liggghts.modify->fix[i];
    const std::string name = std::string("fix ") + fix->id;
    if (auto* found = dynamic_cast<LAMMPS_NS::FixInsert*>(fix)) take(name, OfInsertion::in(*found));
    if (auto* found = dynamic_cast<LAMMPS_NS::FixInsertStream*>(fix))
      if (found->face()) take(name + " face", OfMesh::in(*found->face()));
    if (auto* found = dynamic_cast<LAMMPS_NS::FixParticledistributionDiscrete*>(fix))
      take(name, OfDistribution::in(*found));
    if (auto* found = dynamic_cast<LAMMPS_NS::FixTemplateSphere*>(fix)) {
      take(name, OfTemplate::insertion(*found));
      take(name + " size", OfTemplate::size(*found));
    }
  }
  for (int i = 0; i < liggghts.domain->nregion; ++i) {
    LAMMPS_NS::Region* region = liggghts.domain->regions[i];
    take(std::string("region ") + region->id, OfRegion::in(*region));
  }
}

}  // namespace

RandomStates random_states(LAMMPS_NS::LAMMPS& liggghts) {
  RandomStates now;
  now.states.emplace_back();
  for_each_stream(liggghts, [&](const std::string& name, RanPark& stream) {
    now.names.push_back(name);
    now.states[0].push_back(stream.state());
    stream.reset(stream.state());
  });
  return now;
}

void set_random_states(LAMMPS_NS::LAMMPS& liggghts, const RandomStates& saved, int rank, int ranks) {
  if (saved.states.empty()) return;
  const bool as_before = static_cast<std::size_t>(ranks) == saved.states.size();
  for_each_stream(liggghts, [&](const std::string& name, RanPark& stream) {
    const auto found = std::find(saved.names.begin(), saved.names.end(), name);
    if (found == saved.names.end()) return;
    const auto at = static_cast<std::size_t>(found - saved.names.begin());
    const bool alike = std::all_of(saved.states.begin(), saved.states.end(),
                                   [&](const auto& row) { return row[at] == saved.states[0][at]; });
    if (as_before || alike) stream.reset(saved.states[as_before ? static_cast<std::size_t>(rank) : 0][at]);
  });
}

}  // namespace demvof
