// SPDX-License-Identifier: GPL-3.0-or-later
#include "foam_case.hpp"

#include <mpi.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <vector>

#include "foam_side/extras.hpp"

namespace demvof::test {

namespace files = std::filesystem;

FoamCase::FoamCase(const std::string& name, const Settings& settings, const std::string& cut)
    : folder_((files::current_path() / "foam_cases" / name).string()), parallel_(!cut.empty()) {
  int rank = 0;
  if (parallel_) MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  if (rank == 0) make(settings, cut);
  if (parallel_) MPI_Barrier(MPI_COMM_WORLD);
}

void FoamCase::make(const Settings& settings, const std::string& cut) const {
  files::remove_all(folder_);
  files::create_directories(folder_);
  files::copy(DEMVOF_FOAM_CASE, folder_, files::copy_options::recursive);
  std::ofstream out(folder_ + "/system/settings", std::ios::app);  // of two equal keys the last counts
  for (const auto& [key, value] : settings) out << key << ' ' << value << ";\n";
  out.close();
  run("blockMesh");
  if (cut.empty()) return;
  int ranks;
  MPI_Comm_size(MPI_COMM_WORLD, &ranks);
  std::ofstream(folder_ + "/system/decomposeParDict")
      << "FoamFile { version 2.0; format ascii; class dictionary; object decomposeParDict; }\n"
      << "numberOfSubdomains " << ranks << "; method simple; coeffs { n " << cut << "; }\n";
  run("decomposePar");
}

void FoamCase::run(const std::string& program) const {
  const std::string command =
      program + " -case '" + folder_ + "' > '" + folder_ + "/log." + program + "' 2>&1";
  if (std::system(command.c_str()) != 0) throw std::runtime_error("failed: " + command);
}

std::unique_ptr<Flow> FoamCase::open(const Scene& scene, const RefinementParameters* refinement) const {
  int rank = 0;
  if (parallel_) MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  if (refinement && rank == 0) {
    files::remove(folder_ + "/constant/dynamicMeshDict");
    write_mesh_dictionary(folder_, *refinement);
  }
  if (parallel_) MPI_Barrier(MPI_COMM_WORLD);
  Foam::messageStream::level = 0;
  std::string words[] = {"foam_flow_test", "-case", folder_, "-parallel"};
  char* pointers[] = {words[0].data(), words[1].data(), words[2].data(), words[3].data(), nullptr};
  char** argv = pointers;
  int argc = parallel_ ? 4 : 3;
  Foam::argList::noBanner();
  // Never destroyed: their destructors would end the process with exit code 0.
  static auto& kept = *new std::vector<const Foam::argList*>;
  kept.push_back(new Foam::argList(argc, argv));
  try {
    return open_flow(*kept.back(), scene, refinement);
  } catch (const Foam::error& error) {
    throw std::runtime_error(error.message());
  }
}

Scene scene(bool particles, bool porosity, bool surface_tension) {
  Scene plan;
  plan.particles = particles;
  plan.porosity = porosity;
  plan.surface_tension = surface_tension;
  return plan;
}

void do_step(Flow& flow) {
  if (extras(flow).motion == MeshMotion::never && refine_mesh(flow)) settle_flux(flow);
  update_porosity(flow);
  while (outer_corrector(flow)) {
    move_mesh(flow);
    advect_interface(flow);
    predict_momentum(flow);
    while (pressure_corrector(flow)) correct_pressure(flow);
  }
  end_step(flow);
}

void advance(Flow& flow, const std::function<void()>& after_step) {
  while (advance_clock(flow)) {
    do_step(flow);
    after_step();
  }
}

scalarField cell_values(const Flow& flow, const std::function<double(const vector&)>& value) {
  scalarField values(flow.mesh.nCells());
  forAll(values, cell) values[cell] = value(flow.mesh.C()[cell]);
  return values;
}

void set_alpha(Flow& flow, const std::function<double(const vector&)>& alpha) {
  flow.alpha.primitiveFieldRef() = cell_values(flow, alpha);
  flow.alpha.correctBoundaryConditions();
  flow.mixture.alpha2() = 1.0 - flow.alpha;
  flow.mixture.correct();
  flow.rho == flow.alpha* flow.mixture.rho1() + flow.mixture.alpha2() * flow.mixture.rho2();
}

double liquid_volume(const Flow& flow) {
  long double sum = 0;  // so that the sum's own round-off stays out of a comparison to 1e-10
  forAll(flow.alpha, cell) {
    const double eps = flow.porosity ? flow.porosity->eps[cell] : 1;
    sum += static_cast<long double>(eps * flow.alpha[cell]) * flow.mesh.V()[cell];
  }
  return static_cast<double>(sum);
}

double largest_speed(const Flow& flow) {
  return Foam::gMax(Foam::mag(flow.U.primitiveField())());
}

}  // namespace demvof::test
