// SPDX-License-Identifier: GPL-3.0-or-later
// Reads an interFoam case: 0/ (U, p_rgh, alpha.*), constant/ (transportProperties, turbulenceProperties,
// g, hRef), system/ (controlDict, fvSchemes, fvSolution with PIMPLE and alpha.*).

#include "foam_side/case_sources.hpp"
#include "foam_side/extras.hpp"
#include "foam_side/vectors.hpp"

namespace demvof {
namespace {

Foam::IOobject file(const Foam::Time& time, const Foam::objectRegistry& registry, const Foam::word& name,
                    Foam::IOobject::readOption read) {
  return {name, time.timeName(), registry, read, Foam::IOobject::AUTO_WRITE};
}

void make_continuous(Flow& flow) {
  const surfaceScalarField anywhere_alike(Foam::IOobject("rAUf", flow.time.timeName(), flow.mesh), flow.mesh,
                                          dimensionedScalar("one", Foam::dimTime / Foam::dimDensity, 1));
  fit_flux(flow, anywhere_alike, nullptr);
}

}  // namespace

ParticleSource::ParticleSource(const Foam::fvMesh& mesh)
    : force(Foam::IOobject("particleForce", mesh.time().timeName(), mesh), mesh,
            Foam::dimensionedVector(Foam::dimForce / Foam::dimVolume, Foam::Zero)),
      coefficient(Foam::IOobject("particleCoefficient", mesh.time().timeName(), mesh), mesh,
                  dimensionedScalar(Foam::dimDensity / Foam::dimTime, Foam::Zero)),
      reference(Foam::IOobject("particleReference", mesh.time().timeName(), mesh), mesh,
                Foam::dimensionedVector(Foam::dimVelocity, Foam::Zero)),
      implicit_impulse(Foam::IOobject("particleImpulse", mesh.time().timeName(), mesh), mesh,
                       Foam::dimensionedVector(Foam::dimDensity * Foam::dimVelocity, Foam::Zero)) {}

Flow::Flow(const Foam::argList& args, const Scene& plan, const Foam::instant* start)
    : scene(plan),
      time(args, start),
      mesh_owner(Foam::dynamicFvMesh::New(
          file(time, time, Foam::dynamicFvMesh::defaultRegion, Foam::IOobject::MUST_READ))),
      mesh(*mesh_owner),
      pimple(mesh),
      p_rgh(file(time, mesh, "p_rgh", Foam::IOobject::MUST_READ), mesh),
      U(file(time, mesh, "U", Foam::IOobject::MUST_READ), mesh),
      porosity(scene.particles && scene.porosity ? std::make_unique<Porosity>(mesh) : nullptr),
      source(scene.particles ? std::make_unique<ParticleSource>(mesh) : nullptr),
      ghost(scene.interchange == PhaseInterchange::volume_adding ? std::make_unique<GhostLiquid>(mesh)
                                                                 : nullptr),
      phi(file(time, mesh, "phi", Foam::IOobject::READ_IF_PRESENT),
          porosity ? face_void_fraction(porosity->eps) * fvc::flux(U) : fvc::flux(U)),
      mixture(U, phi),
      alpha(mixture.alpha1()),
      rho(Foam::IOobject("rho", time.timeName(), mesh),
          alpha * mixture.rho1() + mixture.alpha2() * mixture.rho2()),
      rho_phi(Foam::IOobject("rhoPhi", time.timeName(), mesh), fvc::interpolate(rho) * phi),
      turbulence(Foam::incompressible::turbulenceModel::New(U, phi, mixture)),
      g(Foam::meshObjects::gravity::New(time)),
      gh_reference(reference_potential(g, mesh)),
      gh("gh", (g & mesh.C()) - gh_reference),
      ghf("ghf", (g & mesh.Cf()) - gh_reference),
      p(Foam::IOobject("p", time.timeName(), mesh, Foam::IOobject::NO_READ, Foam::IOobject::AUTO_WRITE),
        p_rgh + rho * gh) {
  gravity.rows = {{0, to_vec3(g.value())}};
  rho.oldTime();  // ddt(rho, U) needs it from the first step on
  mesh.setFluxRequired(p_rgh.name());
  mesh.setFluxRequired(alpha.name());
  Foam::setRefCell(p, p_rgh, pimple.dict(), p_reference_cell, p_reference);
  reconstruct = std::make_unique<Reconstruction>(mesh);
  clock.limit = time.deltaTValue();
}

std::unique_ptr<Flow> open_flow(const Foam::argList& args, const Scene& scene,
                                const RefinementParameters* refinement, const Foam::instant* continued) {
  Foam::FatalError.throwExceptions();
  Foam::FatalIOError.throwExceptions();
  auto flow = std::make_unique<Flow>(args, scene, continued);
  make_extras(*flow);
  refuse_what_is_not_done(*flow);
  require_sources_to_act(*flow);
  require_sources_to_follow(*flow);
  if (refinement) {
    flow->refinement = std::make_unique<Refinement>(flow->mesh, *refinement);
    if (!continued) refine_start(*flow);
  }
  if (!continued) make_continuous(*flow);
  flow->turbulence->validate();
  if (flow->mesh.dynamic())
    flow->face_velocity = std::make_unique<surfaceVectorField>(
        file(flow->time, flow->mesh, "Uf", Foam::IOobject::READ_IF_PRESENT), fvc::interpolate(flow->U));
  else if (flow->porosity)
    flow->velocity_flux = std::make_unique<surfaceScalarField>(
        file(flow->time, flow->mesh, "velocityFlux", Foam::IOobject::READ_IF_PRESENT), fvc::flux(flow->U));
  return flow;
}

}  // namespace demvof
