// SPDX-License-Identifier: GPL-3.0-or-later
#include "coupler/transfer/averaging_in_fluid.hpp"

#include <algorithm>
#include <cassert>
#include <utility>

#include "coupler/base/mpi_check.hpp"
#include "coupler/base/sphere.hpp"

namespace demvof {
namespace {

// What one bulk cell offers to a particle's mean; zero where there is no fluid.
struct CellSample {
  double fluid = 0;  // 1 with fluid
  Vec3 velocity, pressure_gradient;
  double density = 0, viscosity = 0, void_fraction = 0;
  Vec3 left_over_rate;  // M / sum of w beta, m
};

struct GradientSample {
  double fluid = 0;  // 1 with fluid
  BulkFluidGradients gradients;
};

}  // namespace

AveragingInFluid::AveragingInFluid(MPI_Comm world, const BulkGrid& grid, const BulkPartition& partition,
                                   const AveragingParameters& parameters)
    : world_(world),
      grid_(grid),
      partition_(partition),
      maximum_solid_fraction_(parameters.maximum_solid_fraction) {
  if (parameters.kernel == Kernel::diffusion)
    diffusion_.emplace(world_, grid_, partition_, parameters.bandwidth);
}

void AveragingInFluid::set_shares(CellValues<double> share) {
  share_ = std::move(share);
  int partial = share_.cells.empty() ? 0 : 1;
  check_mpi(MPI_Allreduce(MPI_IN_PLACE, &partial, 1, MPI_INT, MPI_MAX, world_), "MPI_Allreduce");
  const bool was_everywhere = std::exchange(everywhere_, partial == 0);
  if (diffusion_ && !(was_everywhere && everywhere_)) diffusion_->set_open_shares(share_);
}

void AveragingInFluid::set_walls(const CellValues<BulkWalls>& walls) {
  walls_ = walls;
  if (diffusion_) diffusion_->set_walls(walls);
}

void AveragingInFluid::weigh(const KernelWeights& weights, const TouchedCells& touched,
                             const std::vector<char>& outside, const double* radii) {
  touched_ = &touched;
  relocation_ = {};
  relief_ = {};
  outside_ = outside.data();
  radii_ = radii;
  if (everywhere_)
    weights_.set(weights);
  else
    weights_.set(weights, touched.fetch_from_owners(share_, 1.0));
}

/// A sphere's drag knows of its neighbours by the void fraction around it, in which its own volume does not
/// count. In a suspension the room that it keeps free of others makes up for that: eight times its volume.
/// The diffusion kernel's weights are spread over so many cells afterwards that nothing of it is left.
double AveragingInFluid::around(int particle, double void_fraction) const {
  const double room = std::max(0.0, 1 - 8 * (1 - void_fraction));
  if (diffusion_ || room == 0) return std::min(1.0, void_fraction);
  const double own = weights_.squares(particle) * sphere_volume(radii_[particle]) / grid_.cell_volume();
  return std::min(1.0, void_fraction + own * room);
}

void AveragingInFluid::find_relocation() {
  LimitedSolid limited =
      limit_solid(world_, grid_, partition_, maximum_solid_fraction_, share_, deposited_, walls_);
  relief_ = limited.relief;
  relocation_ = std::move(limited.relocation);
}

std::function<FluidAtParticle(int)> AveragingInFluid::sample(
    const CellValues<BulkFluid>& owned, const CellValues<BulkFluidGradients>* gradients) {
  CellValues<CellSample> offered{owned.cells, std::vector<CellSample>(owned.cells.size())};
  unplaced_left_over_ = {};
  for (std::size_t i = 0; i < owned.cells.size(); ++i) {
    const BulkFluid& fluid = owned.values[i];
    CellSample& sample = offered.values[i];
    if (fluid.density > 0)
      sample = {
          1, fluid.velocity, fluid.pressure_gradient, fluid.density, fluid.viscosity, fluid.void_fraction,
          {}};

    const BulkParticles* particles = find(deposited_, owned.cells[i]);
    const double drag_factor = particles ? particles->drag_factor : 0;
    if (drag_factor > 0)
      sample.left_over_rate = fluid.left_over / drag_factor;
    else
      unplaced_left_over_ += fluid.left_over;
  }
  CellValues<GradientSample> steepness;
  if (gradients) {
    assert(gradients->cells == owned.cells);
    steepness = {owned.cells, std::vector<GradientSample>(owned.cells.size())};
    for (std::size_t i = 0; i < owned.cells.size(); ++i)
      if (owned.values[i].density > 0) steepness.values[i] = {1, gradients->values[i]};
  }
  using Slopes = FluidWeights::Samples<GradientSample>;
  return [this, means = weights_.samples(fetch(std::move(offered))),
          slopes = gradients ? std::optional<Slopes>(weights_.samples(fetch(std::move(steepness))))
                             : std::nullopt](int particle) mutable {
    FluidAtParticle here;
    if (outside_[particle]) return here;
    const CellSample& mean = means(particle);
    here.left_over_rate = mean.left_over_rate;
    if (!(mean.fluid > 0)) return here;
    here.velocity = mean.velocity / mean.fluid;
    here.pressure_gradient = mean.pressure_gradient / mean.fluid;
    here.density = mean.density / mean.fluid;
    here.viscosity = mean.viscosity / mean.fluid;
    here.void_fraction = around(particle, mean.void_fraction / mean.fluid);
    if (!slopes) return here;
    const GradientSample& slope = (*slopes)(particle);
    const BulkFluidGradients& sum = slope.gradients;
    here.gradients = {sum.stress_force / slope.fluid, sum.acceleration / slope.fluid,
                      sum.vorticity / slope.fluid};
    return here;
  };
}

}  // namespace demvof
