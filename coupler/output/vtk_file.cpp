// SPDX-License-Identifier: GPL-3.0-or-later
#include "coupler/output/vtk_file.hpp"

#include <fmt/format.h>

#include <cstdlib>
#include <fstream>
#include <regex>

#include "coupler/output/vtk_series.hpp"

namespace fs = std::filesystem;

namespace demvof {

namespace vtk_file {

int prepare_folder(MPI_Comm world, const fs::path& folder, const std::string& series, int kept) {
  on_all_ranks(world, folder, [&] {
    if (rank_of(world) != 0) return;
    fs::create_directories(folder);
    const std::string begin = series + "_";
    for (const fs::directory_entry& entry : fs::directory_iterator(folder)) {
      const std::string file = entry.path().filename().string();
      if (file.rfind(begin, 0) != 0) continue;
      if (std::atoi(file.c_str() + begin.size()) >= kept) fs::remove(entry.path());
    }
  });
  MPI_Bcast(&kept, 1, MPI_INT, 0, world);
  return kept;
}

vtkSmartPointer<vtkDoubleArray> array(const char* name, const std::vector<double>& values) {
  auto result = vtkSmartPointer<vtkDoubleArray>::New();
  result->SetName(name);
  result->SetNumberOfTuples(static_cast<vtkIdType>(values.size()));
  for (std::size_t i = 0; i < values.size(); ++i) result->SetValue(static_cast<vtkIdType>(i), values[i]);
  return result;
}

vtkSmartPointer<vtkDoubleArray> array(const char* name, const std::vector<Vec3>& values) {
  auto result = vtkSmartPointer<vtkDoubleArray>::New();
  result->SetName(name);
  result->SetNumberOfComponents(3);
  result->SetNumberOfTuples(static_cast<vtkIdType>(values.size()));
  for (std::size_t i = 0; i < values.size(); ++i)
    result->SetTuple3(static_cast<vtkIdType>(i), values[i].x, values[i].y, values[i].z);
  return result;
}

std::string piece_name(MPI_Comm world, const std::string& stem, const std::string& ending, int rank) {
  return size_of(world) == 1 ? fmt::format("{}.{}", stem, ending)
                             : fmt::format("{}_{}.{}", stem, rank, ending);
}

std::vector<std::string> pieces_of_ranks(MPI_Comm world, const std::string& stem, const std::string& ending) {
  std::vector<std::string> pieces;
  for (int rank = 0; rank < size_of(world); ++rank)
    pieces.push_back(fmt::format("Source=\"{}\"", piece_name(world, stem, ending, rank)));
  return pieces;
}

void write_pieces(const fs::path& path, const std::string& type, const std::string& attributes,
                  const std::string& arrays, const std::vector<std::string>& pieces) {
  std::string text = fmt::format(
      "<?xml version=\"1.0\"?>\n<VTKFile type=\"{0}\" version=\"0.1\">\n<{0} GhostLevel=\"0\"{1}>\n{2}", type,
      attributes, arrays);
  for (const std::string& piece : pieces) text += fmt::format("<Piece {}/>\n", piece);
  write_file_atomically(path, text + fmt::format("</{}>\n</VTKFile>\n", type));
}

std::string declared_array(const std::string& name, int components) {
  return fmt::format("<PDataArray type=\"Float64\" Name=\"{}\" NumberOfComponents=\"{}\"/>\n", name,
                     components);
}

}  // namespace vtk_file

VtkSeries::VtkSeries(MPI_Comm world, const fs::path& folder, const std::string& name,
                     std::optional<double> continued_from)
    : world_(world),
      name_(name),
      folder_(folder / name),
      index_(folder_ / (name + ".pvd"), continued_from),
      count_(vtk_file::prepare_folder(world_, folder_, name_, index_.size())) {}

PvdIndex::PvdIndex(fs::path path, std::optional<double> continued_from) : path_(std::move(path)) {
  if (!continued_from) return;
  const double last = *continued_from * (1 + 1e-9);
  static const std::regex entry("timestep=\"([^\"]+)\" file=\"([^\"]+)\"");
  std::ifstream lines(path_);
  std::smatch found;
  for (std::string line; std::getline(lines, line);)
    if (std::regex_search(line, found, entry) && std::stod(found[1]) <= last)
      entries_.emplace_back(std::stod(found[1]), found[2]);
}

void PvdIndex::add(double time, const std::string& file) {
  entries_.emplace_back(time, file);
  std::string text = "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"0.1\">\n<Collection>\n";
  for (const auto& [t, name] : entries_)
    text += fmt::format("<DataSet timestep=\"{}\" file=\"{}\"/>\n", t, name);
  write_file_atomically(path_, text + "</Collection>\n</VTKFile>\n");
}

}  // namespace demvof
