// SPDX-License-Identifier: GPL-3.0-or-later
#include "coupler/exchange/left_over.hpp"

#include <algorithm>
#include <utility>

#include "coupler/exchange/momentum_exchange.hpp"

namespace demvof {

void LeftOver::collect(const CellValues<Vec3>& impulse, const CellValues<BulkParticles>& particles) {
  if (collected_.cells.empty()) collected_ = {particles.cells, std::vector<Vec3>(particles.cells.size())};
  std::size_t slot = 0;
  for (std::size_t i = 0; i < impulse.cells.size(); ++i) {
    while (slot < collected_.cells.size() && collected_.cells[slot] < impulse.cells[i]) ++slot;
    if (slot == collected_.cells.size()) return;
    if (collected_.cells[slot] == impulse.cells[i]) collected_.values[slot] += impulse.values[i];
  }
}

void LeftOver::end_window(const CellValues<BulkParticles>& particles) {
  owed_ = {};
  const CellValues<Vec3> collected = std::exchange(collected_, {});
  for (std::size_t i = 0; i < collected.cells.size(); ++i) {
    const BulkParticles* here = find(particles, collected.cells[i]);
    if (!here) continue;
    owed_.cells.push_back(collected.cells[i]);
    owed_.values.push_back({collected.values[i], here->solid_volume});
  }
}

void LeftOver::return_to_fluid(CellValues<BulkParticles>& particles) {
  for (std::size_t i = 0; i < owed_.cells.size(); ++i) {
    const CellId cell = owed_.cells[i];
    Owed& owed = owed_.values[i];
    const auto place = std::lower_bound(particles.cells.begin(), particles.cells.end(), cell);
    const auto slot = place - particles.cells.begin();
    const bool there = place != particles.cells.end() && *place == cell;
    const double now = there ? particles.values[slot].solid_volume : 0;
    const Vec3 returned = (1 - share_for_particles(owed.solid_volume, now)) * owed.impulse;
    if (norm(returned) == 0) continue;
    if (!there) {
      particles.cells.insert(place, cell);
      particles.values.insert(particles.values.begin() + slot, BulkParticles{});
    }
    particles.values[slot].drag_impulse -= returned;
    owed.impulse -= returned;
  }
}

void LeftOver::hand_over(CellValues<BulkFluid>& fluid) {
  for (std::size_t i = 0; i < fluid.cells.size(); ++i)
    if (const Owed* owed = find(owed_, fluid.cells[i])) fluid.values[i].left_over = owed->impulse;
  owed_ = {};
}

}  // namespace demvof
