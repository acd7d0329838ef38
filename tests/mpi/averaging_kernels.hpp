// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Verification row averaging_kernels: what every averaging kernel must keep, and what tells them apart.

#include <gtest/gtest.h>
#include <mpi.h>

#include <functional>
#include <vector>

#include "coupler/transfer/averaging.hpp"
#include "tests/support/record.hpp"

namespace demvof::test {

constexpr double pi = 3.14159265358979323846;

struct Set {  // of particles
  std::vector<Vec3> position;
  std::vector<double> radius, value;  // m; what each deposits
  void add(const Vec3& x, double r, double v = 1) {
    position.push_back(x);
    radius.push_back(r);
    value.push_back(v);
  }
};

inline AveragingParameters averaging(Kernel kernel, double bandwidth) {
  AveragingParameters parameters;
  parameters.kernel = kernel;
  parameters.bandwidth = bandwidth;
  return parameters;
}

/// Deposit and sample of one number per particle and cell with the class that dem_side uses, particles dealt
/// out to the ranks of comm in turn. The number is a drag factor on the way to the bulk grid, a velocity
/// back.
class Averager {
 public:
  Averager(MPI_Comm comm, const BulkGrid& grid, const AveragingParameters& parameters, const Set& all)
      : comm_(comm),
        grid_(grid),
        partition_(grid.cells(), size()),
        particles_(static_cast<int>(all.position.size())),
        averaging_(comm, grid, partition_, parameters) {
    std::vector<BulkParticles> contributions;
    for (int i = rank(); i < particles_; i += size()) {
      mine_.add(all.position[i], all.radius[i], all.value[i]);
      number_.push_back(i);
      contributions.emplace_back();
      contributions.back().drag_factor = all.value[i];
    }
    averaging_.weigh(mine_.position, mine_.radius);
    averaging_.in(0).deposit([&](int i) { return contributions[i]; });
  }
  /// All cells, on every rank.
  std::vector<double> deposit() const {
    const CellValues<BulkParticles>& owned = averaging_.in(0).deposited();
    std::vector<double> all(grid_.cell_count(), 0.0);
    for (std::size_t i = 0; i < owned.cells.size(); ++i) all[owned.cells[i]] = owned.values[i].drag_factor;
    return sum(all);
  }
  /// cells: all of them. All particles, on every rank.
  std::vector<double> sample(const std::vector<double>& cells) {
    return sampled(
        cells, [](BulkFluid& fluid, BulkFluidGradients&, double value) { fluid.velocity.x = value; },
        [](const FluidAtParticle& fluid) { return fluid.velocity.x; });
  }
  /// What particles with these values as drag factors receive of the impulses that cells owe them.
  std::vector<double> hand_over(const std::vector<double>& owed) {
    return sampled(
        owed, [](BulkFluid& fluid, BulkFluidGradients&, double value) { fluid.left_over.x = value; },
        [](const FluidAtParticle& fluid) { return fluid.left_over_rate.x; });
  }
  /// sample() by way of any member of what is told; put and get name it.
  template <class Put, class Get>
  std::vector<double> sampled(const std::vector<double>& cells, const Put& put, const Get& get) {
    CellValues<BulkFluid> fluid;
    CellValues<BulkFluidGradients> gradients;
    for (const CellId cell : partition_.cells(rank())) {
      fluid.cells.push_back(cell);
      fluid.values.emplace_back();
      fluid.values.back().density = 1;
      gradients.values.emplace_back();
      put(fluid.values.back(), gradients.values.back(), cells[cell]);
    }
    gradients.cells = fluid.cells;
    const auto felt = averaging_.in(0).sample(fluid, &gradients);
    std::vector<double> all(particles_, 0.0);
    for (std::size_t i = 0; i < number_.size(); ++i) all[number_[i]] = get(felt(static_cast<int>(i)));
    return sum(all);
  }
  double unplaced_left_over() const { return averaging_.unplaced_left_over().x; }

 private:
  int rank() const {
    int rank;
    MPI_Comm_rank(comm_, &rank);
    return rank;
  }
  int size() const {
    int size;
    MPI_Comm_size(comm_, &size);
    return size;
  }
  std::vector<double> sum(std::vector<double> all) const {
    MPI_Allreduce(MPI_IN_PLACE, all.data(), static_cast<int>(all.size()), MPI_DOUBLE, MPI_SUM, comm_);
    return all;
  }

  MPI_Comm comm_;
  BulkGrid grid_;
  BulkPartition partition_;
  int particles_;
  Set mine_;
  std::vector<int> number_;
  Averaging averaging_;
};

class AveragingKernels : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    int rank;
    MPI_Comm_rank(MPI_COMM_WORLD, &rank);
    if (rank == 0)
      record_ = new Record("averaging_kernels", "Averaging kernels",
                           "Shares of particles in bulk cells for each kernel: nothing lost at walls, "
                           "corners and beyond them for "
                           "diameters up to three cells; moments away from walls; an even set stays "
                           "even at walls; a particle that "
                           "crosses a cell face changes the void fraction continuously (all kernels "
                           "but centre); sampling is the "
                           "transpose of depositing; the same numbers on 1 to 4 ranks.",
                           "tests/Alltest -- -R averaging_kernels");
  }
  static void TearDownTestSuite() { delete record_; }
  /// On rank 0 alone; every rank has the same numbers.
  static void record(const std::function<void(Record&)>& write) {
    if (record_) write(*record_);
  }
  static inline Record* record_ = nullptr;
};
}  // namespace demvof::test
