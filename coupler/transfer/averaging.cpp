// SPDX-License-Identifier: GPL-3.0-or-later
#include "coupler/transfer/averaging.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "coupler/base/errors.hpp"
#include "coupler/base/mpi_check.hpp"
#include "coupler/grid/cell_block.hpp"

namespace demvof {
namespace {

bool beyond_a_wall(const BulkGrid& grid, const Vec3& position) {
  for (int axis = 0; axis < 3; ++axis)
    if (!grid.periodic()[axis] &&
        !(position[axis] >= grid.lower()[axis] && position[axis] <= grid.upper()[axis]))
      return true;
  return false;
}

/// Share of the cell's fluid that counts as liquid.
double seen_liquid(const BulkSurface& cell) {
  if (cell.liquid_fraction <= least_seen_share) return 0;
  return cell.liquid_fraction >= 1 - least_seen_share ? 1 : cell.liquid_fraction;
}

/// news into what is known, both sorted; cells without liquid are not kept.
CellValues<BulkSurface> brought_up_to_date(const CellValues<BulkSurface>& known,
                                           const CellValues<BulkSurface>& news) {
  CellValues<BulkSurface> now;
  const auto keep = [&now](CellId cell, const BulkSurface& surface) {
    if (seen_liquid(surface) == 0) return;
    now.cells.push_back(cell);
    now.values.push_back(surface);
  };
  std::size_t at = 0;
  for (std::size_t i = 0; i < news.cells.size(); ++i) {
    for (; at < known.cells.size() && known.cells[at] < news.cells[i]; ++at)
      keep(known.cells[at], known.values[at]);
    if (at < known.cells.size() && known.cells[at] == news.cells[i]) ++at;
    keep(news.cells[i], news.values[i]);
  }
  for (; at < known.cells.size(); ++at) keep(known.cells[at], known.values[at]);
  return now;
}

/// The bulk cells that a box around a particle meets, along each axis; they may lie beyond the grid.
struct CellBox {
  CellBox(const BulkGrid& grid, const Vec3& position, double reach) {
    for (int axis = 0; axis < 3; ++axis) {
      const double h = grid.spacing()[axis], low = grid.lower()[axis];
      first[axis] = rounded_down((position[axis] - reach - low) / h);
      last[axis] = rounded_down((position[axis] + reach - low) / h);
    }
  }
  static int rounded_down(double x) {
    const int towards_zero = static_cast<int>(x);
    return towards_zero - (x < towards_zero);
  }
  bool operator==(const CellBox& other) const { return first == other.first && last == other.last; }

  std::array<int, 3> first, last;
};

/// The cells of a box, as indices inside the grid.
template <class Visit>
void for_each_cell(const BulkGrid& grid, const CellBox& box, const Visit& visit) {
  const auto inside = [&grid](int index, int axis) {
    const int n = grid.cells()[axis];
    return grid.periodic()[axis] ? ((index % n) + n) % n : std::clamp(index, 0, n - 1);
  };
  for (int k = box.first[2]; k <= box.last[2]; ++k)
    for (int j = box.first[1]; j <= box.last[1]; ++j)
      for (int i = box.first[0]; i <= box.last[0]; ++i)
        visit(std::array<int, 3>{inside(i, 0), inside(j, 1), inside(k, 2)});
}

/// Keeps the box of the particle before, which has most often the same one.
class CellBoxes {
 public:
  CellBoxes(const BulkGrid& grid, const Spheres& particles) : grid_(grid), particles_(particles) {}
  /// Within two radii; visit(box) where it is another one than that of the last call.
  template <class Visit>
  void find(int particle, const Visit& visit) {
    const CellBox box(grid_, particles_.position[particle], 2 * particles_.radius[particle]);
    if (box_ && *box_ == box) return;
    box_ = box;
    visit(box);
  }

 private:
  const BulkGrid& grid_;
  Spheres particles_;
  std::optional<CellBox> box_;
};

/// The surface in the bulk cells around the particles of this rank.
struct NearSurface {
  CellBlock block;
  std::vector<BulkSurface> surface;

  const BulkSurface& at(const std::array<int, 3>& ijk) const { return surface[block.slot(block.place(ijk))]; }
};

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
    : world_(world), grid_(grid), partition_(partition), parameters_(parameters), weights_(grid) {
  fluids_.emplace_back(world_, grid_, partition_, parameters_);
}

bool Averaging::on_any_rank(bool here) const {
  int any = here ? 1 : 0;
  check_mpi(MPI_Allreduce(MPI_IN_PLACE, &any, 1, MPI_INT, MPI_MAX, world_), "MPI_Allreduce");
  return any > 0;
}

void Averaging::set_openings(Openings openings) {
  open_share_ = std::move(openings.shares);
  all_open_ = !on_any_rank(!open_share_.cells.empty());
  walls_ = std::move(openings.walls);
  walled_ = on_any_rank(!walls_.cells.empty());
  for (AveragingInFluid& fluid : fluids_) fluid.set_walls(walls_);
}

void Averaging::see(const CellValues<BulkSurface>& news) {
  if (fluids() == 1) {
    fluids_.emplace_back(world_, grid_, partition_, parameters_);
    fluids_.back().set_walls(walls_);
  }
  surface_ = brought_up_to_date(surface_, news);
}

void Averaging::set_shares() {
  if (fluids() == 1) return fluids_[0].set_shares(open_share_);
  int rank;
  check_mpi(MPI_Comm_rank(world_, &rank), "MPI_Comm_rank");
  std::array<CellValues<double>, 2> share;
  std::size_t open = 0, liquid = 0;
  for (const CellId cell : partition_.cells(rank)) {
    const bool partly = open < open_share_.cells.size() && open_share_.cells[open] == cell;
    const bool wet = liquid < surface_.cells.size() && surface_.cells[liquid] == cell;
    const double whole = partly ? open_share_.values[open++] : 1;
    const double fraction = wet ? seen_liquid(surface_.values[liquid++]) : 0;
    const double of[] = {whole * fraction, whole * (1 - fraction)};
    for (int fluid = 0; fluid < 2; ++fluid) {
      if (of[fluid] == 1) continue;
      share[fluid].cells.push_back(cell);
      share[fluid].values.push_back(of[fluid]);
    }
  }
  for (int fluid = 0; fluid < 2; ++fluid) fluids_[fluid].set_shares(std::move(share[fluid]));
}

void Averaging::weigh(const Spheres& particles) {
  find_kernel_weights(grid_, parameters_, particles, weights_);
  touched_.emplace(world_, partition_, weights_.cells());
  if (walled_)
    mirror_at_walls(grid_, touched_->fetch_from_owners(walls_, BulkWalls{}), particles.position, weights_);
  find_outside(particles);
  set_shares();
  for (AveragingInFluid& fluid : fluids_) fluid.weigh(weights_, *touched_, outside_, particles.radius);
}

void Averaging::find_outside(const Spheres& particles) {
  outside_.assign(static_cast<std::size_t>(particles.count), 0);
  std::vector<double> share;
  if (!all_open_) share = touched_->fetch_from_owners(open_share_, 1.0);
  for (int i = 0; i < particles.count; ++i) {
    const Vec3& position = particles.position[i];
    outside_[i] = beyond_a_wall(grid_, position);
    if (all_open_ || outside_[i]) continue;
    const CellId own = grid_.id(grid_.locate(position));
    const std::vector<CellId>& cells = weights_.cells();
    const auto place = std::lower_bound(cells.begin(), cells.end(), own);
    outside_[i] = place != cells.end() && *place == own && share[place - cells.begin()] == 0;
  }
}

std::function<SeenSurface(int)> Averaging::surface_at(const Spheres& particles) const {
  if (fluids() == 1) return [](int) { return SeenSurface{}; };
  std::array<int, 3> first = grid_.cells(), last{-1, -1, -1};
  CellBoxes boxes(grid_, particles);
  const auto extend = [&](const std::array<int, 3>& ijk) {
    for (int axis = 0; axis < 3; ++axis) {
      first[axis] = std::min(first[axis], ijk[axis]);
      last[axis] = std::max(last[axis], ijk[axis]);
    }
  };
  for (int i = 0; i < particles.count; ++i)
    boxes.find(i, [&](const CellBox& box) { for_each_cell(grid_, box, extend); });
  if (particles.count == 0) first = {0, 0, 0}, last = {-1, -1, -1};
  CellBlock block(grid_, first, last);
  CellBoxes again(grid_, particles);
  for (int i = 0; i < particles.count; ++i)
    again.find(i, [&](const CellBox& box) {
      for_each_cell(grid_, box, [&](const std::array<int, 3>& ijk) { block.mark(block.place(ijk)); });
    });
  const TouchedCells cells(world_, partition_, block.list_marked());
  NearSurface near{std::move(block), cells.fetch_from_owners(surface_, BulkSurface{})};
  double least = 1, most = 0;  // liquid in the cells around
  return [this, particles, near = std::move(near), boxes = CellBoxes(grid_, particles), least,
          most](int i) mutable {
    boxes.find(i, [&](const CellBox& box) {
      least = 1, most = 0;
      for_each_cell(grid_, box, [&](const std::array<int, 3>& ijk) {
        const double liquid = seen_liquid(near.at(ijk));
        least = std::min(least, liquid);
        most = std::max(most, liquid);
      });
    });
    if (least == most && (least == 0 || least == 1)) return SeenSurface{least, {}, 0};
    return see_surface(grid_, particles.position[i], particles.radius[i],
                       [&](CellId cell) { return near.at(grid_.ijk(cell)); });
  };
}

SolidRelief Averaging::relief() const {
  SolidRelief sum;
  for (const AveragingInFluid& fluid : fluids_) {
    sum.cells += fluid.relief().cells;
    sum.volume += fluid.relief().volume;
    sum.not_placed += fluid.relief().not_placed;
  }
  return sum;
}

CellValues<double> Averaging::solid_volume() const {
  CellValues<double> sum;
  std::array<std::size_t, 2> next{};
  for (;;) {
    CellId cell = -1;
    for (int fluid = 0; fluid < fluids(); ++fluid) {
      const std::vector<CellId>& cells = fluids_[fluid].deposited().cells;
      if (next[fluid] < cells.size() && (cell < 0 || cells[next[fluid]] < cell)) cell = cells[next[fluid]];
    }
    if (cell < 0) return sum;
    sum.cells.push_back(cell);
    sum.values.push_back(0);
    for (int fluid = 0; fluid < fluids(); ++fluid) {
      const CellValues<BulkParticles>& deposited = fluids_[fluid].deposited();
      if (next[fluid] < deposited.cells.size() && deposited.cells[next[fluid]] == cell)
        sum.values.back() += deposited.values[next[fluid]++].solid_volume;
    }
  }
}

double Averaging::largest_solid_fraction() const {
  double largest = 0;
  for (const double volume : solid_volume().values) largest = std::max(largest, volume);
  check_mpi(MPI_Allreduce(MPI_IN_PLACE, &largest, 1, MPI_DOUBLE, MPI_MAX, world_), "MPI_Allreduce");
  return largest / grid_.cell_volume();
}

Vec3 Averaging::unplaced_left_over() const {
  Vec3 sum;
  for (const AveragingInFluid& fluid : fluids_) sum += fluid.unplaced_left_over();
  return sum;
}

}  // namespace demvof
