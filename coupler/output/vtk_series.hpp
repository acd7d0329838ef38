// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <mpi.h>

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "coupler/base/vec3.hpp"
#include "coupler/grid/bulk_cells.hpp"
#include "coupler/grid/bulk_grid.hpp"

// Time series that ParaView opens: <folder>/<name>/<name>_<number>.vtp or .vti, and
// <name>.pvd beside them, which lists them with their times and is replaced in one step at each
// output, so that it is valid at any moment of a run.
//
// continued_from: time from which an earlier run is continued, s; its frames up to then stay. Without it
// what an earlier run left in the series' folder is removed.

namespace demvof {

/// The .pvd file of a series.
class PvdIndex {
 public:
  /// continued_from: entries of the file that is there are kept up to this time.
  explicit PvdIndex(std::filesystem::path path, std::optional<double> continued_from = {});
  int size() const { return static_cast<int>(entries_.size()); }
  /// file: relative to the index. Throws std::runtime_error when the index cannot be written.
  void add(double time, const std::string& file);

 private:
  std::filesystem::path path_;
  std::vector<std::pair<double, std::string>> entries_;
};

/// What all series have: folder, list of frames, number of the next one.
class VtkSeries {
 protected:
  /// Collective over world. The series' folder, named like it, lies in the given one.
  VtkSeries(MPI_Comm world, const std::filesystem::path& folder, const std::string& name,
            std::optional<double> continued_from);

  MPI_Comm world_;
  std::string name_;
  std::filesystem::path folder_;
  PvdIndex index_;
  int count_;
};

/// The particles of one rank; every member has one value per particle.
struct ParticleFrame {
  std::vector<std::int64_t> id;
  std::vector<Vec3> position;        // m
  std::vector<Vec3> velocity;        // m/s
  std::vector<Vec3> spin;            // rad/s
  std::vector<double> radius;        // m
  std::vector<Vec3> drag_force;      // N
  std::vector<Vec3> pressure_force;  // N
  std::vector<Vec3> contact_force;   // N
};

/// particles/: one .vtp piece per rank, with a .pvtp over the pieces when there are several.
class ParticleSeries : VtkSeries {
 public:
  /// Collective over world.
  ParticleSeries(MPI_Comm world, const std::filesystem::path& folder,
                 std::optional<double> continued_from = {}, const std::string& name = "particles");
  /// Collective. Throws std::runtime_error on all ranks when members differ in length or a file
  /// cannot be written on any.
  void write(double time, const ParticleFrame& frame);
};

/// surfaces/: the triangles of walls, one .vtp piece per rank and a .pvtp over several; a frame in which none
/// has moved shares the files of the one before.
class SurfaceSeries : VtkSeries {
 public:
  /// Collective over world.
  SurfaceSeries(MPI_Comm world, const std::filesystem::path& folder,
                std::optional<double> continued_from = {}, const std::string& name = "surfaces");
  /// Collective; corners: three for each triangle that this rank owns, m. Throws std::runtime_error on all
  /// ranks when a file cannot be written.
  void write(double time, const std::vector<Vec3>& corners);

 private:
  std::vector<Vec3> written_;  // what this rank's last file has
  std::string file_;           // the last one of all ranks
};

/// What is shown of one bulk cell.
struct BulkFrame {
  double void_fraction = 1;  // -
  Vec3 fluid_velocity;       // m/s
  Vec3 pressure_gradient;    // Pa/m
  Vec3 drag;                 // force of the particles on the fluid per volume, N/m3
};

/// bulk/: the bulk grid as .vti with cell data, on several ranks each owner's block, with a .pvti over them;
/// cells that the run does not average are marked by active = 0 and carry the defaults of BulkFrame.
class BulkSeries : VtkSeries {
 public:
  /// Collective over world.
  BulkSeries(MPI_Comm world, BulkGrid grid, const std::filesystem::path& folder,
             std::optional<double> continued_from = {}, const std::string& name = "bulk");
  /// Collective; active: the averaged cells that this rank owns. Throws std::runtime_error on all ranks when
  /// the file cannot be written.
  void write(double time, const CellValues<BulkFrame>& active);

 private:
  BulkGrid grid_;
};

}  // namespace demvof
