// SPDX-License-Identifier: GPL-3.0-or-later
#include "dem_side/size_mix.hpp"

namespace demvof {
namespace {

// Sums over particles with their weights: m3, m2, m4.
struct SizeSums {
  double volume = 0, surface = 0, volume_times_diameter = 0;
};

}  // namespace

std::vector<SizeMix> sizes_around(const ParticleArrays& particles, const FluidForces& forces, int k,
                                  AveragingInFluid& averaging) {
  auto around = averaging.sample_records(averaging.deposit_records<SizeSums>([&](int i) {
    const double volume = forces.carried(i).share(k) * particles.volume(i);
    const double diameter = particles.drag_diameter(i);
    return SizeSums{volume, volume / diameter, volume * diameter};
  }));
  std::vector<SizeMix> sizes(particles.count);
  for (int i = 0; i < particles.count; ++i) {
    const SizeSums sums = around(i);
    if (!(sums.surface > 0)) continue;
    const double sauter = sums.volume / sums.surface;
    sizes[i] = {sauter, sums.volume_times_diameter / sums.volume / sauter};
  }
  return sizes;
}

}  // namespace demvof
