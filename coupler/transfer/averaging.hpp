// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <mpi.h>

#include <algorithm>
#include <functional>
#include <optional>
#include <vector>

#include "coupler/transfer/averaging_in_fluid.hpp"
#include "coupler/transfer/averaging_parameters.hpp"
#include "coupler/transfer/bulk_surface.hpp"
#include "coupler/transfer/bulk_walls.hpp"

namespace demvof {

/// Parameters in which the bandwidth is a length: 0 stands for six of the largest diameters at the start, m.
/// Throws InputError when there is no particle yet to take it from.
AveragingParameters with_bandwidth(AveragingParameters parameters, double largest_diameter);

/// Particles to bulk grid at the end of a window, and the bulk fluid back to the particles at the start of
/// the next, with the same weights: no particle moves in between.
///
/// Where there are two fluids, liquid (0) and gas (1) are averaged each by itself: a particle meets each of
/// them in the cells that hold it, with weights that follow its volume there,
///
///   w_ick = w_ic s_ck / sum over c of w_ic s_ck      s_ck: share of the cell's volume that fluid k has
///
/// so that what is wet counts in the liquid and what is dry in the gas. Calls are collective.
class Averaging {
 public:
  /// parameters: with_bandwidth().
  Averaging(MPI_Comm world, const BulkGrid& grid, const BulkPartition& partition,
            const AveragingParameters& parameters);

  /// What the fluid's mesh leaves of this rank's cells, from the next weigh() on: particles count in the
  /// fluid's share of a cell only, and kernels do not reach through walls.
  void set_openings(Openings openings);
  /// There are two fluids from here on. news: of this rank's cells, those that the surface cuts now and those
  /// that it has left since; the first time all that hold liquid. Weights follow in the next weigh().
  void see(const CellValues<BulkSurface>& news);

  /// Particles are here from now on; radii have to stay there until the next time.
  void weigh(const Spheres& particles);
  void weigh(const std::vector<Vec3>& positions, const std::vector<double>& radii) {
    weigh(Spheres(positions, radii));
  }
  /// The surface at a local particle, as long as the particles are there; of one fluid: all wetted.
  std::function<SeenSurface(int)> surface_at(const Spheres& particles) const;

  int fluids() const { return static_cast<int>(fluids_.size()); }
  AveragingInFluid& in(int fluid) { return fluids_[fluid]; }
  const AveragingInFluid& in(int fluid) const { return fluids_[fluid]; }

  /// True for a local particle whose centre is outside the fluid's mesh: beyond the bulk grid, or in a cell
  /// that the mesh leaves empty. There is no fluid: it displaces nothing and feels nothing.
  bool outside(int particle) const { return outside_[particle] != 0; }
  long outside() const { return std::count(outside_.begin(), outside_.end(), 1); }
  /// Of the last deposit, all fluids together.
  SolidRelief relief() const;
  CellValues<double> solid_volume() const;  // of this rank's cells, m3
  double largest_solid_fraction() const;    // of a bulk cell, -
  Vec3 unplaced_left_over() const;          // of the last sample, this rank, N s

 private:
  bool on_any_rank(bool here) const;
  void set_shares();
  void find_outside(const Spheres& particles);

  MPI_Comm world_;
  BulkGrid grid_;
  BulkPartition partition_;
  AveragingParameters parameters_;
  std::vector<AveragingInFluid> fluids_;
  CellValues<double> open_share_;    // this rank's cells that are not all open
  bool all_open_ = true;             // on all ranks
  CellValues<BulkWalls> walls_;      // this rank's cells that have some
  bool walled_ = false;              // any rank's
  CellValues<BulkSurface> surface_;  // this rank's cells that hold liquid; with one fluid none
  KernelWeights weights_;
  std::optional<TouchedCells> touched_;
  std::vector<char> outside_;  // of the local particles
};

}  // namespace demvof
