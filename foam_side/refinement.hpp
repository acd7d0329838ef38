// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "coupler/config/parameters.hpp"
#include "foam_side/openfoam.hpp"

namespace demvof {

struct Flow;

/// Writes the dynamicMeshDict that makes OpenFOAM refine the mesh by the marks below. Before the case is
/// opened, on one rank. Throws InputError when the case has such a file of its own.
void write_mesh_dictionary(const std::filesystem::path& fluid_case, const RefinementParameters& parameters);

/// A case whose own dynamicMeshDict refines the mesh at the surface (dynamicRefineFvMesh) gets the same as
/// one with fluid.refinement: the levels, rings (nBufferLayers) and most cells are taken from that file, and
/// in the run's copy of the case the one above takes its place. nullopt where the mesh does not refine
/// itself. Before the mesh is read; collective. Throws InputError where it refines by another field than the
/// liquid's fraction, or where the run that is continued had a section fluid.refinement.
std::optional<RefinementParameters> take_refinement_of_case(const Foam::Time& time);
/// What to say then.
std::string refined_as_of_case(const RefinementParameters& parameters);

/// Where the mesh has to be fine, and when it is looked at again.
///
/// Marked are cells with 0.01 < alpha < 0.99, both cells of a face over which alpha jumps by more than 0.01
/// and, as the case asks, cells with particles and both cells of a face over which eps jumps; then rings of
/// neighbours. The mesh is renewed before the interface gets within half a cell of coarser ones: when the
/// sum of its Courant numbers since the last time reaches the number of rings less a half; and, if cells
/// with particles are asked for, when one of them is not fine.
struct Refinement {
  Refinement(const Foam::fvMesh& mesh, const RefinementParameters& parameters);

  RefinementParameters parameters;
  volScalarField mark;         // "refinementMark": 1 where the mesh has to be fine, 0 elsewhere
  double crossed = 0;          // cells that the interface may have crossed since the last look
  bool first = true;           // the mesh has not been looked at yet
  long changes = 0;            // of the mesh, over the run
  double worst_imbalance = 1;  // largest number of cells on a rank over the mean, over the run
  double left_imbalance = 1;   // likewise, after cells were last moved between ranks
  long moves = 0;              // of cells between ranks, over the run

  bool due(const Flow& flow);  // true when the mesh has to be looked at in this step
  void set_marks(const Flow& flow);

 private:
  bool particles_leave(const Flow& flow) const;  // for cells that are not fine
};

}  // namespace demvof
