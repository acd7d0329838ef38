// SPDX-License-Identifier: GPL-3.0-or-later
// Transport of the void fraction and of the liquid fraction by the flux phi = eps_f u.S.
//
//   eps^{n+1} = eps^n - dt div(phi)
//   (eps alpha)^{n+1} = (eps alpha)^n - dt div(phi alpha + eps alpha (1 - alpha) u_c)
//   eps u_c.S = c_alpha |phi| n.S/|S|,  n = grad alpha / |grad alpha|
//
// Both by the same flux, so alpha = 1 stays 1 and sum(eps alpha V) is kept to round-off. MULES keeps
// alpha in [0, 1] with eps as its weight, whether its high-order flux is this one or, with
// advectionScheme isoAdvection, the geometric one (geometric_flux.hpp). In alpha sub-cycles eps is
// interpolated between the ends of the step as plain arrays: the field's old-time value is the step's and
// must stay so. Sources: Pozzetti & Peters 2018, eqs. 15-20, 36; Weller 2008 (interface compression).

#include "foam_side/flow.hpp"
#include "foam_side/geometric_flux.hpp"

namespace demvof {
namespace {

/// Void fraction at the two ends of an alpha step, in the form of the "rho" that MULES asks for.
class StepPorosity {
 public:
  struct Start {
    const scalarField& values;
    const scalarField& field() const { return values; }
  };
  /// The part from fraction a to fraction b of a step that goes from start to end.
  StepPorosity(const scalarField& start, const scalarField& end, double a, double b)
      : start_((1 - a) * start + a * end), end_((1 - b) * start + b * end) {}
  const scalarField& field() const { return end_; }
  Start oldTime() const { return {start_}; }

 private:
  scalarField start_, end_;
};

struct AlphaControls {
  explicit AlphaControls(const Foam::dictionary& alpha)
      : geometric(alpha.lookupOrDefault<Foam::word>("advectionScheme", "MULES") == "isoAdvection"),
        correctors(geometric ? 1 : alpha.get<label>("nAlphaCorr")),
        sub_cycles(alpha.get<label>("nAlphaSubCycles")),
        semi_implicit(alpha.lookupOrDefault("MULESCorr", false)) {}
  bool geometric;  // flux from the cut of the interface instead of a compression flux
  label correctors, sub_cycles;
  bool semi_implicit;  // implicit upwind step first, MULES on the rest
};

/// Contact angles act through the curvature calculation of OpenFOAM's interface class.
bool has_contact_angle(const volScalarField& alpha) {
  for (const auto& patch : alpha.boundaryField())
    if (Foam::isA<Foam::alphaContactAngleTwoPhaseFvPatchScalarField>(patch)) return true;
  return false;
}

/// n.S at the faces, m2. The curvature comes along only where somebody uses it.
tmp<surfaceScalarField> interface_normal(Flow& flow) {
  if (flow.scene.surface_tension || has_contact_angle(flow.alpha)) {
    flow.mixture.interfaceProperties::correct();
    return flow.mixture.nHatf();
  }
  const surfaceVectorField gradient(fvc::interpolate(fvc::grad(flow.alpha, "nHat")));
  return (gradient & flow.mesh.Sf()) / (Foam::mag(gradient) + flow.mixture.deltaN());
}

/// Speed of compression times eps, m/s; none through the boundary.
tmp<surfaceScalarField> compression_speed(const Flow& flow, const surfaceScalarField& phi) {
  tmp<surfaceScalarField> speed = flow.mixture.cAlpha() * Foam::mag(phi / flow.mesh.magSf());
  for (auto& patch : speed.ref().boundaryFieldRef())
    if (!patch.coupled()) patch == 0;
  return speed;
}

/// High-order flux of alpha before MULES limits it, m3/s: geometric, or with compression.
tmp<surfaceScalarField> unlimited_flux(Flow& flow, const surfaceScalarField& phi,
                                       const AlphaControls& controls) {
  if (controls.geometric) return geometric_flux(flow, phi);
  const surfaceScalarField relative(compression_speed(flow, phi) * interface_normal(flow));
  return fvc::flux(phi, flow.alpha, "div(phi,alpha)") +
         fvc::flux(-fvc::flux(-relative, flow.mixture.alpha2(), "div(phirb,alpha)"), flow.alpha,
                   "div(phirb,alpha)");
}

/// Implicit upwind step; returns its flux.
template <class Weight>
tmp<surfaceScalarField> upwind_step(Flow& flow, const surfaceScalarField& phi, const Weight& eps) {
  const scalarField rate(flow.mesh.V().field() / flow.time.deltaTValue());
  Foam::fvScalarMatrix equation(
      Foam::fv::gaussConvectionScheme<scalar>(flow.mesh, phi, Foam::upwind<scalar>(flow.mesh, phi))
          .fvmDiv(phi, flow.alpha));
  equation.diag() += eps.field() * rate;
  equation.source() += eps.oldTime().field() * rate * flow.alpha.oldTime().primitiveField();
  equation.solve();
  return equation.flux();
}

/// One alpha step of the length of time's deltaT; returns the flux of liquid, m3/s.
template <class Weight>
tmp<surfaceScalarField> advance_alpha(Flow& flow, const surfaceScalarField& phi,
                                      const AlphaControls& controls, const Weight& eps) {
  volScalarField& alpha = flow.alpha;
  volScalarField& alpha2 = flow.mixture.alpha2();
  tmp<surfaceScalarField> flux;
  if (controls.semi_implicit) {
    flux = upwind_step(flow, phi, eps);
    alpha2 = 1.0 - alpha;
  }
  for (label corrector = 0; corrector < controls.correctors; ++corrector) {
    tmp<surfaceScalarField> target = unlimited_flux(flow, phi, controls);
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
      Foam::MULES::explicitSolve(eps, alpha, phi, flux.ref(), Foam::oneField(), Foam::zeroField());
    }
    alpha2 = 1.0 - alpha;
  }
  return flux;
}

/// All alpha (sub-)steps of a time step; returns the mean flux of liquid, m3/s.
/// phi: flux of the fluid. part(a, b): weight of the part of the step from fraction a to fraction b.
template <class Part>
tmp<surfaceScalarField> advance_alpha_in_parts(Flow& flow, const surfaceScalarField& phi, const Part& part) {
  const AlphaControls controls(flow.mesh.solverDict(flow.alpha.name()));
  const label n = controls.sub_cycles;
  if (n <= 1) return advance_alpha(flow, phi, controls, part(0, 1));

  tmp<surfaceScalarField> mean;
  label done = 0;
  for (Foam::subCycle<volScalarField> cycle(flow.alpha, n); !(++cycle).end(); ++done) {
    tmp<surfaceScalarField> flux =
        advance_alpha(flow, phi, controls, part(double(done) / n, double(done + 1) / n));
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
  eps.primitiveFieldRef() =
      eps.oldTime().primitiveField() - flow.time.deltaTValue() * divergence().primitiveField();
  eps.correctBoundaryConditions();
}

/// Everything that follows from a new alpha.
void update_mixture(Flow& flow) {
  flow.mixture.incompressibleTwoPhaseMixture::correct();
  flow.rho == flow.alpha* flow.mixture.rho1() + flow.mixture.alpha2() * flow.mixture.rho2();
  if (flow.ghost) add_ghost_density(flow);
}

/// The alpha step between particles; returns the flux of liquid. phi: flux of the fluid.
tmp<surfaceScalarField> advance_between_particles(Flow& flow, const surfaceScalarField& phi,
                                                  const volScalarField& eps) {
  // MULES takes its bounded upwind flux from the present alpha: in a further outer corrector that has
  // to be the one of the step's start. (interFoam starts from the last iterate, and is not bounded.)
  if (!flow.pimple.firstIter()) flow.alpha = flow.alpha.oldTime();
  return advance_alpha_in_parts(
      flow, phi, [&start = eps.oldTime().primitiveField(), &end = eps.primitiveField()](double a, double b) {
        return StepPorosity(start, end, a, b);
      });
}

}  // namespace

void advect_interface(Flow& flow) {
  if (flow.porosity) carry_void_fraction(flow);
  if (!flow.scene.interface_advection) {
    flow.rho_phi = fvc::interpolate(flow.rho) * flow.phi;
    if (!flow.face_force.valid()) update_face_force(flow);
    return;
  }
  tmp<surfaceScalarField> heavy_flux;  // what has the liquid's density, m3/s
  if (flow.ghost) {
    carry_ghost(flow);
    const surfaceScalarField fluid_flux(flow.phi - flow.ghost->flux);
    heavy_flux = advance_between_particles(flow, fluid_flux, flow.ghost->eps) + flow.ghost->flux;
  } else if (flow.porosity) {
    heavy_flux = advance_between_particles(flow, flow.phi, flow.porosity->eps);
  } else {
    heavy_flux =
        advance_alpha_in_parts(flow, flow.phi, [](double, double) { return Foam::geometricOneField(); });
  }
  const dimensionedScalar& rho1 = flow.mixture.rho1();
  const dimensionedScalar& rho2 = flow.mixture.rho2();
  flow.rho_phi = (rho1 - rho2) * heavy_flux + rho2 * flow.phi;
  update_mixture(flow);
  update_face_force(flow);
}

}  // namespace demvof
