// SPDX-License-Identifier: GPL-3.0-or-later
// Transport of the void fraction and of the liquid fraction by the flux phi = eps_f u.S.
//
//   eps^{n+1} = eps^n - dt div(phi)
//   (eps alpha)^{n+1} = (eps alpha)^n - dt div(phi alpha + eps alpha (1 - alpha) u_c)
//   eps u_c.S = c_alpha |phi| n.S/|S|,  n = grad alpha / |grad alpha|
//
// Both by the same flux, so alpha = 1 stays 1 and sum(eps alpha V) is kept to round-off. MULES keeps
// alpha in [0, 1] with eps as its weight, whether its high-order flux is this one or, with
// advectionScheme isoAdvection, the geometric one (geometric_flux.hpp). An interIsoFoam case without
// particles is carried as there. In alpha sub-cycles eps is interpolated between the ends of the step as
// plain arrays: the field's old-time value is the step's and must stay so. Sources: Pozzetti & Peters 2018,
// eqs. 15-20, 36; Weller 2008 (interface compression).

#include "CrankNicolsonDdtScheme.H"
#include "foam_side/extras.hpp"
#include "foam_side/flow.hpp"
#include "foam_side/fluid_books.hpp"
#include "foam_side/geometric_flux.hpp"

namespace demvof {
namespace {

/// Volume at the begin of the step over that at its end, exactly 1 on a mesh at rest.
tmp<scalarField> volume_ratio(const Flow& flow) {
  return volumes_before(flow) / flow.mesh.V().field();
}

/// Void fraction at the two ends of an alpha step, in the form of the "rho" that MULES asks for. The volume
/// of fluid in a cell changes linearly through a step, and so does the cell's.
class StepPorosity {
 public:
  struct Start {
    const scalarField& values;
    const scalarField& field() const { return values; }
  };
  /// The part from fraction a to fraction b of the flow's present step, which goes from start to end.
  StepPorosity(const Flow& flow, const scalarField& start, const scalarField& end, double a, double b)
      : start_(at(flow, start, end, a)), end_(at(flow, start, end, b)) {}
  const scalarField& field() const { return end_; }
  Start oldTime() const { return {start_}; }

 private:
  static scalarField at(const Flow& flow, const scalarField& start, const scalarField& end, double part) {
    if (part == 0 || part == 1) return part == 0 ? start : end;  // without round-off
    const scalarField from((1 - part) * volume_ratio(flow));
    return (from * start + part * end) / (from + part);
  }
  scalarField start_, end_;
};

/// The fluxes of an alpha step, m3/s: with phi the liquid moves, by now at the end of the step and the rest
/// at its begin (Crank-Nicolson).
struct Carrier {
  const surfaceScalarField& phi;          // mean over the step
  const surfaceScalarField& compressing;  // at its end
  scalar now = 1;
  const volVectorField* velocity = nullptr;  // with isoAdvector's own bounding, m/s
};

/// Contact angles act through the curvature calculation of OpenFOAM's interface class.
bool has_contact_angle(const volScalarField& alpha) {
  for (const auto& patch : alpha.boundaryField())
    if (Foam::isA<Foam::alphaContactAngleTwoPhaseFvPatchScalarField>(patch)) return true;
  return false;
}

bool needs_curvature(const Flow& flow) {
  return flow.scene.surface_tension || has_contact_angle(flow.alpha);
}

/// alpha of the gas, and normals and curvature where somebody uses them. At a contact angle each call moves
/// alpha at the wall a little further, so that their number counts: one per corrector, as in interFoam, and
/// one at the end.
void follow_alpha(Flow& flow) {
  flow.mixture.alpha2() = 1.0 - flow.alpha;
  if (needs_curvature(flow)) flow.mixture.interfaceProperties::correct();
}

/// n.S at the faces, m2.
tmp<surfaceScalarField> interface_normal(const Flow& flow) {
  if (needs_curvature(flow)) return flow.mixture.nHatf();
  const surfaceVectorField gradient(fvc::interpolate(fvc::grad(flow.alpha, "nHat")));
  return (gradient & flow.mesh.Sf()) / (Foam::mag(gradient) + flow.mixture.deltaN());
}

/// Speed of compression times eps, m/s; none through the boundary.
tmp<surfaceScalarField> compression_speed(const Flow& flow, const surfaceScalarField& phi,
                                          const AdvectionControls& controls) {
  const scalar c = flow.mixture.cAlpha();
  tmp<surfaceScalarField> speed = (1 - controls.isotropic) * c * Foam::mag(phi / flow.mesh.magSf());
  const auto add = [&](tmp<surfaceScalarField> more) {
    if (flow.porosity) more.ref() *= face_void_fraction(flow.porosity->eps);
    speed.ref() += more;
  };
  if (controls.isotropic > 0) add(controls.isotropic * c * fvc::interpolate(Foam::mag(flow.U)));
  if (controls.shear > 0)
    add(controls.shear * Foam::mag(flow.mesh.delta() & fvc::interpolate(Foam::symm(fvc::grad(flow.U)))));
  for (auto& patch : speed.ref().boundaryFieldRef())
    if (!patch.coupled()) patch == 0;
  return speed;
}

/// High-order flux of alpha before MULES limits it, m3/s: geometric, or with compression.
tmp<surfaceScalarField> unlimited_flux(Flow& flow, const Carrier& carrier,
                                       const AdvectionControls& controls) {
  if (controls.geometric) return geometric_flux(flow, carrier.phi);
  const surfaceScalarField relative(compression_speed(flow, carrier.compressing, controls) *
                                    interface_normal(flow));
  tmp<surfaceScalarField> carried =
      carrier.now == 1
          ? fvc::flux(carrier.phi, flow.alpha, "div(phi,alpha)")
          : fvc::flux(carrier.phi, carrier.now * flow.alpha + (1 - carrier.now) * flow.alpha.oldTime(),
                      "div(phi,alpha)");
  return carried + fvc::flux(-fvc::flux(-relative, flow.mixture.alpha2(), "div(phirb,alpha)"), flow.alpha,
                             "div(phirb,alpha)");
}

/// Implicit upwind step; returns its flux.
template <class Weight>
tmp<surfaceScalarField> upwind_step(Flow& flow, const surfaceScalarField& phi, const Weight& eps) {
  const scalarField rate(flow.mesh.Vsc()().field() / flow.time.deltaTValue());
  scalarField rate0(rate);
  if (flow.mesh.moving()) rate0 = flow.mesh.Vsc0()().field() / flow.time.deltaTValue();
  Foam::fvScalarMatrix equation(
      Foam::fv::gaussConvectionScheme<scalar>(flow.mesh, phi, Foam::upwind<scalar>(flow.mesh, phi))
          .fvmDiv(phi, flow.alpha));
  equation.diag() += eps.field() * rate;
  equation.source() += eps.oldTime().field() * rate0 * flow.alpha.oldTime().primitiveField();
  equation.solve();
  return equation.flux();
}

/// One alpha step of the length of time's deltaT; returns the flux of liquid, m3/s.
template <class Weight>
tmp<surfaceScalarField> advance_alpha(Flow& flow, const Carrier& carrier, const AdvectionControls& controls,
                                      const Weight& eps) {
  volScalarField& alpha = flow.alpha;
  std::unique_ptr<surfaceScalarField>& compression = extras(flow).compression;
  tmp<surfaceScalarField> flux, upwind;
  if (carrier.velocity) {
    flux = advance_by_cuts(flow, carrier.phi, *carrier.velocity);
    follow_alpha(flow);
    return flux;
  }
  if (controls.semi_implicit) {
    flux = upwind_step(flow, carrier.phi, eps);
    if (controls.reuse) {
      upwind = tmp<surfaceScalarField>::New("upwind", flux());
      if (compression) {
        Foam::MULES::correct(eps, alpha, flux(), *compression, Foam::oneField(), Foam::zeroField());
        flux.ref() += *compression;
      }
    }
    follow_alpha(flow);
  }
  for (label corrector = 0; corrector < controls.correctors; ++corrector) {
    tmp<surfaceScalarField> target = unlimited_flux(flow, carrier, controls);
    if (controls.semi_implicit) {
      surfaceScalarField correction(target() - flux());
      const bool damped = corrector > 0;  // half of each further correction, for convergence
      tmp<volScalarField> before;
      if (damped) before = tmp<volScalarField>::New("alpha10", alpha);
      Foam::MULES::correct(eps, alpha, target(), correction, Foam::oneField(), Foam::zeroField());
      if (damped) alpha = 0.5 * alpha + 0.5 * before();
      flux.ref() += (damped ? 0.5 : 1.0) * correction;
    } else {
      flux = target;
      Foam::MULES::explicitSolve(eps, alpha, carrier.phi, flux.ref(), Foam::oneField(), Foam::zeroField());
    }
    follow_alpha(flow);
  }
  if (upwind.valid()) compression = std::make_unique<surfaceScalarField>("compressionFlux", flux() - upwind);
  return flux;
}

/// All alpha (sub-)steps of a time step; returns the mean flux of liquid, m3/s.
/// part(a, b): weight of the part of the step from fraction a to fraction b.
template <class Part>
tmp<surfaceScalarField> advance_alpha_in_parts(Flow& flow, const Carrier& carrier, const Part& part) {
  const AdvectionControls controls(flow);
  const label n = controls.sub_cycles;
  if (n <= 1) return advance_alpha(flow, carrier, controls, part(0, 1));

  tmp<surfaceScalarField> mean;
  label done = 0;
  for (Foam::subCycle<volScalarField> cycle(flow.alpha, n); !(++cycle).end(); ++done) {
    tmp<surfaceScalarField> flux =
        advance_alpha(flow, carrier, controls, part(double(done) / n, double(done + 1) / n));
    if (mean.valid())
      mean.ref() += flux;
    else
      mean = flux;
  }
  mean.ref() /= scalar(n);
  return mean;
}

/// eps at the end of the step.
void carry_void_fraction(Flow& flow) {
  volScalarField& eps = flow.porosity->eps;
  const tmp<volScalarField> divergence = fvc::div(flow.phi);
  eps.primitiveFieldRef() = eps.oldTime().primitiveField() * volume_ratio(flow) -
                            flow.time.deltaTValue() * divergence().primitiveField();
  eps.correctBoundaryConditions();
  renew_swept_fluid(flow);
}

/// Everything that follows from a new alpha.
void update_mixture(Flow& flow) {
  flow.mixture.incompressibleTwoPhaseMixture::correct();
  flow.rho == flow.alpha* flow.mixture.rho1() + flow.mixture.alpha2() * flow.mixture.rho2();
  if (flow.ghost) add_ghost_density(flow);
  if (!flow.scene.surface_tension && has_contact_angle(flow.alpha))
    flow.mixture.interfaceProperties::correct();  // else update_face_force does
}

/// The alpha step between particles; returns the flux of liquid. phi: flux of the fluid.
tmp<surfaceScalarField> advance_between_particles(Flow& flow, const surfaceScalarField& phi,
                                                  const volScalarField& eps) {
  // MULES takes its bounded upwind flux from the present alpha: in a further outer corrector that has
  // to be the one of the step's start. (interFoam starts from the last iterate, and is not bounded.)
  if (!flow.pimple.firstIter()) {
    flow.alpha = flow.alpha.oldTime();
    follow_alpha(flow);
  }
  return advance_alpha_in_parts(flow, {phi, phi},
                                [&flow, &start = eps.oldTime().primitiveField(), &end = eps.primitiveField()](
                                    double a, double b) { return StepPorosity(flow, start, end, a, b); });
}

/// Share of the step's end in the flux that carries alpha: 1 for Euler, 1/2 for Crank-Nicolson without
/// off-centring, which begins in the second step.
scalar share_of_end(const Flow& flow) {
  using CrankNicolson = Foam::fv::CrankNicolsonDdtScheme<scalar>;
  const auto scheme = Foam::fv::ddtScheme<scalar>::New(flow.mesh, flow.mesh.ddtScheme("ddt(alpha)"));
  const bool first = flow.time.timeIndex() <= flow.time.startTimeIndex() + 1;
  if (first || !Foam::isType<CrankNicolson>(scheme()) || AdvectionControls(flow).geometric) return 1;
  return 1 / (1 + Foam::refCast<const CrankNicolson>(scheme()).ocCoeff());
}

/// As interIsoFoam: further outer correctors begin anew, with the mean of the step's begin and the last
/// iterate.
void advance_like_interisofoam(Flow& flow, const dimensionedScalar& rho1, const dimensionedScalar& rho2) {
  surfaceScalarField phi(flow.phi);
  volVectorField velocity(flow.U);
  if (flow.pimple.nCorrPIMPLE() > 1 && flow.pimple.firstIter()) {
    flow.alpha.storePrevIter();
    flow.phi.storePrevIter();
    flow.U.storePrevIter();
  } else if (!flow.pimple.firstIter()) {
    flow.alpha = flow.alpha.prevIter();
    phi = 0.5 * flow.phi.prevIter() + 0.5 * flow.phi;
    velocity = 0.5 * flow.U.prevIter() + 0.5 * flow.U;
  }
  tmp<surfaceScalarField> liquid = advance_alpha_in_parts(
      flow, {phi, phi, 1, &velocity}, [](double, double) { return Foam::geometricOneField(); });
  note_liquid_flux(flow, liquid());
  flow.rho_phi = (rho1 - rho2) * liquid + rho2 * phi;
}

/// The alpha step of the fluid alone, and the flux of mass that belongs to the end of the step.
void advance_alone(Flow& flow, const dimensionedScalar& rho1, const dimensionedScalar& rho2) {
  const scalar end = share_of_end(flow);
  tmp<surfaceScalarField> mean(flow.phi);
  if (end < 1) mean = end * flow.phi + (1 - end) * flow.phi.oldTime();
  tmp<surfaceScalarField> liquid = advance_alpha_in_parts(
      flow, {mean(), flow.phi, end}, [](double, double) { return Foam::geometricOneField(); });
  note_liquid_flux(flow, liquid());
  const std::unique_ptr<surfaceScalarField>& liquid_flux = extras(flow).liquid_flux;
  if (!liquid_flux) {
    flow.rho_phi = (rho1 - rho2) * liquid + rho2 * mean;
    return;
  }
  surfaceScalarField& at_end = *liquid_flux;
  at_end = liquid;
  if (end < 1) at_end = (at_end - (1 - end) * at_end.oldTime()) / end;
  flow.rho_phi = (rho1 - rho2) * at_end + rho2 * flow.phi;
}

}  // namespace

void advect_interface(Flow& flow) {
  if (flow.porosity) carry_void_fraction(flow);
  if (!flow.scene.interface_advection) {
    flow.mixture.incompressibleTwoPhaseMixture::correct();  // viscosity may depend on the flow
    flow.rho_phi = fvc::interpolate(flow.rho) * flow.phi;
    note_liquid_flux(flow, fvc::interpolate(flow.alpha) * flow.phi);
    if (!flow.face_force.valid()) update_face_force(flow);
    return;
  }
  const dimensionedScalar& rho1 = flow.mixture.rho1();
  const dimensionedScalar& rho2 = flow.mixture.rho2();
  tmp<surfaceScalarField> heavy_flux;  // what has the liquid's density, m3/s
  if (flow.ghost) {
    carry_ghost(flow);
    const surfaceScalarField fluid_flux(flow.phi - flow.ghost->flux);
    heavy_flux = advance_between_particles(flow, fluid_flux, flow.ghost->eps) + flow.ghost->flux;
  } else if (flow.porosity) {
    heavy_flux = advance_between_particles(flow, flow.phi, flow.porosity->eps);
  } else if (AdvectionControls(flow).bounded_by_own) {
    advance_like_interisofoam(flow, rho1, rho2);
  } else {
    advance_alone(flow, rho1, rho2);
  }
  if (heavy_flux.valid()) {
    note_liquid_flux(flow, flow.ghost ? heavy_flux() - flow.ghost->flux : heavy_flux);
    flow.rho_phi = (rho1 - rho2) * heavy_flux + rho2 * flow.phi;
  }
  update_mixture(flow);
  update_face_force(flow);
}

}  // namespace demvof
