// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>
#include <vtkCellData.h>
#include <vtkImageData.h>
#include <vtkUnsignedCharArray.h>
#include <vtkXMLImageDataWriter.h>

#include "coupler/grid/bulk_partition.hpp"
#include "coupler/output/vtk_file.hpp"
#include "coupler/output/vtk_series.hpp"

namespace fs = std::filesystem;

namespace demvof {

namespace {

/// Of dem_side, as in Link.
BulkPartition owners_of(MPI_Comm world, const BulkGrid& grid) {
  return {grid.cells(), vtk_file::size_of(world), RankOrder::z_fastest};
}

std::string extent(const CellRange& cells) {
  const auto &begin = cells.begin, &end = cells.end;
  return fmt::format("\"{} {} {} {} {} {}\"", begin[0], end[0], begin[1], end[1], begin[2], end[2]);
}

/// The piece of the grid that a rank owns.
void write_block(const fs::path& path, const BulkGrid& grid, const BulkPartition& owners, int rank,
                 const CellValues<BulkFrame>& active) {
  const CellRange block = owners.block(rank);
  const auto cells = static_cast<std::size_t>(block.size());
  std::vector<BulkFrame> frames(cells);
  vtkNew<vtkUnsignedCharArray> is_active;
  is_active->SetName("active");
  is_active->SetNumberOfTuples(static_cast<vtkIdType>(cells));
  is_active->FillValue(0);
  for (std::size_t i = 0; i < active.cells.size(); ++i) {
    const CellId place = owners.place(active.cells[i]);
    frames[static_cast<std::size_t>(place)] = active.values[i];
    is_active->SetValue(place, 1);
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
  image->SetExtent(block.begin[0], block.end[0], block.begin[1], block.end[1], block.begin[2], block.end[2]);
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
  const BulkPartition owners = owners_of(world, grid);
  std::vector<std::string> pieces;
  for (int rank = 0; rank < owners.owners(); ++rank)
    pieces.push_back(fmt::format("Extent={} Source=\"{}\"", extent(owners.block(rank)),
                                 vtk_file::piece_name(world, stem, "vti", rank)));
  const Vec3 &origin = grid.lower(), &spacing = grid.spacing();
  vtk_file::write_pieces(
      path, "PImageData",
      fmt::format(" WholeExtent={} Origin=\"{} {} {}\" Spacing=\"{} {} {}\"", extent({{}, grid.cells()}),
                  origin.x, origin.y, origin.z, spacing.x, spacing.y, spacing.z),
      arrays, pieces);
}

}  // namespace

BulkSeries::BulkSeries(MPI_Comm world, BulkGrid grid, const fs::path& folder,
                       std::optional<double> continued_from, const std::string& name)
    : VtkSeries(world, folder, name, continued_from), grid_(std::move(grid)) {}

void BulkSeries::write(double time, const CellValues<BulkFrame>& active) {
  const std::string stem = fmt::format("{}_{:06}", name_, count_++);
  const BulkPartition owners = owners_of(world_, grid_);
  vtk_file::on_all_ranks(world_, folder_, [&] {
    const int rank = vtk_file::rank_of(world_);
    if (rank < owners.owners())
      write_block(folder_ / vtk_file::piece_name(world_, stem, "vti", rank), grid_, owners, rank, active);
  });
  vtk_file::on_all_ranks(world_, folder_, [&] {
    if (vtk_file::rank_of(world_) != 0) return;
    std::string whole = stem + ".vti";
    if (owners.ranks() > 1) {
      whole = stem + ".pvti";
      write_index(folder_ / whole, grid_, world_, stem);
    }
    index_.add(time, whole);
  });
}

}  // namespace demvof
