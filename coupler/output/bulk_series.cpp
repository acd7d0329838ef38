// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>
#include <vtkCellData.h>
#include <vtkImageData.h>
#include <vtkUnsignedCharArray.h>
#include <vtkXMLImageDataWriter.h>

#include "coupler/grid/bring_to_owners.hpp"
#include "coupler/output/vtk_file.hpp"
#include "coupler/output/vtk_series.hpp"

namespace fs = std::filesystem;

namespace demvof {

namespace {

/// Layers of cells across z, by the rank that writes them; a rank may have none.
BulkPartition layers_of(MPI_Comm world, const BulkGrid& grid) {
  return {grid.cells()[2], vtk_file::size_of(world)};
}

CellId cells_in_layer(const BulkGrid& grid) {
  return CellId{grid.cells()[0]} * grid.cells()[1];
}

std::string extent(const BulkGrid& grid, CellId first, CellId last) {
  return fmt::format("\"0 {} 0 {} {} {}\"", grid.cells()[0], grid.cells()[1], first, last);
}

/// A piece of the grid: the layers from first to before last.
void write_layers(const fs::path& path, const BulkGrid& grid, CellId first, CellId last,
                  const CellValues<BulkFrame>& active) {
  const CellId begin = first * cells_in_layer(grid);
  const auto cells = static_cast<std::size_t>((last - first) * cells_in_layer(grid));
  std::vector<BulkFrame> frames(cells);
  vtkNew<vtkUnsignedCharArray> is_active;
  is_active->SetName("active");
  is_active->SetNumberOfTuples(static_cast<vtkIdType>(cells));
  is_active->FillValue(0);
  for (std::size_t i = 0; i < active.cells.size(); ++i) {
    frames[static_cast<std::size_t>(active.cells[i] - begin)] = active.values[i];
    is_active->SetValue(active.cells[i] - begin, 1);
  }
  std::vector<double> void_fraction(cells);
  std::vector<Vec3> velocity(cells), gradient(cells), drag(cells);
  for (std::size_t c = 0; c < cells; ++c) {
    void_fraction[c] = frames[c].void_fraction;
    velocity[c] = frames[c].fluid_velocity;
    gradient[c] = frames[c].pressure_gradient;
    drag[c] = frames[c].drag;
  }
  vtkNew<vtkImageData> image;
  image->SetExtent(0, grid.cells()[0], 0, grid.cells()[1], static_cast<int>(first), static_cast<int>(last));
  image->SetOrigin(grid.lower().x, grid.lower().y, grid.lower().z);
  image->SetSpacing(grid.spacing().x, grid.spacing().y, grid.spacing().z);
  image->GetCellData()->AddArray(is_active);
  image->GetCellData()->AddArray(vtk_file::array("void_fraction", void_fraction));
  image->GetCellData()->AddArray(vtk_file::array("fluid_velocity", velocity));
  image->GetCellData()->AddArray(vtk_file::array("pressure_gradient", gradient));
  image->GetCellData()->AddArray(vtk_file::array("drag", drag));
  vtk_file::write<vtkXMLImageDataWriter>(path, image.Get());
}

void write_index(const fs::path& path, const BulkGrid& grid, MPI_Comm world, const std::string& stem) {
  std::string arrays = "<PCellData>\n<PDataArray type=\"UInt8\" Name=\"active\"/>\n";
  arrays += vtk_file::declared_array("void_fraction", 1);
  for (const char* name : {"fluid_velocity", "pressure_gradient", "drag"})
    arrays += vtk_file::declared_array(name, 3);
  arrays += "</PCellData>\n";
  const BulkPartition layers = layers_of(world, grid);
  std::vector<std::string> pieces;
  for (int rank = 0; rank < layers.ranks(); ++rank)
    if (layers.begin(rank) < layers.end(rank))
      pieces.push_back(fmt::format("Extent={} Source=\"{}\"",
                                   extent(grid, layers.begin(rank), layers.end(rank)),
                                   vtk_file::piece_name(world, stem, "vti", rank)));
  const Vec3 &origin = grid.lower(), &spacing = grid.spacing();
  vtk_file::write_pieces(path, "PImageData",
                         fmt::format(" WholeExtent={} Origin=\"{} {} {}\" Spacing=\"{} {} {}\"",
                                     extent(grid, 0, grid.cells()[2]), origin.x, origin.y, origin.z,
                                     spacing.x, spacing.y, spacing.z),
                         arrays, pieces);
}

}  // namespace

BulkSeries::BulkSeries(MPI_Comm world, BulkGrid grid, const fs::path& folder,
                       std::optional<double> continued_from, const std::string& name)
    : VtkSeries(world, folder, name, continued_from), grid_(std::move(grid)) {}

void BulkSeries::write(double time, const CellValues<BulkFrame>& active) {
  const std::string stem = fmt::format("{}_{:06}", name_, count_++);
  const BulkPartition layers = layers_of(world_, grid_);
  const CellValues<BulkFrame> mine = bring_to(
      world_, [&](CellId cell) { return layers.owner(cell / cells_in_layer(grid_)); }, active);
  vtk_file::on_all_ranks(world_, folder_, [&] {
    const int rank = vtk_file::rank_of(world_);
    if (layers.begin(rank) < layers.end(rank))
      write_layers(folder_ / vtk_file::piece_name(world_, stem, "vti", rank), grid_, layers.begin(rank),
                   layers.end(rank), mine);
  });
  vtk_file::on_all_ranks(world_, folder_, [&] {
    if (vtk_file::rank_of(world_) != 0) return;
    std::string whole = stem + ".vti";
    if (layers.ranks() > 1) {
      whole = stem + ".pvti";
      write_index(folder_ / whole, grid_, world_, stem);
    }
    index_.add(time, whole);
  });
}

}  // namespace demvof
