// SPDX-License-Identifier: GPL-3.0-or-later
#include "foam_side/find_walls.hpp"

#include <algorithm>

#include "coupler/transfer/remap.hpp"
#include "foam_side/fine_mesh.hpp"
#include "syncTools.H"

namespace demvof {

namespace {

// Of a fine cell's volume: what the corners of a mesh, as written in its file, let it stick out of a bulk
// cell.
constexpr double sticks_out = 1e-6;

/// Per touched bulk cell. Travels as a row of doubles.
struct Openings {
  BulkWalls passed;  // how often something connects the cell with its lower neighbours
  double volume = 0;
};

double& component(BulkWalls& row, int axis) {
  return axis == 0 ? row.x : axis == 1 ? row.y : row.z;
}

class Connections {
 public:
  Connections(const BulkGrid& grid, const std::vector<CellId>& cells)
      : grid_(grid), cells_(cells), openings_(cells.size()) {}

  void fill(int slot, double volume) { openings_[slot].volume += volume; }
  /// The fluid is one in two bulk cells; nothing unless they share a face.
  void connect(CellId a, CellId b) {
    if (a == b) return;
    for (int axis = 0; axis < 3; ++axis) {
      if (grid_.neighbour(grid_.ijk(a), axis, -1) == b) pass(a, axis);
      if (grid_.neighbour(grid_.ijk(b), axis, -1) == a) pass(b, axis);
    }
  }
  const std::vector<Openings>& openings() const { return openings_; }

 private:
  void pass(CellId upper, int axis) {
    const auto place = std::lower_bound(cells_.begin(), cells_.end(), upper);
    if (place != cells_.end() && *place == upper)
      component(openings_[place - cells_.begin()].passed, axis) += 1;
  }
  const BulkGrid& grid_;
  const std::vector<CellId>& cells_;
  std::vector<Openings> openings_;
};

}  // namespace

CellValues<BulkWalls> find_walls(const Foam::fvMesh& mesh, const BulkGrid& grid,
                                 const BulkPartition& partition, MPI_Comm world) {
  const Remap cut(world, grid, partition, fine_mesh(mesh), {Mapping::nearest, Mapping::conservative});
  const std::vector<CellId>& touched = cut.cells().cells();
  Connections connections(grid, touched);
  std::vector<std::vector<CellId>> bulk(static_cast<std::size_t>(mesh.nCells()));  // of each fine cell
  for (const Subcell& subcell : cut.subcells()) {
    connections.fill(subcell.slot, subcell.volume);
    if (subcell.volume > sticks_out * mesh.V()[subcell.fine])
      bulk[subcell.fine].push_back(touched[subcell.slot]);
  }
  const auto connect = [&](const std::vector<CellId>& some, const std::vector<CellId>& others) {
    for (const CellId a : some)
      for (const CellId b : others) connections.connect(a, b);
  };
  for (const std::vector<CellId>& cells : bulk) connect(cells, cells);
  for (label face = 0; face < mesh.nInternalFaces(); ++face)
    connect(bulk[mesh.faceOwner()[face]], bulk[mesh.faceNeighbour()[face]]);

  scalarField home(mesh.nCells()),
      across;  // bulk cell of each fine cell's centre; beyond the boundary's faces
  forAll(home, cell) home[cell] =
      static_cast<double>(grid.id(grid.locate(to_vec3(mesh.cellCentres()[cell]))));
  Foam::syncTools::swapBoundaryCellList(mesh, home, across);
  for (const Foam::polyPatch& patch : mesh.boundaryMesh())
    for (label face = patch.start(); patch.coupled() && face < patch.start() + patch.size(); ++face)
      connect(bulk[mesh.faceOwner()[face]], {static_cast<CellId>(across[face - mesh.nInternalFaces()])});

  // Both cells of a face must hold fluid: volumes of all neighbours, by way of the owners.
  const CellValues<Openings> owned = cut.cells().sum_to_owners(connections.openings());
  const std::vector<Openings> all = cut.cells().fetch_from_owners(owned, Openings{});
  std::vector<BulkWalls> walls(touched.size());
  for (std::size_t slot = 0; slot < touched.size(); ++slot)
    for (int axis = 0; axis < 3; ++axis) {
      const CellId lower = grid.neighbour(grid.ijk(touched[slot]), axis, -1);
      const auto place = std::lower_bound(touched.begin(), touched.end(), lower);
      if (lower < 0 || lower == touched[slot] || place == touched.end() || *place != lower) continue;
      Openings here = all[slot];
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

}  // namespace demvof
