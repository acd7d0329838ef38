// SPDX-License-Identifier: GPL-3.0-or-later
#include "coupler/output/vtk_file.hpp"

#include <fmt/format.h>

#include "coupler/output/vtk_series.hpp"

namespace fs = std::filesystem;

namespace demvof {

namespace vtk_file {

void prepare_folder(MPI_Comm world, const fs::path& folder, const std::string& series) {
  on_all_ranks(world, folder, [&] {
    if (rank_of(world) != 0) return;
    fs::create_directories(folder);
    for (const fs::directory_entry& entry : fs::directory_iterator(folder))
      if (entry.path().filename().string().rfind(series + "_", 0) == 0) fs::remove(entry.path());
  });
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

}  // namespace vtk_file

void PvdIndex::add(double time, const std::string& file) {
  entries_.emplace_back(time, file);
  std::string text = "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"0.1\">\n<Collection>\n";
  for (const auto& [t, name] : entries_)
    text += fmt::format("<DataSet timestep=\"{}\" file=\"{}\"/>\n", t, name);
  write_file_atomically(path_, text + "</Collection>\n</VTKFile>\n");
}

}  // namespace demvof
