// SPDX-License-Identifier: GPL-3.0-or-later
// The series that ParaView opens, written by one to three ranks and read back with VTK.
#include "coupler/output/vtk_series.hpp"

#include <gtest/gtest.h>
#include <mpi.h>
#include <vtkCell.h>
#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkXMLImageDataReader.h>
#include <vtkXMLPImageDataReader.h>
#include <vtkXMLPPolyDataReader.h>
#include <vtkXMLPolyDataReader.h>

#include <fstream>
#include <map>
#include <sstream>

#include "coupler/grid/bulk_partition.hpp"

namespace fs = std::filesystem;

namespace demvof {
namespace {

int rank_, ranks_;

/// A fresh folder that all ranks agree on.
fs::path folder(const std::string& name) {
  const fs::path path = fs::path("vtk_series_" + std::to_string(ranks_)) / name;
  if (rank_ == 0) {
    fs::remove_all(path);
    fs::create_directories(path);
  }
  MPI_Barrier(MPI_COMM_WORLD);
  return path;
}

std::string text_of(const fs::path& path) {
  std::ostringstream text;
  text << std::ifstream(path).rdbuf();
  return text.str();
}

// Values that differ in every component, so that no mix-up goes unseen.
Vec3 vector_of(std::int64_t id, double member) {
  return {id + 0.1 * member, -2.0 * id, member};
}

/// Particle ids rank, rank + ranks, ...: 10 in all; the last rank has none when there are three.
ParticleFrame frame_of_this_rank() {
  const int holders = ranks_ == 3 ? 2 : ranks_;
  ParticleFrame frame;
  for (std::int64_t id = rank_; id < 10 && rank_ < holders; id += holders) {
    frame.id.push_back(id);
    frame.position.push_back(vector_of(id, 1));
    frame.velocity.push_back(vector_of(id, 2));
    frame.spin.push_back(vector_of(id, 6));
    frame.radius.push_back(1e-3 * (id + 1));
    frame.drag_force.push_back(vector_of(id, 3));
    frame.pressure_force.push_back(vector_of(id, 4));
    frame.contact_force.push_back(vector_of(id, 5));
  }
  return frame;
}

vtkSmartPointer<vtkPolyData> read_particles(const fs::path& path) {
  vtkSmartPointer<vtkXMLReader> reader;
  if (path.extension() == ".pvtp")
    reader = vtkSmartPointer<vtkXMLPPolyDataReader>::New();
  else
    reader = vtkSmartPointer<vtkXMLPolyDataReader>::New();
  reader->SetFileName(path.c_str());
  reader->Update();
  return vtkPolyData::SafeDownCast(reader->GetOutputAsDataSet());
}

void expect_tuple(vtkDataArray* array, vtkIdType i, const Vec3& expected) {
  ASSERT_TRUE(array);
  for (int axis = 0; axis < 3; ++axis) EXPECT_EQ(array->GetComponent(i, axis), expected[axis]);
}

TEST(ParticleSeries, EveryParticleReadsBackOnce) {
  const fs::path out = folder("particles_read_back");
  ParticleSeries series(MPI_COMM_WORLD, out);
  series.write(0.25, frame_of_this_rank());
  MPI_Barrier(MPI_COMM_WORLD);
  const auto data =
      read_particles(out / "particles" / (ranks_ == 1 ? "particles_000000.vtp" : "particles_000000.pvtp"));
  ASSERT_TRUE(data);
  ASSERT_EQ(data->GetNumberOfPoints(), 10);
  EXPECT_EQ(data->GetNumberOfVerts(), 10);  // without them ParaView shows nothing
  vtkPointData* arrays = data->GetPointData();
  std::map<std::int64_t, int> seen;
  for (vtkIdType i = 0; i < 10; ++i) {
    const auto id = static_cast<std::int64_t>(arrays->GetArray("id")->GetComponent(i, 0));
    ++seen[id];
    EXPECT_EQ(arrays->GetArray("radius")->GetComponent(i, 0), 1e-3 * (id + 1));
    expect_tuple(arrays->GetArray("velocity"), i, vector_of(id, 2));
    expect_tuple(arrays->GetArray("spin"), i, vector_of(id, 6));
    expect_tuple(arrays->GetArray("drag_force"), i, vector_of(id, 3));
    expect_tuple(arrays->GetArray("pressure_force"), i, vector_of(id, 4));
    expect_tuple(arrays->GetArray("contact_force"), i, vector_of(id, 5));
    double position[3];
    data->GetPoint(i, position);
    for (int axis = 0; axis < 3; ++axis) EXPECT_EQ(position[axis], vector_of(id, 1)[axis]);
  }
  EXPECT_EQ(seen.size(), 10u);
}

TEST(ParticleSeries, TheIndexListsEveryOutputWithItsTime) {
  const fs::path out = folder("particles_index");
  ParticleSeries series(MPI_COMM_WORLD, out);
  for (const double time : {0.0, 0.02, 0.04}) {
    series.write(time, frame_of_this_rank());
    MPI_Barrier(MPI_COMM_WORLD);
  }
  const std::string index = text_of(out / "particles" / "particles.pvd");
  const std::string kind = ranks_ == 1 ? ".vtp" : ".pvtp";
  for (const auto& [time, number] : {std::pair{"0", "000000"}, {"0.02", "000001"}, {"0.04", "000002"}}) {
    const std::string file = std::string("particles_") + number + kind;
    EXPECT_NE(index.find(std::string("timestep=\"") + time + "\" file=\"" + file + "\""), std::string::npos)
        << index;
    EXPECT_TRUE(fs::exists(out / "particles" / file));
  }
}

TEST(ParticleSeries, AnEarlierRunLeavesNothing) {
  const fs::path out = folder("particles_again");
  {
    ParticleSeries series(MPI_COMM_WORLD, out);
    for (int n = 0; n < 3; ++n) series.write(n, frame_of_this_rank());
  }
  ParticleSeries series(MPI_COMM_WORLD, out);
  series.write(0, frame_of_this_rank());
  MPI_Barrier(MPI_COMM_WORLD);
  const auto files = std::distance(fs::directory_iterator(out / "particles"), fs::directory_iterator());
  EXPECT_EQ(files, ranks_ == 1 ? 2 : ranks_ + 2);  // pieces, the file over them, the index
}

TEST(ParticleSeries, ARunThatGoesOnKeepsItsFramesUpToThen) {
  const fs::path out = folder("particles_continued");
  {
    ParticleSeries series(MPI_COMM_WORLD, out);
    for (int n = 0; n < 5; ++n) series.write(0.1 * n, frame_of_this_rank());
  }
  MPI_Barrier(MPI_COMM_WORLD);
  ParticleSeries series(MPI_COMM_WORLD, out, 0.1 * 2);
  series.write(0.25, frame_of_this_rank());
  MPI_Barrier(MPI_COMM_WORLD);
  const std::string index = text_of(out / "particles" / "particles.pvd");
  EXPECT_NE(index.find("timestep=\"0.2\" file=\"particles_000002"), std::string::npos) << index;
  EXPECT_NE(index.find("timestep=\"0.25\" file=\"particles_000003"), std::string::npos) << index;
  EXPECT_EQ(index.find("particles_000004"), std::string::npos) << index;
  const auto files = std::distance(fs::directory_iterator(out / "particles"), fs::directory_iterator());
  EXPECT_EQ(files, 1 + 4 * (ranks_ == 1 ? 1 : ranks_ + 1));
}

TEST(ParticleSeries, AFrameThatIsOutOfStepIsAnErrorOnAllRanks) {
  ParticleSeries series(MPI_COMM_WORLD, folder("particles_broken"));
  ParticleFrame frame = frame_of_this_rank();
  if (rank_ == 0) frame.radius.pop_back();
  EXPECT_THROW(series.write(0, frame), std::runtime_error);
}

TEST(SurfaceSeries, TrianglesOfAllRanksReadBackAndOneFileServesWhileNoneMoves) {
  const fs::path out = folder("surfaces");
  SurfaceSeries series(MPI_COMM_WORLD, out);
  std::vector<Vec3> corners;  // rank r owns r triangles
  for (int i = 0; i < 3 * rank_; ++i) corners.push_back(vector_of(10 * rank_ + i, 1));
  series.write(0, corners);
  series.write(0.1, corners);
  for (Vec3& corner : corners) corner.z += 1;
  series.write(0.2, corners);
  MPI_Barrier(MPI_COMM_WORLD);
  const std::string index = text_of(out / "surfaces" / "surfaces.pvd");
  const std::string kind = ranks_ == 1 ? ".vtp" : ".pvtp";
  EXPECT_NE(index.find("timestep=\"0.1\" file=\"surfaces_000000" + kind + "\""), std::string::npos) << index;
  EXPECT_FALSE(fs::exists(out / "surfaces" / ("surfaces_000001" + kind)));
  const std::string moved = ranks_ == 1 ? "surfaces_000000.vtp" : "surfaces_000002.pvtp";
  EXPECT_NE(index.find("timestep=\"0.2\" file=\"" + moved + "\""), std::string::npos) << index;
  const auto data = read_particles(out / "surfaces" / moved);
  ASSERT_EQ(data->GetNumberOfPolys(), ranks_ * (ranks_ - 1) / 2);
  vtkIdType corner = 0;
  for (int rank = 1; rank < ranks_; ++rank)
    for (int i = 0; i < 3 * rank; ++i, ++corner)
      for (int axis = 0; axis < 3; ++axis)
        EXPECT_EQ(data->GetPoint(data->GetCell(corner / 3)->GetPointId(corner % 3))[axis],
                  (vector_of(10 * rank + i, 1) + Vec3{0, 0, 1})[axis]);
}

TEST(BulkSeries, CellsReadBackInTheirPlaces) {
  const fs::path out = folder("bulk_read_back");
  const BulkGrid grid({-0.1, 0, 0.5}, {0.3, 0.3, 0.7}, {4, 3, 2});
  const BulkPartition partition(grid.cells(), ranks_, RankOrder::z_fastest);
  const auto is_active = [](CellId cell) { return cell % 5 == 2; };  // no piece begins with one
  CellValues<BulkFrame> active;
  for (const CellId cell : partition.cells(rank_))
    if (is_active(cell)) {
      active.cells.push_back(cell);
      active.values.push_back(
          {0.4 + 0.01 * cell, vector_of(cell, 1), vector_of(cell, 2), vector_of(cell, 3)});
    }
  BulkSeries series(MPI_COMM_WORLD, grid, out);
  series.write(0.5, active);
  MPI_Barrier(MPI_COMM_WORLD);

  const std::string file = std::string("bulk_000000") + (ranks_ == 1 ? ".vti" : ".pvti");
  vtkSmartPointer<vtkXMLReader> reader;
  if (ranks_ == 1)
    reader = vtkSmartPointer<vtkXMLImageDataReader>::New();
  else
    reader = vtkSmartPointer<vtkXMLPImageDataReader>::New();
  reader->SetFileName((out / "bulk" / file).c_str());
  reader->Update();
  const auto image = vtkImageData::SafeDownCast(reader->GetOutputAsDataSet());
  ASSERT_EQ(image->GetNumberOfCells(), 24);
  vtkCellData* arrays = image->GetCellData();
  for (CellId cell = 0; cell < 24; ++cell) {
    // VTK's own idea of where the cell is.
    const Vec3 centre = grid.cell_centre(grid.ijk(cell));
    double point[3] = {centre.x, centre.y, centre.z}, local[3], weights[8];
    int sub;
    const vtkIdType found = image->FindCell(point, nullptr, 0, 1e-12, sub, local, weights);
    ASSERT_GE(found, 0);
    const bool here = is_active(cell);
    EXPECT_EQ(arrays->GetArray("active")->GetComponent(found, 0), here);
    EXPECT_EQ(arrays->GetArray("void_fraction")->GetComponent(found, 0), here ? 0.4 + 0.01 * cell : 1);
    expect_tuple(arrays->GetArray("fluid_velocity"), found, here ? vector_of(cell, 1) : Vec3{});
    expect_tuple(arrays->GetArray("pressure_gradient"), found, here ? vector_of(cell, 2) : Vec3{});
    expect_tuple(arrays->GetArray("drag"), found, here ? vector_of(cell, 3) : Vec3{});
  }
  EXPECT_NE(text_of(out / "bulk" / "bulk.pvd").find("timestep=\"0.5\" file=\"" + file + "\""),
            std::string::npos);
}

}  // namespace
}  // namespace demvof

int main(int argc, char** argv) {
  MPI_Init(&argc, &argv);
  MPI_Comm_rank(MPI_COMM_WORLD, &demvof::rank_);
  MPI_Comm_size(MPI_COMM_WORLD, &demvof::ranks_);
  testing::InitGoogleTest(&argc, argv);
  const int failed = RUN_ALL_TESTS();
  MPI_Finalize();
  return failed;
}
