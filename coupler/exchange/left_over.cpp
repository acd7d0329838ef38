// SPDX-License-Identifier: GPL-3.0-or-later
#include "coupler/exchange/left_over.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
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
  const CellValues<Owed> before = std::exchange(owed_, {});
  const CellValues<Vec3> collected = std::exchange(collected_, {});
  kept_ = {};
  for (const Owed& cell : before.values) kept_ += cell.impulse;
  const auto owe = [this](CellId cell, const Owed& owed) {
    owed_.cells.push_back(cell);
    owed_.values.push_back(owed);
  };
  std::size_t at = 0;
  const auto keep_up_to = [&](CellId cell) {  // concurrent particles have not been asked for these yet
    for (; at < before.cells.size() && before.cells[at] < cell; ++at)
      if (norm(before.values[at].impulse) > 0) owe(before.cells[at], before.values[at]);
  };
  for (std::size_t i = 0; i < collected.cells.size(); ++i) {
    const BulkParticles* here = find(particles, collected.cells[i]);
    if (!here) continue;
    keep_up_to(collected.cells[i]);
    owe(collected.cells[i], {collected.values[i], here->solid_volume});
    if (at < before.cells.size() && before.cells[at] == collected.cells[i])
      owed_.values.back().impulse += before.values[at++].impulse;
  }
  keep_up_to(std::numeric_limits<CellId>::max());
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
  CellValues<Owed> kept;
  std::size_t at = 0;
  for (std::size_t i = 0; i < owed_.cells.size(); ++i) {
    while (at < fluid.cells.size() && fluid.cells[at] < owed_.cells[i]) ++at;
    if (at < fluid.cells.size() && fluid.cells[at] == owed_.cells[i]) {
      fluid.values[at].left_over = owed_.values[i].impulse;
    } else if (norm(owed_.values[i].impulse) > 0) {
      kept.cells.push_back(owed_.cells[i]);
      kept.values.push_back({owed_.values[i].impulse, HUGE_VAL});  // no particle takes a part of it
    }
  }
  owed_ = std::move(kept);
}

}  // namespace demvof
