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

/// The file that shows several pieces as one (VTK's parallel writer needs VTK's own MPI layer).
void write_pieces_index(const fs::path& path, const std::vector<std::string>& pieces) {
  std::string text =
      "<?xml version=\"1.0\"?>\n<VTKFile type=\"PPolyData\" version=\"0.1\">\n"
      "<PPolyData GhostLevel=\"0\">\n<PPointData>\n"
      "<PDataArray type=\"Int64\" Name=\"id\"/>\n<PDataArray type=\"Float64\" Name=\"radius\"/>\n";
  for (const auto& [name, values] : named_vectors(ParticleFrame{}))
    text += fmt::format("<PDataArray type=\"Float64\" Name=\"{}\" NumberOfComponents=\"3\"/>\n", name);
  text += "</PPointData>\n<PPoints>\n<PDataArray type=\"Float64\" NumberOfComponents=\"3\"/>\n</PPoints>\n";
  for (const std::string& piece : pieces) text += fmt::format("<Piece Source=\"{}\"/>\n", piece);
  write_file_atomically(path, text + "</PPolyData>\n</VTKFile>\n");
}

}  // namespace

ParticleSeries::ParticleSeries(MPI_Comm world, const fs::path& folder, std::optional<double> continued_from,
                               const std::string& name)
    : VtkSeries(world, folder, name, continued_from) {}

void ParticleSeries::write(double time, const ParticleFrame& frame) {
  const int my_rank = vtk_file::rank_of(world_), ranks = vtk_file::size_of(world_);
  const std::string stem = fmt::format("{}_{:06}", name_, count_++);
  const auto piece = [&](int rank) {
    return ranks == 1 ? stem + ".vtp" : fmt::format("{}_{}.vtp", stem, rank);
  };
  vtk_file::on_all_ranks(world_, folder_, [&] {
    check_lengths(frame);
    write_piece(folder_ / piece(my_rank), frame);
  });
  vtk_file::on_all_ranks(world_, folder_, [&] {
    if (my_rank != 0) return;
    std::string whole = piece(0);
    if (ranks > 1) {
      std::vector<std::string> pieces;
      for (int rank = 0; rank < ranks; ++rank) pieces.push_back(piece(rank));
      whole = stem + ".pvtp";
      write_pieces_index(folder_ / whole, pieces);
    }
    index_.add(time, whole);
  });
}

}  // namespace demvof
