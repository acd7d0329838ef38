// SPDX-License-Identifier: GPL-3.0-or-later
// Integrals of the step that has just been done, as the momentum and the alpha equation have them:
//
//   liquid in         -sum of dt phi_liquid                        over boundary faces
//   weight             sum of dt eps rho V g                       over cells
//   pressure          -sum of dt p S                               over boundary faces, p total, and over
//                                                                  periodic ends, where it jumps
//   shear              sum of dt eps mu_eff (|S| d(u)/dn + dev2(grad u^T).S)   over boundary faces; the
//   second
//                                                                  term of the velocity before
//   carried in         what else the momentum matrix has at boundary faces: -sum of dt rho_phi u, with the
//                      flux and the direction (inlet, outlet) that it was assembled with
//   surface tension    sum of dt eps V sigma kappa grad alpha      over cells
//
// On meshes of equal hexahedra the cells' pressure gradients add up to the boundary's pressure exactly.

#include "foam_side/fluid_books.hpp"

#include <memory>
#include <utility>

#include "foam_side/extras.hpp"
#include "foam_side/vectors.hpp"
#include "processorCyclicFvPatch.H"

namespace demvof {
namespace {

class RegisteredBooks : public Foam::regIOobject {
 public:
  explicit RegisteredBooks(const Foam::fvMesh& mesh)
      : regIOobject(Foam::IOobject("fluidBooks", mesh.time().timeName(), mesh, Foam::IOobject::NO_READ,
                                   Foam::IOobject::NO_WRITE)) {}
  bool writeData(Foam::Ostream&) const override { return true; }
  FluidBooks books;
  std::unique_ptr<Foam::fvVectorMatrix> free_equation;  // only where fvOptions may constrain it
};

RegisteredBooks& registered_books(const Flow& flow) {
  const Foam::objectRegistry& registry = flow.mesh.thisDb();
  if (!registry.foundObject<RegisteredBooks>("fluidBooks"))
    Foam::regIOobject::store(new RegisteredBooks(flow.mesh));
  return registry.lookupObjectRef<RegisteredBooks>("fluidBooks");
}

FluidBooks& books_of(const Flow& flow) {
  return registered_books(flow).books;
}

/// Faces that are the end of the fluid, not a cut.
template <class Entry>
void for_each_boundary_face(const Foam::fvMesh& mesh, const Entry& enter) {
  forAll(mesh.boundary(), patch) {
    if (mesh.boundary()[patch].coupled()) continue;
    forAll(mesh.Sf().boundaryField()[patch], face) enter(patch, face);
  }
}

/// Periodic ends, on one rank or on two: p_rgh goes through, p = p_rgh + rho g.x jumps when gravity has a
/// component along the period.
bool joins_ends(const Foam::fvPatch& patch) {
  return patch.coupled() &&
         (!Foam::isA<Foam::processorFvPatch>(patch) || Foam::isA<Foam::processorCyclicFvPatch>(patch));
}

void enter_boundary(const Flow& flow, double dt, FluidBooks& books) {
  const tmp<surfaceScalarField> rho_f = fvc::interpolate(flow.rho);
  vector pressure = vector::zero;
  forAll(flow.mesh.boundary(), patch) {
    const Foam::vectorField& S = flow.mesh.Sf().boundaryField()[patch];
    if (joins_ends(flow.mesh.boundary()[patch]))
      pressure -= Foam::sum(flow.ghf.boundaryField()[patch] * rho_f().boundaryField()[patch] * S);
    if (flow.mesh.boundary()[patch].coupled() || flow.mesh.boundary()[patch].size() == 0) continue;
    pressure -= Foam::sum(flow.p.boundaryField()[patch] * S);
  }
  books.boundary_pressure += dt * to_vec3(pressure);
  books.boundary_shear += dt * (books.step_shear + books.explicit_stress);
  books.carried_in += dt * books.step_carried;
  books.sources += dt * (books.step_sources + books.step_corrections);
}

void enter_cells(const Flow& flow, double dt, FluidBooks& books) {
  const scalarField& volume = flow.mesh.V().field();
  const scalarField* eps = flow.porosity ? &flow.porosity->eps.primitiveField() : nullptr;
  double mass = 0;
  forAll(volume, cell) mass += (eps ? (*eps)[cell] : 1.0) * flow.rho[cell] * volume[cell];
  books.weight += dt * mass * to_vec3(flow.g.value());

  vector tension = vector::zero;
  if (flow.scene.surface_tension) {
    const surfaceScalarField pull(flow.mixture.surfaceTensionForce() * flow.mesh.magSf());
    const Foam::vectorField force = (*flow.reconstruct)([&](const auto& at, label) { return at(pull); });
    forAll(volume, cell) tension += (eps ? (*eps)[cell] : 1.0) * volume[cell] * force[cell];
  }
  books.surface_tension += dt * to_vec3(tension);
}

}  // namespace

void note_liquid_flux(Flow& flow, const surfaceScalarField& flux) {
  show_liquid_flux(flow, flux);
  double inflow = 0;
  for_each_boundary_face(flow.mesh,
                         [&](label patch, label face) { inflow -= flux.boundaryField()[patch][face]; });
  books_of(flow).liquid_inflow = inflow;
}

void note_explicit_stress(Flow& flow, const volScalarField& density) {
  const tmp<volScalarField> nu = flow.turbulence->nuEff();
  const tmp<Foam::volTensorField> gradient = fvc::grad(flow.U);
  vector force = vector::zero;
  forAll(flow.mesh.boundary(), patch) {
    if (flow.mesh.boundary()[patch].coupled()) continue;
    const Foam::tensorField stress(density.boundaryField()[patch] * nu().boundaryField()[patch] *
                                   Foam::dev2(gradient().boundaryField()[patch].T()));
    force += Foam::sum(flow.mesh.Sf().boundaryField()[patch] & stress);
  }
  books_of(flow).explicit_stress = to_vec3(force);
}

void note_free_equation(Flow& flow, const Foam::fvVectorMatrix& momentum) {
  registered_books(flow).free_equation = std::make_unique<Foam::fvVectorMatrix>(momentum);
}

void note_boundary_stress(Flow& flow) {
  const tmp<volScalarField> viscosity = flow.turbulence->nuEff();
  const auto& free = registered_books(flow).free_equation;
  const Foam::fvVectorMatrix& momentum = free ? *free : *flow.pressure_system.momentum;
  vector shear = vector::zero, through = vector::zero;
  forAll(flow.mesh.boundary(), patch) {
    if (flow.mesh.boundary()[patch].coupled() || flow.mesh.boundary()[patch].size() == 0) continue;
    const Foam::fvPatchVectorField& at = flow.U.boundaryField()[patch];
    const scalarField mu(flow.rho.boundaryField()[patch] * viscosity().boundaryField()[patch]);
    Foam::vectorField stress(mu * flow.mesh.magSf().boundaryField()[patch] * at.snGrad());
    if (flow.porosity) stress *= stress_share(flow)().boundaryField()[patch];
    shear += Foam::sum(stress);
    through += Foam::sum(momentum.boundaryCoeffs()[patch] -
                         Foam::cmptMultiply(momentum.internalCoeffs()[patch], at.patchInternalField()()));
  }
  books_of(flow).step_shear = to_vec3(shear);
  books_of(flow).step_carried = to_vec3(through - shear);
}

void note_sources(Flow& flow) {
  const PressureSystem& system = flow.pressure_system;
  if (!system.sources) return;
  Foam::vectorField force((*system.sources & flow.U)().primitiveField());
  // What a constrained equation has less than the one that was assembled, the constraint has to give.
  if (const auto& free = registered_books(flow).free_equation)
    force += (*free & flow.U)().primitiveField() - (*system.momentum & flow.U)().primitiveField();
  books_of(flow).step_sources = to_vec3(Foam::sum(flow.mesh.V().field() * force));
}

void correct_by_sources(Flow& flow, const scalarField& answer) {
  if (!extras(flow).sources_of_momentum) return;
  const Foam::vectorField before(flow.U.primitiveField());
  extras(flow).sources.correct(flow.U);
  const Foam::vectorField change(flow.U.primitiveField() - before);
  books_of(flow).step_corrections = to_vec3(Foam::sum(flow.mesh.V().field() * answer * change));
}

void keep_books(Flow& flow) {
  const double dt = flow.time.deltaTValue();
  FluidBooks& books = books_of(flow);
  books.liquid_in += dt * books.liquid_inflow;
  if (!flow.source) return;
  enter_boundary(flow, dt, books);
  enter_cells(flow, dt, books);
}

FluidBooks take_books(Flow& flow) {
  FluidBooks taken = std::exchange(books_of(flow), FluidBooks{});
  Foam::reduce(taken.liquid_in, Foam::sumOp<double>());
  for (Vec3* part : {&taken.weight, &taken.boundary_pressure, &taken.boundary_shear, &taken.carried_in,
                     &taken.surface_tension, &taken.sources})
    *part = to_vec3(Foam::returnReduce(to_foam(*part), Foam::sumOp<vector>()));
  return taken;
}

}  // namespace demvof
