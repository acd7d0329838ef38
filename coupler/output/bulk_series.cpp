// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>
#include <vtkCellData.h>
#include <vtkImageData.h>
#include <vtkUnsignedCharArray.h>
#include <vtkXMLImageDataWriter.h>

#include "coupler/output/vtk_file.hpp"
#include "coupler/output/vtk_series.hpp"

namespace fs = std::filesystem;

namespace demvof {

namespace {

/// All active cells on rank 0, in rank order; empty elsewhere.
CellValues<BulkFrame> gather_to_root(MPI_Comm world, const CellValues<BulkFrame>& mine) {
  const int ranks = vtk_file::rank_of(world) == 0 ? vtk_file::size_of(world) : 0;
  constexpr int width = row_width<BulkFrame>();
  const int count = static_cast<int>(mine.cells.size());
  std::vector<int> counts(static_cast<std::size_t>(ranks)), starts(counts.size());
  MPI_Gather(&count, 1, MPI_INT, counts.data(), 1, MPI_INT, 0, world);
  CellValues<BulkFrame> all;
  int total = 0;
  for (std::size_t r = 0; r < counts.size(); ++r) {
    starts[r] = total;
    total += counts[r];
  }
  all.cells.resize(static_cast<std::size_t>(total));
  all.values.resize(static_cast<std::size_t>(total));
  MPI_Gatherv(mine.cells.data(), count, MPI_INT64_T, all.cells.data(), counts.data(), starts.data(),
              MPI_INT64_T, 0, world);
  MPI_Datatype row;
  MPI_Type_contiguous(width, MPI_DOUBLE, &row);
  MPI_Type_commit(&row);
  MPI_Gatherv(mine.values.data(), count, row, all.values.data(), counts.data(), starts.data(), row, 0, world);
  MPI_Type_free(&row);
  return all;
}

void write_bulk(const fs::path& path, const BulkGrid& grid, const CellValues<BulkFrame>& active) {
  const auto cells = static_cast<std::size_t>(grid.cell_count());
  std::vector<BulkFrame> frames(cells);
  vtkNew<vtkUnsignedCharArray> is_active;
  is_active->SetName("active");
  is_active->SetNumberOfTuples(grid.cell_count());
  is_active->FillValue(0);
  for (std::size_t i = 0; i < active.cells.size(); ++i) {
    frames[static_cast<std::size_t>(active.cells[i])] = active.values[i];
    is_active->SetValue(active.cells[i], 1);
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
  image->SetDimensions(grid.cells()[0] + 1, grid.cells()[1] + 1, grid.cells()[2] + 1);
  image->SetOrigin(grid.lower().x, grid.lower().y, grid.lower().z);
  image->SetSpacing(grid.spacing().x, grid.spacing().y, grid.spacing().z);
  image->GetCellData()->AddArray(is_active);
  image->GetCellData()->AddArray(vtk_file::array("void_fraction", void_fraction));
  image->GetCellData()->AddArray(vtk_file::array("fluid_velocity", velocity));
  image->GetCellData()->AddArray(vtk_file::array("pressure_gradient", gradient));
  image->GetCellData()->AddArray(vtk_file::array("drag", drag));
  vtk_file::write<vtkXMLImageDataWriter>(path, image.Get());
}

}  // namespace

BulkSeries::BulkSeries(MPI_Comm world, BulkGrid grid, const fs::path& folder,
                       std::optional<double> continued_from, const std::string& name)
    : VtkSeries(world, folder, name, continued_from), grid_(std::move(grid)) {}

void BulkSeries::write(double time, const CellValues<BulkFrame>& active) {
  const std::string file = fmt::format("{}_{:06}.vti", name_, count_++);
  const CellValues<BulkFrame> all = gather_to_root(world_, active);
  vtk_file::on_all_ranks(world_, folder_, [&] {
    if (vtk_file::rank_of(world_) != 0) return;
    write_bulk(folder_ / file, grid_, all);
    index_.add(time, file);
  });
}

}  // namespace demvof
