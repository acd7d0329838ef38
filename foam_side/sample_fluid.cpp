// SPDX-License-Identifier: GPL-3.0-or-later
#include "foam_side/sample_fluid.hpp"

#include <cmath>

#include "foam_side/cell_field.hpp"
#include "foam_side/fine_mesh.hpp"
#include "interpolation.H"

namespace demvof {
namespace {

/// A point on a face, an edge or a corner, by this fraction of the face's size, is in all cells that meet
/// there.
constexpr double between_cells = 1e-6;

bool holds(const Foam::fvMesh& mesh, label cell, const vector& point) {
  for (const label face : mesh.cells()[cell]) {
    const vector& area = mesh.faceAreas()[face];
    const scalar size = Foam::mag(area), outward = mesh.faceOwner()[face] == cell ? 1 : -1;
    const scalar height = outward * ((point - mesh.faceCentres()[face]) & area) / (size + Foam::VSMALL);
    if (height > between_cells * std::sqrt(size)) return false;
  }
  return true;
}

/// A field at points inside given cells.
template <class Type>
class PointValues {
 public:
  PointValues(Mapping mapping, const VolField<Type>& field) : field_(field), mesh_(field.mesh()) {
    if (mapping == Mapping::inverse_distance) {
      for (const auto& patch : field.boundaryField())
        across_.push_back(patch.coupled() ? patch.patchNeighbourField() : tmp<Foam::Field<Type>>());
    } else
      foam_ = Foam::interpolation<Type>::New(mapping == Mapping::cell_point ? "cellPoint" : "cellPointFace",
                                             field);
  }

  Type operator()(const vector& point, label cell) const {
    return foam_.valid() ? foam_->interpolate(point, cell) : by_distance(point, cell);
  }

 private:
  Type by_distance(const vector& point, label cell) const {
    Type sum = Foam::Zero;
    scalar weights = 0;
    const auto add = [&](const vector& centre, const Type& value) {
      const scalar weight = 1 / (Foam::mag(point - centre) + Foam::VSMALL);
      sum += weight * value;
      weights += weight;
    };
    const vector& centre = mesh_.cellCentres()[cell];
    add(centre, field_[cell]);
    for (const label face : mesh_.cells()[cell]) {
      if (mesh_.isInternalFace(face)) {
        const label other = mesh_.owner()[face] == cell ? mesh_.neighbour()[face] : mesh_.owner()[face];
        add(mesh_.cellCentres()[other], field_[other]);
        continue;
      }
      const label patch = mesh_.boundaryMesh().whichPatch(face);
      if (!across_[patch].valid()) continue;
      const label i = face - mesh_.boundaryMesh()[patch].start();
      const tmp<Foam::vectorField> delta = mesh_.boundary()[patch].delta();  // to the cell across
      add(centre + delta()[i], across_[patch]()[i]);
    }
    return sum / weights;
  }

  const VolField<Type>& field_;
  const Foam::fvMesh& mesh_;
  Foam::autoPtr<Foam::interpolation<Type>> foam_;
  std::vector<tmp<Foam::Field<Type>>> across_;  // per patch, where it is coupled: values beyond
};

}  // namespace

FluidSampler::FluidSampler(const Foam::fvMesh& mesh, const BulkCut& cut)
    : mapping_(cut.to_bulk()), slots_(cut.remap().bulk_centroid().size()) {
  for (const Subcell& subcell : cut.remap().subcells()) {
    const vector point = to_foam(cut.grid().nearest_image(cut.remap().bulk_centroid()[subcell.slot],
                                                          to_vec3(mesh.cellCentres()[subcell.fine])));
    if (holds(mesh, subcell.fine, point)) hits_.push_back({subcell.slot, subcell.fine, point});
  }
}

std::vector<FluidSample> FluidSampler::sample(const Flow& flow, const Foam::vectorField& gradient,
                                              const scalarField& viscosity) const {
  const VolField<vector> gradients =
      with_boundary("pressureGradientOfBulk", flow.mesh, Foam::dimPressure / Foam::dimLength, gradient);
  const VolField<scalar> viscosities =
      with_boundary("viscosityOfBulk", flow.mesh, Foam::dimDynamicViscosity, viscosity);
  const PointValues<vector> velocity(mapping_, flow.U), pressure_gradient(mapping_, gradients);
  const PointValues<scalar> density(mapping_, flow.rho), mu(mapping_, viscosities);
  std::vector<FluidSample> samples(slots_);
  for (const Hit& hit : hits_) {
    FluidSample& sum = samples[hit.slot];
    sum.velocity += to_vec3(velocity(hit.point, hit.fine));
    sum.pressure_gradient += to_vec3(pressure_gradient(hit.point, hit.fine));
    sum.density += density(hit.point, hit.fine);
    sum.viscosity += mu(hit.point, hit.fine);
    sum.cells += 1;
  }
  return samples;
}

}  // namespace demvof
