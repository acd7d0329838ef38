// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>
#include <vtkCellArray.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkTypeInt64Array.h>
#include <vtkXMLPolyDataWriter.h>

#include "coupler/output/vtk_file.hpp"
#include "coupler/output/vtk_series.hpp"

namespace fs = std::filesystem;

namespace demvof {

namespace {

// The vector members of a frame under the names that the files carry; the index over several
// pieces declares the same ones.
struct NamedVectors {
  const char* name;
  const std::vector<Vec3>& values;
};
std::vector<NamedVectors> named_vectors(const ParticleFrame& frame) {
  return {{"velocity", frame.velocity},
          {"spin", frame.spin},
          {"drag_force", frame.drag_force},
          {"pressure_force", frame.pressure_force},
          {"contact_force", frame.contact_force}};
}

void check_lengths(const ParticleFrame& frame) {
  const std::size_t count = frame.position.size();
  bool good = frame.id.size() == count && frame.radius.size() == count;
  for (const auto& [name, values] : named_vectors(frame)) good = good && values.size() == count;
  if (!good) throw std::invalid_argument("particle output: every member needs one value per particle");
}

void write_piece(const fs::path& path, const ParticleFrame& frame) {
  const auto count = static_cast<vtkIdType>(frame.position.size());
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  points->SetNumberOfPoints(count);
  vtkNew<vtkCellArray> vertices;
  vtkNew<vtkTypeInt64Array> ids;
  ids->SetName("id");
  ids->SetNumberOfTuples(count);
  for (vtkIdType i = 0; i < count; ++i) {
    const auto n = static_cast<std::size_t>(i);
    points->SetPoint(i, frame.position[n].x, frame.position[n].y, frame.position[n].z);
    vertices->InsertNextCell(1, &i);
    ids->SetValue(i, frame.id[n]);
  }
  vtkNew<vtkPolyData> data;
  data->SetPoints(points);
  data->SetVerts(vertices);
  data->GetPointData()->AddArray(ids);
  data->GetPointData()->AddArray(vtk_file::array("radius", frame.radius));
  for (const auto& [name, values] : named_vectors(frame))
    data->GetPointData()->AddArray(vtk_file::array(name, values));
  vtk_file::write<vtkXMLPolyDataWriter>(path, data.Get());
}

void write_index(const fs::path& path, MPI_Comm world, const std::string& stem) {
  std::string arrays = "<PPointData>\n<PDataArray type=\"Int64\" Name=\"id\"/>\n";
  arrays += vtk_file::declared_array("radius", 1);
  for (const auto& [name, values] : named_vectors(ParticleFrame{}))
    arrays += vtk_file::declared_array(name, 3);
  arrays += "</PPointData>\n<PPoints>\n" + vtk_file::declared_array("Points", 3) + "</PPoints>\n";
  vtk_file::write_pieces(path, "PPolyData", "", arrays, vtk_file::pieces_of_ranks(world, stem, "vtp"));
}

}  // namespace

ParticleSeries::ParticleSeries(MPI_Comm world, const fs::path& folder, std::optional<double> continued_from,
                               const std::string& name)
    : VtkSeries(world, folder, name, continued_from) {}

void ParticleSeries::write(double time, const ParticleFrame& frame) {
  const std::string stem = fmt::format("{}_{:06}", name_, count_++);
  vtk_file::on_all_ranks(world_, folder_, [&] {
    check_lengths(frame);
    write_piece(folder_ / vtk_file::piece_name(world_, stem, "vtp", vtk_file::rank_of(world_)), frame);
  });
  vtk_file::on_all_ranks(world_, folder_, [&] {
    if (vtk_file::rank_of(world_) != 0) return;
    std::string whole = stem + ".vtp";
    if (vtk_file::size_of(world_) > 1) {
      whole = stem + ".pvtp";
      write_index(folder_ / whole, world_, stem);
    }
    index_.add(time, whole);
  });
}

}  // namespace demvof
