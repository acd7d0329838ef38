// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>
#include <vtkCellArray.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkXMLPolyDataWriter.h>

#include <algorithm>

#include "coupler/output/vtk_file.hpp"
#include "coupler/output/vtk_series.hpp"

namespace fs = std::filesystem;

namespace demvof {
namespace {

void write_triangles(const fs::path& path, const std::vector<Vec3>& corners) {
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  vtkNew<vtkCellArray> triangles;
  for (const Vec3& corner : corners) {
    const vtkIdType i = points->InsertNextPoint(corner.x, corner.y, corner.z);
    if (i % 3 == 2) triangles->InsertNextCell({i - 2, i - 1, i});
  }
  vtkNew<vtkPolyData> data;
  data->SetPoints(points);
  data->SetPolys(triangles);
  vtk_file::write<vtkXMLPolyDataWriter>(path, data.Get());
}

void write_index(const fs::path& path, MPI_Comm world, const std::string& stem) {
  vtk_file::write_pieces(path, "PPolyData", "",
                         "<PPoints>\n" + vtk_file::declared_array("Points", 3) + "</PPoints>\n",
                         vtk_file::pieces_of_ranks(world, stem, "vtp"));
}

bool same(const std::vector<Vec3>& some, const std::vector<Vec3>& others) {
  return std::equal(some.begin(), some.end(), others.begin(), others.end(),
                    [](const Vec3& a, const Vec3& b) { return a.x == b.x && a.y == b.y && a.z == b.z; });
}

}  // namespace

SurfaceSeries::SurfaceSeries(MPI_Comm world, const fs::path& folder, std::optional<double> continued_from,
                             const std::string& name)
    : VtkSeries(world, folder, name, continued_from) {}

void SurfaceSeries::write(double time, const std::vector<Vec3>& corners) {
  const std::string stem = fmt::format("{}_{:06}", name_, count_++);
  int moved = file_.empty() || !same(corners, written_);
  MPI_Allreduce(MPI_IN_PLACE, &moved, 1, MPI_INT, MPI_MAX, world_);
  if (moved) {
    vtk_file::on_all_ranks(world_, folder_, [&] {
      write_triangles(folder_ / vtk_file::piece_name(world_, stem, "vtp", vtk_file::rank_of(world_)),
                      corners);
    });
    written_ = corners;
    file_ = stem + (vtk_file::size_of(world_) > 1 ? ".pvtp" : ".vtp");
  }
  vtk_file::on_all_ranks(world_, folder_, [&] {
    if (vtk_file::rank_of(world_) != 0) return;
    if (moved && vtk_file::size_of(world_) > 1) write_index(folder_ / file_, world_, stem);
    index_.add(time, file_);
  });
}

}  // namespace demvof
