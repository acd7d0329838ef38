// SPDX-License-Identifier: GPL-3.0-or-later
#include "coupler/transfer/averaging.hpp"

#include <algorithm>
#include <cassert>
#include <utility>

#include "coupler/base/errors.hpp"
#include "coupler/base/mpi_check.hpp"

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

bool beyond_a_wall(const BulkGrid& grid, const Vec3& position) {
  for (int axis = 0; axis < 3; ++axis)
    if (!grid.periodic()[axis] &&
        !(position[axis] >= grid.lower()[axis] && position[axis] <= grid.upper()[axis]))
      return true;
  return false;
}

template <class T>
const double* rows(const std::vector<T>& values) {
  return reinterpret_cast<const double*>(values.data());
}
template <class T>
double* rows(std::vector<T>& values) {
  return reinterpret_cast<double*>(values.data());
}

}  // namespace

AveragingParameters with_bandwidth(AveragingParameters parameters, double largest_diameter) {
  if (parameters.kernel != Kernel::diffusion || parameters.bandwidth > 0) return parameters;
  if (largest_diameter <= 0)
    throw InputError(
        "coupling.averaging.bandwidth: 0 stands for six of the largest particle diameters at the start, but "
        "there "
        "are no particles then; give a length in m");
  parameters.bandwidth = 6 * largest_diameter;
  return parameters;
}

Averaging::Averaging(MPI_Comm world, const BulkGrid& grid, const BulkPartition& partition,
                     const AveragingParameters& parameters)
    : world_(world), grid_(grid), partition_(partition), parameters_(parameters) {
  if (parameters_.kernel == Kernel::diffusion)
    diffusion_.emplace(world_, grid_, partition_, parameters_.bandwidth);
}

void Averaging::set_open_shares(CellValues<double> open_share) {
  open_share_ = std::move(open_share);
  int partial = open_share_.cells.empty() ? 0 : 1;
  check_mpi(MPI_Allreduce(MPI_IN_PLACE, &partial, 1, MPI_INT, MPI_MAX, world_), "MPI_Allreduce");
  all_open_ = partial == 0;
  if (diffusion_ && !all_open_) diffusion_->set_open_shares(open_share_);
}

const CellValues<BulkParticles>& Averaging::deposit(const std::vector<Vec3>& positions,
                                                    const std::vector<double>& radii,
                                                    const std::vector<BulkParticles>& contributions) {
  outside_ = std::count_if(positions.begin(), positions.end(),
                           [&](const Vec3& position) { return beyond_a_wall(grid_, position); });
  weights_ = kernel_weights(grid_, parameters_, positions, radii, std::move(weights_));  // reuses its memory
  touched_.emplace(world_, partition_, weights_.cells);
  if (!all_open_) count_open_shares(touched_->fetch_from_owners(open_share_, 1.0), weights_);

  deposited_ = deposit_records(contributions);
  relief_ =
      limit_solid(world_, grid_, partition_, parameters_.maximum_solid_fraction, open_share_, deposited_);
  return deposited_;
}

double Averaging::largest_solid_fraction() const {
  double largest = 0;
  for (const BulkParticles& cell : deposited_.values) largest = std::max(largest, cell.solid_volume);
  check_mpi(MPI_Allreduce(MPI_IN_PLACE, &largest, 1, MPI_DOUBLE, MPI_MAX, world_), "MPI_Allreduce");
  return largest / grid_.cell_volume();
}

std::vector<FluidAtParticle> Averaging::sample(const CellValues<BulkFluid>& owned,
                                               const CellValues<BulkFluidGradients>* gradients) {
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

  assert(touched_);
  if (diffusion_) offered = diffusion_->gather(std::move(offered));
  const std::vector<CellSample> cells = touched_->fetch_from_owners(offered, CellSample{});
  std::vector<CellSample> means(weights_.particles());
  demvof::sample(weights_, rows(cells), row_width<CellSample>(), rows(means));

  std::vector<FluidAtParticle> at_particles(means.size());
  for (std::size_t i = 0; i < means.size(); ++i) {
    const CellSample& mean = means[i];
    if (mean.fluid > 0)
      at_particles[i] = {mean.velocity / mean.fluid,
                         mean.pressure_gradient / mean.fluid,
                         mean.density / mean.fluid,
                         mean.viscosity / mean.fluid,
                         {},
                         mean.void_fraction / mean.fluid};
    at_particles[i].left_over_rate = mean.left_over_rate;
  }
  if (gradients) sample_gradients(owned, *gradients, at_particles);
  return at_particles;
}

void Averaging::sample_gradients(const CellValues<BulkFluid>& owned,
                                 const CellValues<BulkFluidGradients>& gradients,
                                 std::vector<FluidAtParticle>& at_particles) {
  assert(gradients.cells == owned.cells);
  CellValues<GradientSample> offered{owned.cells, std::vector<GradientSample>(owned.cells.size())};
  for (std::size_t i = 0; i < owned.cells.size(); ++i)
    if (owned.values[i].density > 0) offered.values[i] = {1, gradients.values[i]};
  if (diffusion_) offered = diffusion_->gather(std::move(offered));
  const std::vector<GradientSample> cells = touched_->fetch_from_owners(offered, GradientSample{});
  std::vector<GradientSample> means(weights_.particles());
  demvof::sample(weights_, rows(cells), row_width<GradientSample>(), rows(means));
  for (std::size_t i = 0; i < means.size(); ++i) {
    if (!(means[i].fluid > 0)) continue;
    const BulkFluidGradients& mean = means[i].gradients;
    at_particles[i].gradients = {mean.stress_force / means[i].fluid, mean.acceleration / means[i].fluid,
                                 mean.vorticity / means[i].fluid};
  }
}

}  // namespace demvof
