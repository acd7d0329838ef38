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

/// All corners on rank 0, in rank order; empty elsewhere.
std::vector<Vec3> gather_to_root(MPI_Comm world, const std::vector<Vec3>& mine) {
  static_assert(sizeof(Vec3) == 3 * sizeof(double));
  const int count = 3 * static_cast<int>(mine.size());
  std::vector<int> counts(static_cast<std::size_t>(vtk_file::size_of(world))), starts(counts.size());
  MPI_Gather(&count, 1, MPI_INT, counts.data(), 1, MPI_INT, 0, world);
  int total = 0;
  for (std::size_t r = 0; r < counts.size(); ++r) {
    starts[r] = total;
    total += counts[r];
  }
  std::vector<Vec3> all(vtk_file::rank_of(world) == 0 ? static_cast<std::size_t>(total) / 3 : 0);
  MPI_Gatherv(mine.data(), count, MPI_DOUBLE, all.data(), counts.data(), starts.data(), MPI_DOUBLE, 0, world);
  return all;
}

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

bool same(const std::vector<Vec3>& some, const std::vector<Vec3>& others) {
  return std::equal(some.begin(), some.end(), others.begin(), others.end(),
                    [](const Vec3& a, const Vec3& b) { return a.x == b.x && a.y == b.y && a.z == b.z; });
}

}  // namespace

SurfaceSeries::SurfaceSeries(MPI_Comm world, const fs::path& folder, std::optional<double> continued_from,
                             const std::string& name)
    : VtkSeries(world, folder, name, continued_from) {}

void SurfaceSeries::write(double time, const std::vector<Vec3>& corners) {
  const std::string file = fmt::format("{}_{:06}.vtp", name_, count_++);
  const std::vector<Vec3> all = gather_to_root(world_, corners);
  vtk_file::on_all_ranks(world_, folder_, [&] {
    if (vtk_file::rank_of(world_) != 0) return;
    if (file_.empty() || !same(all, written_)) {
      write_triangles(folder_ / file, all);
      written_ = all;
      file_ = file;
    }
    index_.add(time, file_);
  });
}

}  // namespace demvof
