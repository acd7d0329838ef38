// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Two immiscible fluids in the pores between particles, volume-of-fluid, on an OpenFOAM mesh.
//
//   d(eps)/dt       + div(eps u)       = 0
//   d(eps alpha)/dt + div(eps u alpha) + div(eps alpha (1 - alpha) u_c) = 0
//   d(eps rho u)/dt + div(eps rho u u) = -eps grad p + eps rho g + div(eps mu (grad u + grad u^T))
//                                        + eps sigma kappa grad alpha + F,   F = force + C (u_ref - u)
//
//   eps    void fraction: fluid volume / total volume, -     u    velocity between the particles, m/s
//   alpha  liquid fraction of the fluid, -                   F    force of the particles, N/m3
//
// Source: Pozzetti & Peters, Int. J. Multiphase Flow 99 (2018), eqs. 7-24, 36. The stages below are
// called in the order of the list; each has a file of its own.

#include <memory>

#include "coupler/scene/scene.hpp"
#include "foam_side/openfoam.hpp"

namespace demvof {

/// Void fraction. What the flux has carried (eps) follows what the particles prescribe (goal): the
/// pressure equation returns the difference, which is the error of its linear solver, at every step.
struct Porosity {
  explicit Porosity(const Foam::fvMesh& mesh);

  Foam::volScalarField eps;             // "voidFraction", -
  Foam::volScalarField::Internal goal;  // prescribed void fraction at the present time, -
  Foam::volScalarField::Internal rate;  // d(goal)/dt, constant in a window, 1/s
};

/// Force of the particles on the fluid, F = force + coefficient (reference - u), held over a window.
/// Registered fields, so that a mesh change maps them.
struct ParticleSource {
  explicit ParticleSource(const Foam::fvMesh& mesh);

  Foam::volVectorField::Internal force;             // N/m3
  Foam::volScalarField::Internal coefficient;       // C, kg/(m3 s)
  Foam::volVectorField::Internal reference;         // u_ref, m/s
  Foam::volVectorField::Internal implicit_impulse;  // sum of dt C (u_ref - u) since begin_window, N s/m3
};

/// Time step: interFoam's rule, or, inside a window, equal parts of what is left of it.
struct Clock {
  bool windowed = false;        // begin_window was called
  bool last_of_window = true;   // the present step ends the window
  double window_start = 0, window_end = 0;  // s
  double limit = 0;             // longest step the Courant numbers allow now, s
  double courant = 0, interface_courant = 0;  // of the present step, from the flux at its start
  double largest_courant = 0;   // over the run
  long steps = 0;
};

/// What is fixed during one momentum prediction and its pressure corrections.
struct PressureSystem {
  std::unique_ptr<Foam::fvVectorMatrix> momentum;
  std::unique_ptr<Foam::volScalarField> mobility;        // [eps]/A, m3 s/kg
  std::unique_ptr<Foam::surfaceScalarField> mobility_f;  // its face value (times eps at the face)
  std::unique_ptr<Foam::surfaceScalarField> memory;      // flux carried over from the last step, m3/s
};

/// The fluid. Built by open_flow; members are listed in the order in which they depend on each other.
struct Flow {
  Flow(const Foam::argList& args, const Scene& scene);

  Scene scene;
  Foam::Time time;
  Foam::autoPtr<Foam::dynamicFvMesh> mesh_owner;
  Foam::dynamicFvMesh& mesh;
  Foam::pimpleControl pimple;
  Clock clock;

  Foam::volScalarField p_rgh;     // p - rho g.x, Pa
  Foam::volVectorField U;         // between the particles, m/s
  std::unique_ptr<Porosity> porosity;      // only with scene.porosity
  std::unique_ptr<ParticleSource> source;  // only with scene.particles
  Foam::surfaceScalarField phi;   // eps_f u.S, m3/s: the flux that continuity and alpha use
  Foam::immiscibleIncompressibleTwoPhaseMixture mixture;
  Foam::volScalarField& alpha;    // liquid fraction of the fluid, -
  Foam::volScalarField rho;       // kg/m3
  Foam::surfaceScalarField rho_phi;        // eps_f rho u.S, kg/s, from the same fluxes as alpha
  Foam::autoPtr<Foam::incompressible::turbulenceModel> turbulence;
  Foam::uniformDimensionedVectorField g;   // m/s2
  Foam::dimensionedScalar gh_reference;    // g.x of the reference height, m2/s2
  Foam::volScalarField gh;                 // g.x - gh_reference, m2/s2
  Foam::surfaceScalarField ghf;
  Foam::volScalarField p;         // total pressure, Pa; up to date after end_step
  Foam::label p_reference_cell = 0;        // for closed boxes
  Foam::scalar p_reference = 0;            // Pa
  std::unique_ptr<Foam::surfaceVectorField> face_velocity;  // only on a changing mesh, m/s
  Foam::tmp<Foam::surfaceScalarField> face_force;  // (surface tension - g.x grad rho).S, N/m; set with alpha
  PressureSystem pressure_system;

  double alpha_excess = 0;        // worst distance of alpha from [0, 1] over the run, -
};

// ---- set-up ------------------------------------------------------------------------------------

/// Reads an interFoam case. From here on OpenFOAM's errors are exceptions (Foam::error).
/// Throws for what this solver does not do: ddt other than Euler, MRF zones, fvOptions.
std::unique_ptr<Flow> open_flow(const Foam::argList& args, const Scene& scene);

/// The void fraction at the start, a state and not a change. eps: one value per cell.
void set_initial_porosity(Flow& flow, const Foam::scalarField& eps);

// ---- a window ----------------------------------------------------------------------------------

/// From here to t_end (s) the clock divides what is left into equal steps; implicit_impulse starts at 0.
void begin_window(Flow& flow, double t_end);

/// The void fraction at the window's end, reached linearly. Fits the flux to the new rate, so that
/// the first alpha step of the window is volume-true. Call after begin_window. eps: one value per cell.
void set_porosity_target(Flow& flow, const Foam::scalarField& eps);

// ---- a time step, in this order ----------------------------------------------------------------

bool advance_clock(Flow& flow);       // false at the window's end, or without a window at the run's end
bool refine_mesh(Flow& flow);         // true if the mesh changed: fields are mapped, fluxes corrected
void update_porosity(Flow& flow);
bool outer_corrector(Flow& flow);     // while true: the next four
void advect_interface(Flow& flow);
void predict_momentum(Flow& flow);
bool pressure_corrector(Flow& flow);  // while true: correct_pressure; ends with the turbulence model
void correct_pressure(Flow& flow);
void end_step(Flow& flow);            // ledger, bounds; without a window also field output as in controlDict

// ---- to be read by others ----------------------------------------------------------------------

/// Gradient of the total pressure from the face values that drive the momentum equation, Pa/m, one
/// value per cell: exactly rho g in a fluid at rest.
Foam::tmp<Foam::volVectorField> pressure_gradient(const Flow& flow);

/// Effective (laminar + turbulent) dynamic viscosity of the mixture, Pa s, one value per cell.
Foam::tmp<Foam::scalarField> dynamic_viscosity(const Flow& flow);

}  // namespace demvof
