// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <mpi.h>
#include <vtkDoubleArray.h>
#include <vtkNew.h>
#include <vtkSmartPointer.h>

#include <filesystem>
#include <stdexcept>
#include <string>
#include <vector>

#include "coupler/base/vec3.hpp"
#include "coupler/output/write_file.hpp"

// What the series of vtk_series.hpp share; only their .cpp files include this.

namespace demvof::vtk_file {

inline int rank_of(MPI_Comm world) {
  int rank;
  MPI_Comm_rank(world, &rank);
  return rank;
}

inline int size_of(MPI_Comm world) {
  int size;
  MPI_Comm_size(world, &size);
  return size;
}

/// Runs the action on this rank; throws std::runtime_error on all ranks when it threw on any.
template <class Action>
void on_all_ranks(MPI_Comm world, const std::filesystem::path& what, Action action) {
  std::string error;
  try {
    action();
  } catch (const std::exception& e) {
    error = e.what();
  }
  const int failed = error.empty() ? 0 : 1;
  int any = 0;
  MPI_Allreduce(&failed, &any, 1, MPI_INT, MPI_MAX, world);
  if (any) throw std::runtime_error(error.empty() ? what.string() + ": failed on another rank" : error);
}

/// Makes the folder of a series on rank 0, free of an earlier run's files but for its first frames.
/// Collective; kept: how many frames stay, on rank 0; returned on all ranks.
int prepare_folder(MPI_Comm world, const std::filesystem::path& folder, const std::string& series, int kept);

vtkSmartPointer<vtkDoubleArray> array(const char* name, const std::vector<double>& values);
vtkSmartPointer<vtkDoubleArray> array(const char* name, const std::vector<Vec3>& values);

/// Writes data with one of VTK's XML writers, complete or not at all. VTK writes to memory, and what it made
/// goes to the file from there: its own file streams keep silent about a disk that is full.
template <class Writer, class Data>
void write(const std::filesystem::path& path, Data* data) {
  vtkNew<Writer> writer;
  writer->WriteToOutputStringOn();
  writer->SetInputData(data);
  writer->SetDataModeToAppended();
  writer->EncodeAppendedDataOff();
  if (writer->Write() != 1) throw std::runtime_error("cannot write " + path.string());
  write_file_atomically(path, writer->GetOutputString());
}

/// What a rank's file of a frame is called: STEM.ENDING on one rank, STEM_RANK.ENDING on several.
std::string piece_name(MPI_Comm world, const std::string& stem, const std::string& ending, int rank);

/// The attributes of all ranks' files of a frame, for write_pieces.
std::vector<std::string> pieces_of_ranks(MPI_Comm world, const std::string& stem, const std::string& ending);

/// Writes the file that shows pieces as one (VTK's parallel writers need VTK's own MPI layer). Each piece:
/// its attributes in XML, as Source="FILE".
void write_pieces(const std::filesystem::path& path, const std::string& type, const std::string& attributes,
                  const std::string& arrays, const std::vector<std::string>& pieces);
/// For `arrays`: one array of 64-bit floating-point numbers as every piece has it; components: 1 or 3.
std::string declared_array(const std::string& name, int components);

}  // namespace demvof::vtk_file
