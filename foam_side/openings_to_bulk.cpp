// SPDX-License-Identifier: GPL-3.0-or-later
#include "foam_side/openings_to_bulk.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "coupler/base/errors.hpp"
#include "coupler/base/mpi_check.hpp"
#include "coupler/transfer/remap.hpp"
#include "cyclicAMIPolyPatch.H"
#include "foam_side/fine_mesh.hpp"
#include "syncTools.H"

namespace demvof {

namespace {

// Of a fine cell's volume: what the corners of a mesh, as written in its file, let it stick out of a bulk
// cell.
constexpr double sticks_out = 1e-6;

// A bulk cell is full of fluid mesh up to what the corners of a mesh, as written in its file, leave open.
constexpr double full = 1 - 1e-6;

// Of a bulk cell that a mesh which moves fills, to hold particles.
constexpr double least_share = 0.01;

/// Per touched bulk cell. Travels as a row of doubles.
struct Passages {
  BulkWalls passed;  // how often something connects the cell with its lower neighbours
  double volume = 0;
};

double& component(BulkWalls& row, int axis) {
  return axis == 0 ? row.x : axis == 1 ? row.y : row.z;
}

class Connections {
 public:
  Connections(const BulkGrid& grid, const std::vector<CellId>& cells)
      : grid_(grid), cells_(cells), passages_(cells.size()) {}

  void fill(int slot, double volume) { passages_[slot].volume += volume; }
  /// The fluid is one in two bulk cells; nothing unless they share a face.
  void connect(CellId a, CellId b) {
    if (a == b) return;
    for (int axis = 0; axis < 3; ++axis) {
      if (grid_.neighbour(grid_.ijk(a), axis, -1) == b) pass(a, axis);
      if (grid_.neighbour(grid_.ijk(b), axis, -1) == a) pass(b, axis);
    }
  }
  const std::vector<Passages>& passages() const { return passages_; }

 private:
  void pass(CellId upper, int axis) {
    const auto place = std::lower_bound(cells_.begin(), cells_.end(), upper);
    if (place != cells_.end() && *place == upper)
      component(passages_[place - cells_.begin()].passed, axis) += 1;
  }
  const BulkGrid& grid_;
  const std::vector<CellId>& cells_;
  std::vector<Passages> passages_;
};

/// Of a fine cell: the bulk cells that it lies in, and the middle of its part in each of them, m.
struct Parts {
  std::vector<CellId> cells;
  std::vector<Vec3> middles;
};

/// The bulk cells beyond a face of a sliding interface, whose other side is at the same place, in cells that
/// change: beyond the places on it that are nearest to the parts of its own cell.
std::vector<CellId> bulk_cells_beyond(const Foam::fvMesh& mesh, const BulkGrid& grid, label face,
                                      const Parts& parts) {
  constexpr double beyond = 1e-3;  // of the fine cell's size, and from the face's edges to its centre
  const vector& area = mesh.faceAreas()[face];
  const vector outwards =
      area / (Foam::mag(area) + Foam::VSMALL) * std::cbrt(mesh.V()[mesh.faceOwner()[face]]);
  std::vector<CellId> cells;
  for (const Vec3& middle : parts.middles) {
    const vector nearest = mesh.faces()[face].nearestPoint(to_foam(middle), mesh.points()).rawPoint();
    const vector place = nearest + beyond * (mesh.faceCentres()[face] - nearest + outwards);
    cells.push_back(grid.id(grid.locate(to_vec3(place))));
  }
  return cells;
}

/// The bulk cells of the fine cell beyond each boundary face where that is of another rank or at the other
/// end of a period: all that it lies in, since a fine cell may be larger than a bulk cell.
std::vector<std::vector<CellId>> bulk_cells_across(const Foam::fvMesh& mesh, const std::vector<Parts>& bulk) {
  std::size_t most = 0;
  for (const Foam::polyPatch& patch : mesh.boundaryMesh())
    for (const label cell : patch.faceCells())
      if (patch.coupled()) most = std::max(most, bulk[cell].cells.size());
  label rounds = static_cast<label>(most);
  Foam::reduce(rounds, Foam::maxOp<label>());
  std::vector<std::vector<CellId>> across(static_cast<std::size_t>(mesh.nBoundaryFaces()));
  scalarField home(mesh.nCells()), beyond;  // one of the bulk cells of each; -1: none
  for (std::size_t n = 0; n < static_cast<std::size_t>(rounds); ++n) {
    forAll(home, cell) home[cell] =
        n < bulk[cell].cells.size() ? static_cast<double>(bulk[cell].cells[n]) : -1;
    Foam::syncTools::swapBoundaryCellList(mesh, home, beyond);
    forAll(beyond, face) if (beyond[face] >= 0) across[face].push_back(static_cast<CellId>(beyond[face]));
  }
  return across;
}

CellValues<BulkWalls> find_walls(const Foam::fvMesh& mesh, const BulkGrid& grid, const Remap& cut) {
  const std::vector<CellId>& touched = cut.cells().cells();
  Connections connections(grid, touched);
  std::vector<Parts> bulk(static_cast<std::size_t>(mesh.nCells()));  // of each fine cell
  for (const Subcell& subcell : cut.subcells()) {
    connections.fill(subcell.slot, subcell.volume);
    if (!(subcell.volume > sticks_out * mesh.V()[subcell.fine])) continue;
    bulk[subcell.fine].cells.push_back(touched[subcell.slot]);
    bulk[subcell.fine].middles.push_back(subcell.centroid);
  }
  const auto connect = [&](const std::vector<CellId>& some, const std::vector<CellId>& others) {
    for (const CellId a : some)
      for (const CellId b : others) connections.connect(a, b);
  };
  for (const Parts& parts : bulk) connect(parts.cells, parts.cells);
  for (label face = 0; face < mesh.nInternalFaces(); ++face)
    connect(bulk[mesh.faceOwner()[face]].cells, bulk[mesh.faceNeighbour()[face]].cells);

  const std::vector<std::vector<CellId>> across = bulk_cells_across(mesh, bulk);
  for (const Foam::polyPatch& patch : mesh.boundaryMesh()) {
    const bool slides = Foam::isA<Foam::cyclicAMIPolyPatch>(patch);
    const bool goes_on = slides || patch.coupled();
    for (label face = patch.start(); goes_on && face < patch.start() + patch.size(); ++face) {
      const Parts& here = bulk[mesh.faceOwner()[face]];
      if (slides)
        connect(here.cells, bulk_cells_beyond(mesh, grid, face, here));
      else
        connect(here.cells, across[face - mesh.nInternalFaces()]);
    }
  }

  // Both cells of a face must hold fluid: volumes of all neighbours, by way of the owners.
  const CellValues<Passages> owned = cut.cells().sum_to_owners(connections.passages());
  const std::vector<Passages> all = cut.cells().fetch_from_owners(owned, Passages{});
  std::vector<BulkWalls> walls(touched.size());
  for (std::size_t slot = 0; slot < touched.size(); ++slot)
    for (int axis = 0; axis < 3; ++axis) {
      const CellId lower = grid.neighbour(grid.ijk(touched[slot]), axis, -1);
      const auto place = std::lower_bound(touched.begin(), touched.end(), lower);
      if (lower < 0 || lower == touched[slot] || place == touched.end() || *place != lower) continue;
      Passages here = all[slot];
      const bool both = here.volume > 0 && all[place - touched.begin()].volume > 0;
      if (both && component(here.passed, axis) == 0) component(walls[slot], axis) = 1;
    }
  const CellValues<BulkWalls> found = cut.cells().sum_to_owners(walls);
  CellValues<BulkWalls> kept;
  for (std::size_t i = 0; i < found.cells.size(); ++i) {
    const BulkWalls& here = found.values[i];
    if (here.x + here.y + here.z == 0) continue;
    kept.cells.push_back(found.cells[i]);
    kept.values.push_back(here);
  }
  return kept;
}

void require_inside(const Foam::fvMesh& mesh, const BulkGrid& grid) {
  const MeshBox box = mesh_box(mesh);
  for (int axis = 0; axis < 3; ++axis) {
    if (grid.periodic()[axis]) continue;  // what leaves at one end is at the other
    const double margin = std::max(1e-6 * (box.upper[axis] - box.lower[axis]), 1e-4 * grid.spacing()[axis]);
    if (box.lower[axis] < grid.lower()[axis] - margin || box.upper[axis] > grid.upper()[axis] + margin)
      throw RunError(
          fmt::format("the mesh has moved to {:.9g} to {:.9g} m along {}, out of the bulk grid, which goes "
                      "from {:.9g} to "
                      "{:.9g} m: give bulk_grid a box that holds the mesh wherever it goes",
                      box.lower[axis], box.upper[axis], "xyz"[axis], grid.lower()[axis], grid.upper()[axis]));
  }
}

CellValues<double> without_cells_that_empty(CellValues<double> shares, const CellValues<double>& before,
                                            double ahead) {
  for (std::size_t i = 0; i < shares.cells.size(); ++i) {
    double& share = shares.values[i];
    const double* last = find(before, shares.cells[i]);
    const double change = share - (last ? *last : 1);
    if (share < least_share || share + ahead * change <= 0) share = 0;
  }
  return shares;
}

CellValues<double> find_shares(const BulkGrid& grid, const BulkPartition& partition, const Remap& cut,
                               MPI_Comm world) {
  std::vector<double> here(cut.cells().cells().size(), 0.0);
  for (const Subcell& subcell : cut.subcells()) here[subcell.slot] += subcell.volume;
  const CellValues<double> met = cut.cells().sum_to_owners(here);
  CellValues<double> open;
  int rank;
  check_mpi(MPI_Comm_rank(world, &rank), "MPI_Comm_rank");
  std::size_t next = 0;
  for (const CellId cell : partition.cells(rank)) {
    const bool known = next < met.cells.size() && met.cells[next] == cell;
    const double share = known ? met.values[next++] / grid.cell_volume() : 0.0;
    if (share >= full) continue;
    open.cells.push_back(cell);
    open.values.push_back(share);
  }
  return open;
}

}  // namespace

OpeningsToBulk::OpeningsToBulk(const BulkCut& cut) : cut_(cut) {
  state_.told = find();
  state_.shares = state_.told.shares;
}

Openings OpeningsToBulk::find() const {
  const Remap whole(cut_.world(), cut_.grid(), cut_.partition(), fine_mesh(cut_.mesh()),
                    {Mapping::nearest, Mapping::conservative});
  return {find_shares(cut_.grid(), cut_.partition(), whole, cut_.world()),
          find_walls(cut_.mesh(), cut_.grid(), whole)};
}

const Openings& OpeningsToBulk::look(double ahead) {
  require_inside(cut_.mesh(), cut_.grid());
  Openings now = find();
  const CellValues<double> before = std::exchange(state_.shares, now.shares);
  now.shares = without_cells_that_empty(std::move(now.shares), before, ahead);
  state_.told = std::move(now);
  return state_.told;
}

}  // namespace demvof
