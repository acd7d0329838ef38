// SPDX-License-Identifier: GPL-3.0-or-later
#include "coupler/exchange/owed_pressure.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include "coupler/exchange/momentum_exchange.hpp"

namespace demvof {

void OwedPressure::tell(CellValues<BulkFluid>& fluid, const std::vector<double>& relaxation,
                        const CellValues<BulkParticles>& particles, double window) {
  told_ = {};
  for (std::size_t i = 0; i < fluid.cells.size(); ++i) {
    const CellId cell = fluid.cells[i];
    const BulkParticles* here = find(particles, cell);
    if (!here || !(here->solid_volume > 0) || !(fluid.values[i].density > 0)) continue;
    Vec3& gradient = fluid.values[i].pressure_gradient;
    const Vec3 given = -(here->solid_volume * window) * gradient;
    open_[cell] -= given;
    told_ += given;
    const auto owed = owed_.find(cell);
    if (owed == owed_.end()) continue;
    const Vec3 part = 0.5 * relaxation[i] * owed->second.impulse;
    gradient -= part / (here->solid_volume * window);
    owed->second.impulse -= part;
    told_ += part;
  }
}

void OwedPressure::collect(const CellValues<Vec3>& left) {
  for (std::size_t i = 0; i < left.cells.size(); ++i)
    if (norm(left.values[i]) > 0) open_[left.cells[i]] += left.values[i];
}

void OwedPressure::end_window(const CellValues<BulkParticles>& particles) {
  for (const auto& [cell, impulse] : open_) owed_[cell].impulse += impulse;
  open_.clear();
  returned_ = std::exchange(on_its_way_, Vec3{});
  for (auto owed = owed_.begin(); owed != owed_.end();) {
    const BulkParticles* here = find(particles, owed->first);
    owed->second.solid_volume = here ? here->solid_volume : HUGE_VAL;  // no particle takes a part of it
    owed = norm(owed->second.impulse) > 0 ? std::next(owed) : owed_.erase(owed);
  }
}

void OwedPressure::return_to_fluid(CellValues<BulkParticles>& particles) {
  for (auto& [cell, owed] : owed_) {
    const auto place = std::lower_bound(particles.cells.begin(), particles.cells.end(), cell);
    const auto slot = place - particles.cells.begin();
    const bool there = place != particles.cells.end() && *place == cell;
    const double now = there ? particles.values[slot].solid_volume : 0;
    const Vec3 back = (1 - share_for_particles(owed.solid_volume, now)) * owed.impulse;
    if (norm(back) == 0) continue;
    if (!there) {
      particles.cells.insert(place, cell);
      particles.values.insert(particles.values.begin() + slot, BulkParticles{});
    }
    particles.values[slot].drag_impulse -= back;
    owed.impulse -= back;
    on_its_way_ += back;
  }
}

Vec3 OwedPressure::owed_in_all() const {
  Vec3 sum = on_its_way_;
  for (const auto& [cell, owed] : owed_) sum += owed.impulse;
  return sum;
}

CellValues<LeftOver::Owed> OwedPressure::owed() const {
  CellValues<LeftOver::Owed> all;
  for (const auto& [cell, owed] : owed_) {
    all.cells.push_back(cell);
    all.values.push_back(owed);
  }
  return all;
}

void OwedPressure::go_on_from(const CellValues<LeftOver::Owed>& owed, const Vec3& on_its_way) {
  owed_.clear();
  on_its_way_ = on_its_way;
  for (std::size_t i = 0; i < owed.cells.size(); ++i) owed_[owed.cells[i]] = owed.values[i];
}

}  // namespace demvof
