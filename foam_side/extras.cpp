// SPDX-License-Identifier: GPL-3.0-or-later
// Without particles a case may ask whatever interFoam does, with few exceptions. With particles momentum and
// volume are kept exactly, and what would not keep them is refused.

#include "foam_side/extras.hpp"

#include "cyclicACMIPolyPatch.H"
#include "dynamicRefineFvMesh.H"
#include "processorCyclicPolyPatch.H"

namespace demvof {
namespace {

constexpr const char* registered = "demvofExtras";
constexpr const char* flux_for_others = "alphaPhiUn";  // as interFoam calls it

MeshMotion motion_of(const Flow& flow) {
  if (!flow.mesh.dynamic() || Foam::isA<Foam::dynamicRefineFvMesh>(flow.mesh)) return MeshMotion::never;
  const bool again = flow.pimple.dict().lookupOrDefault("moveMeshOuterCorrectors", false);
  return again ? MeshMotion::each_corrector : MeshMotion::each_step;
}

bool written_for_cuts(const Flow& flow) {
  return flow.time.controlDict().lookupOrDefault<Foam::word>("application", "") == "interIsoFoam";
}

Foam::word alpha_scheme(const Flow& flow, const Foam::dictionary& alpha) {
  return alpha.lookupOrDefault<Foam::word>("advectionScheme",
                                           written_for_cuts(flow) ? "isoAdvection" : "MULES");
}

Foam::word scheme_of(const Foam::fvMesh& mesh, const Foam::word& term) {
  return Foam::word(mesh.ddtScheme(term));
}

void refuse(const std::string& what) {
  FatalErrorInFunction << what.c_str() << Foam::exit(Foam::FatalError);  // throws
}

void require_known_time_schemes(const Flow& flow, const AdvectionControls& alpha) {
  const Foam::word momentum = scheme_of(flow.mesh, "ddt(rho,U)"), liquid = scheme_of(flow.mesh, "ddt(alpha)");
  for (const Foam::word& name : {momentum, liquid}) {
    if (flow.scene.particles && name != "Euler")
      refuse("ddtSchemes: " + name +
             ": with particles Euler only, which keeps their momentum and volume exactly");
    if (name == "localEuler" || name == "steadyState")
      refuse("ddtSchemes: " + name +
             ": steps of each cell's own lead to a steady state, not through time; use Euler");
  }
  if (alpha.geometric) return;  // takes its own step
  if (liquid != "Euler" && liquid != "CrankNicolson")
    refuse("ddtSchemes: ddt(alpha) is " + liquid +
           ", known: Euler, CrankNicolson (that of ddt(rho,U) is free)");
  if (liquid == "CrankNicolson" && alpha.sub_cycles > 1)
    refuse("ddtSchemes: ddt(alpha) CrankNicolson needs nAlphaSubCycles 1");
}

void require_known_advection(const Flow& flow, const AdvectionControls& alpha) {
  if (alpha.scheme != "MULES" && alpha.scheme != "isoAdvection")
    refuse("advectionScheme is " + alpha.scheme + ", known: MULES, isoAdvection");
  if (!alpha.geometric) return;
  if (extras(flow).motion != MeshMotion::never && !alpha.bounded_by_own)
    refuse(
        "advectionScheme isoAdvection: on a mesh that moves only without particles, in a case whose "
        "application is interIsoFoam; MULES does");
  for (const Foam::polyPatch& patch : flow.mesh.boundaryMesh())
    if (Foam::isA<Foam::cyclicAMIPolyPatch>(patch))
      refuse("advectionScheme isoAdvection: not with patch " + patch.name() + " of type " + patch.type());
}

/// Relaxed, the last outer corrector would leave momentum to the next step that nobody counts.
void require_unrelaxed_end(const Flow& flow) {
  const Foam::fvMesh& mesh = flow.mesh;
  if (!flow.scene.particles) return;
  const auto refuse_factor = [](const char* name) {
    refuse(std::string("relaxationFactors: with particles the last outer corrector is not relaxed, ") + name +
           " has to be 1");
  };
  if (mesh.relaxEquation("UFinal") && mesh.equationRelaxationFactor("UFinal") != 1) refuse_factor("UFinal");
  if (mesh.relaxField("p_rghFinal") && mesh.fieldRelaxationFactor("p_rghFinal") != 1)
    refuse_factor("p_rghFinal");
}

/// What overlaps changes with the motion, and OpenFOAM does not keep the liquid then (9e-4 of it in 20
/// windows of a box whose halves slide).
void refuse_overlap_that_changes(const Flow& flow) {
  if (extras(flow).motion == MeshMotion::never) return;
  for (const Foam::polyPatch& patch : flow.mesh.boundaryMesh())
    if (Foam::isA<Foam::cyclicACMIPolyPatch>(patch))
      refuse("patch " + patch.name() + " of type " + patch.type() +
             ": on a mesh that moves it does not keep liquid: with particles cyclicAMI, whose sides overlap "
             "wholly, or a mesh at rest");
}

/// Refined, such a cut is wrong in OpenFOAM: a uniform stream is 2e-4 of itself off after ten steps.
void refuse_cut_cyclic_refinement(const Flow& flow) {
  if (!Foam::isA<Foam::dynamicRefineFvMesh>(flow.mesh)) return;
  for (const Foam::polyPatch& patch : flow.mesh.boundaryMesh()) {
    if (!Foam::isA<Foam::processorCyclicPolyPatch>(patch)) continue;
    const auto& cut = Foam::refCast<const Foam::processorCyclicPolyPatch>(patch);
    const auto& here = Foam::refCast<const Foam::cyclicPolyPatch>(cut.referPatch());
    const auto& side = here.owner() ? here : here.neighbPatch();  // all ranks say the same
    refuse("the sides of the cyclic patches " + side.name() + " and " + side.neighbPatchName() +
           " lie on different ranks, which a mesh that refines itself does not bear: cut along other "
           "directions, or have them on one in system/decomposeParDict: constraints { ends { type "
           "preservePatches; patches (" +
           side.name() + " " + side.neighbPatchName() + "); enabled true; } }");
  }
}

void require_what_particles_bear(const Flow& flow) {
  if (!flow.scene.particles) return;
  if (flow.time.startTime().value() != 0 && flow.scene.mesh_moves)
    refuse(
        "controlDict: startTime: with particles on a mesh that moves it has to be 0, from which the script's "
        "surfaces move, too: rename the folder");
  if (extras(flow).rotating.active())
    refuse(
        "constant/MRFProperties: a zone that rotates in its equations only stands still for the particles: "
        "remove the file, or run without particles");
  if (flow.pimple.frozenFlow())
    refuse("PIMPLE: frozenFlow: a flow that is given takes no momentum from particles: no");
  if (extras(flow).motion == MeshMotion::each_corrector)
    refuse("PIMPLE: moveMeshOuterCorrectors: with particles the mesh moves once a step: no");
  if (flow.scene.mesh_moves && (flow.ghost || flow.scene.interchange == PhaseInterchange::replacement))
    refuse("coupling.phase_interchange: on a mesh that moves porous or none");
  refuse_overlap_that_changes(flow);
}

}  // namespace

void refuse_what_is_not_done(const Flow& flow) {
  const AdvectionControls alpha(flow);
  require_known_advection(flow, alpha);
  require_known_time_schemes(flow, alpha);
  require_unrelaxed_end(flow);
  refuse_cut_cyclic_refinement(flow);
  require_what_particles_bear(flow);
}

Extras::Extras(const Flow& flow)
    : regIOobject(Foam::IOobject(registered, flow.time.timeName(), flow.mesh)),
      rotating(flow.mesh),
      sources(Foam::fv::options::New(flow.mesh)),
      sources_of_momentum(sources.appliesToField(flow.U.name())),
      motion(motion_of(flow)) {
  if (Foam::word(flow.mesh.ddtScheme("ddt(rho,U)")) == "Euler") return;
  const Foam::IOobject file(Foam::IOobject::groupName("alphaPhi0", flow.alpha.group()), flow.time.timeName(),
                            flow.mesh, Foam::IOobject::READ_IF_PRESENT, Foam::IOobject::AUTO_WRITE);
  liquid_flux = std::make_unique<surfaceScalarField>(file, flow.phi * fvc::interpolate(flow.alpha));
}

void make_extras(Flow& flow) {
  Foam::regIOobject::store(new Extras(flow));
  Foam::regIOobject::store(
      new surfaceScalarField(Foam::IOobject(flux_for_others, flow.time.timeName(), flow.mesh),
                             flow.phi * fvc::interpolate(flow.alpha)));
}

void show_liquid_flux(const Flow& flow, const surfaceScalarField& flux) {
  *flow.mesh.getObjectPtr<surfaceScalarField>(flux_for_others) = flux;
}

Extras& extras(const Flow& flow) {
  return *flow.mesh.getObjectPtr<Extras>(registered);
}

AdvectionControls::AdvectionControls(const Flow& flow) {
  const Foam::dictionary& alpha = flow.mesh.solverDict(flow.alpha.name());
  scheme = alpha_scheme(flow, alpha);
  geometric = scheme == "isoAdvection";
  bounded_by_own = geometric && !flow.scene.particles && written_for_cuts(flow);
  correctors = geometric ? 1 : alpha.get<label>("nAlphaCorr");
  sub_cycles = alpha.get<label>("nAlphaSubCycles");
  semi_implicit = !geometric && alpha.lookupOrDefault("MULESCorr", false);  // the cuts have no implicit part
  reuse = semi_implicit && alpha.lookupOrDefault("alphaApplyPrevCorr", false);
  isotropic = alpha.lookupOrDefault<scalar>("icAlpha", 0);
  shear = alpha.lookupOrDefault<scalar>("scAlpha", 0);
}

}  // namespace demvof
