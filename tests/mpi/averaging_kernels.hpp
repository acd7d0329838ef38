// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Verification row averaging_kernels: what every averaging kernel must keep, and what tells them apart.

#include <gtest/gtest.h>
#include <mpi.h>

#include <functional>
#include <memory>
#include <vector>

#include "coupler/grid/touched_cells.hpp"
#include "coupler/transfer/diffusion.hpp"
#include "coupler/transfer/kernel_weights.hpp"
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

/// Deposit and sample as dem_side does both, particles dealt out to the ranks of comm in turn.
class Averager {
 public:
  Averager(MPI_Comm comm, const BulkGrid& grid, const AveragingParameters& parameters, const Set& all)
      : comm_(comm), grid_(grid), partition_(grid.cell_count(), size()), particles_(all.position.size()) {
    for (int i = rank(); i < particles_; i += size()) {
      mine_.add(all.position[i], all.radius[i], all.value[i]);
      number_.push_back(i);
    }
    weights_ = kernel_weights(grid, parameters, mine_.position, mine_.radius);
    touched_ = std::make_unique<TouchedCells>(comm, partition_, weights_.cells);
    if (parameters.kernel == Kernel::diffusion)
      diffusion_ = std::make_unique<Diffusion>(comm, grid, partition_, parameters.bandwidth);
  }
  /// All cells, on every rank.
  std::vector<double> deposit() const {
    std::vector<double> touched(weights_.cells.size());
    demvof::deposit(weights_, mine_.value.data(), 1, touched.data());
    CellValues<double> owned = touched_->sum_to_owners(touched);
    if (diffusion_) owned = diffusion_->spread(owned);
    std::vector<double> all(grid_.cell_count(), 0.0);
    for (std::size_t i = 0; i < owned.cells.size(); ++i) all[owned.cells[i]] = owned.values[i];
    return sum(all);
  }
  /// cells: all of them. All particles, on every rank.
  std::vector<double> sample(const std::vector<double>& cells) const {
    CellValues<double> owned;
    for (CellId cell = partition_.begin(rank()); cell < partition_.end(rank()); ++cell) {
      owned.cells.push_back(cell);
      owned.values.push_back(cells[cell]);
    }
    if (diffusion_) owned = diffusion_->gather(owned);
    const std::vector<double> fetched = touched_->fetch_from_owners(owned, 0.0);
    std::vector<double> sampled(number_.size()), all(particles_, 0.0);
    demvof::sample(weights_, fetched.data(), 1, sampled.data());
    for (std::size_t i = 0; i < number_.size(); ++i) all[number_[i]] = sampled[i];
    return sum(all);
  }

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
  KernelWeights weights_;
  std::unique_ptr<TouchedCells> touched_;
  std::unique_ptr<Diffusion> diffusion_;
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
