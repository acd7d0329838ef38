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
// Source: Pozzetti & Peters, Int. J. Multiphase Flow 99 (2018), eqs. 7-24, 36. The stages of a step
// are called in the order in which they are declared; each has a file of its own.

#include <functional>
#include <memory>

#include "coupler/scene/scene.hpp"
#include "foam_side/ghost_liquid.hpp"
#include "foam_side/openfoam.hpp"
#include "foam_side/pressure_system.hpp"
#include "foam_side/reconstruct.hpp"
#include "foam_side/refinement.hpp"
#include "foam_side/run_time.hpp"

namespace demvof {

constexpr double negligible_change = 1e-13;  // of a void fraction in one step

/// Void fraction. eps is what the flux has carried: with it alpha stays bounded and liquid is kept to
/// round-off, however loosely the pressure is solved. goal is what the particles prescribe; eps
/// follows it to the tolerance of the pressure solver, because continuity asks for the difference back.
struct Porosity {
  explicit Porosity(const Foam::fvMesh& mesh);

  volScalarField eps;             // "voidFraction", -
  volScalarField::Internal goal;  // prescribed void fraction at the present time, -
  volScalarField::Internal rate;  // d(goal)/dt, constant in a window, 1/s
  // How the particles move (solid_motion.cpp):
  volVectorField::Internal solid_velocity;  // their mean v in a cell, m/s; 0 where there are none
  surfaceScalarField along;                 // v.S, m3/s
  surfaceScalarField carried;               // flux of a fluid that goes with them, and makes room, m3/s
  // What of the fluid the faces of a mesh that moves sweep over in the step (move_porosity.cpp), m3/s.
  std::unique_ptr<surfaceScalarField> swept;
};

/// Force of the particles on the fluid, F = force + coefficient (reference - u), held over a window.
/// Registered fields, so that a mesh change maps them.
struct ParticleSource {
  explicit ParticleSource(const Foam::fvMesh& mesh);

  volVectorField::Internal force;             // N/m3
  volScalarField::Internal coefficient;       // C, kg/(m3 s)
  volVectorField::Internal reference;         // u_ref, m/s
  volVectorField::Internal implicit_impulse;  // sum of dt C (u_ref - u) since begin_window or the last
                                              // Bridge::collect_impulse, N s/m3
};

/// Time step: interFoam's rule, or, inside a window, equal parts of what is left of it.
struct Clock {
  bool windowed = false;         // begin_window was called
  bool window_done = true;       // the present step ends the window
  double window_begin = 0;       // s
  double window_end = 0;         // s
  double limit = 0;              // longest step the Courant numbers allow in windows, s
  double courant = 0;            // of the present step, from the flux at its start
  double interface_courant = 0;  // the same in cells with 0.01 < alpha < 0.99
  double largest_courant = 0;    // over the run
  long steps = 0;
};

/// The fluid. Built by open_flow; members stand in the order in which they depend on each other.
struct Flow {
  Flow(const Foam::argList& args, const Scene& scene, const Foam::instant* start);

  Scene scene;
  RunTime time;
  Foam::autoPtr<Foam::dynamicFvMesh> mesh_owner;
  Foam::dynamicFvMesh& mesh;
  Foam::pimpleControl pimple;
  Clock clock;

  volScalarField p_rgh;                    // p - rho g.x, Pa
  volVectorField U;                        // between the particles, m/s
  std::unique_ptr<Porosity> porosity;      // only with scene.particles and scene.porosity
  std::unique_ptr<ParticleSource> source;  // only with scene.particles
  std::unique_ptr<GhostLiquid> ghost;      // only with phase interchange volume_adding; without porosity
  surfaceScalarField phi;                  // eps_f u.S, m3/s: the one flux of continuity and alpha
  Foam::immiscibleIncompressibleTwoPhaseMixture mixture;
  volScalarField& alpha;       // liquid fraction of the fluid, -
  volScalarField rho;          // kg/m3
  surfaceScalarField rho_phi;  // eps_f rho u.S, kg/s, from the same flux as alpha
  Foam::autoPtr<Foam::incompressible::turbulenceModel> turbulence;
  GravityTable gravity;                          // of the run; without a table the case's g at any time
  const Foam::uniformDimensionedVectorField& g;  // of the present window or step, m/s2
  dimensionedScalar gh_reference;                // g.x of the reference height, m2/s2
  volScalarField gh;                             // g.x - gh_reference, m2/s2
  surfaceScalarField ghf;
  volScalarField p;                                   // total pressure, Pa; brought up to date by end_step
  label p_reference_cell = 0;                         // closed boxes: where p has the value p_reference
  scalar p_reference = 0;                             // Pa
  std::unique_ptr<surfaceVectorField> face_velocity;  // only on a changing mesh, m/s
  std::unique_ptr<Refinement> refinement;             // only with fluid.refinement
  std::unique_ptr<surfaceScalarField> velocity_flux;  // only with porosity on a fixed mesh: u.S, m3/s
  tmp<surfaceScalarField> face_force;                 // (sigma kappa grad alpha - g.x grad rho).S, N/m
  PressureSystem pressure_system;
  std::unique_ptr<Reconstruction> reconstruct;

  double alpha_excess = 0;  // worst distance of alpha from [0, 1] over the run, -
};

// ---- set-up ------------------------------------------------------------------------------------

/// Reads an interFoam case. From here on OpenFOAM's errors are exceptions (Foam::error). Throws for
/// what this solver does not do: time schemes other than Euler, MRF zones, fvOptions, moving meshes.
/// args is only read. (The destructor of an argList ends the process with exit code 0.)
/// refinement: what write_mesh_dictionary was given; nullptr: the case alone says how its mesh changes.
/// continued: the time folder of an earlier run, whose flow goes on; nullptr: a flow that starts.
std::unique_ptr<Flow> open_flow(const Foam::argList& args, const Scene& scene,
                                const RefinementParameters* refinement = nullptr,
                                const Foam::instant* continued = nullptr);

/// With fluid.refinement: fine cells around the initial surface, and there the fields that setFields made,
/// set again, with the pressure that balances them. Before the void fraction; part of open_flow.
void refine_start(Flow& flow);

/// Mean velocity of the particles in the window in which they displaced what comes next, one value per cell,
/// m/s.
void set_solid_velocity(Flow& flow, const Foam::vectorField& velocity);

/// The void fraction at the start: a state, not a change. eps: one value per cell.
void set_initial_porosity(Flow& flow, const scalarField& eps);

/// p_rgh, and p, in balance with the forces on the fluid at the start, to the solver's tolerance.
void balance_pressure(Flow& flow);

/// p_rgh is the same everywhere, as in most cases' 0 folder: it is no state to start from.
bool pressure_says_nothing(const Flow& flow);

// ---- a window ----------------------------------------------------------------------------------

/// From here to t_end (s) the clock divides what is left into equal steps; implicit_impulse starts at 0.
void begin_window(Flow& flow, double t_end);

/// The void fraction at the window's end, reached linearly. Fits the flux to the new rate, so that the
/// first alpha step of the window already follows it. Call after begin_window. eps: one value per cell.
/// Throws if a box without a pressure boundary would have to change its fluid volume.
void set_porosity_target(Flow& flow, const scalarField& eps);

/// The void fraction that the particles prescribe for the end of the coming step, with the surface where it
/// is now: inside a window with two fluids, after advect_interface. eps: one value per cell.
void follow_surface(Flow& flow, const scalarField& eps);

// ---- a time step, in this order ----------------------------------------------------------------

bool advance_clock(Flow& flow);  // false at the window's end, or without windows at the run's end
/// True if the mesh changed: fields are mapped; then the next two. before: done when the mesh may change.
bool refine_mesh(Flow& flow, const std::function<void()>& before = {});
void renew_porosity(Flow& flow, const scalarField& begin, const scalarField& end);  // with particles
void settle_flux(Flow& flow);
/// On a mesh that moves in place of these: its points, with particles on it.
void move_under_particles(Flow& flow);
/// Then, with porosity: what the particles prescribe at begin and end of the step for the moved cells, -.
void move_porosity(Flow& flow, const scalarField& begin, const scalarField& end);
/// With a new void fraction: what passes a wall that moves is nothing in the flux relative to it, and in the
/// one in space what the wall sweeps.
void renew_swept_fluid(Flow& flow);
void update_porosity(Flow& flow);
bool outer_corrector(Flow& flow);  // while true: the next four
void advect_interface(Flow& flow);
void predict_momentum(Flow& flow);
bool pressure_corrector(Flow& flow);  // while true: correct_pressure; then the turbulence model
void correct_pressure(Flow& flow);
void end_step(Flow& flow);  // impulse, bounds; without windows also output as in controlDict

// renew_porosity gives new cells the void fraction that the bulk grid prescribes for them, at the begin
// and end of the window, one value per cell: those that mapping gave them have no profile, and following
// the prescribed one would push fluid to and fro between them. settle_flux makes the mapped flux
// continuous.

// ---- used by several stages --------------------------------------------------------------------

/// Gravity from here on, m/s2; returned is by how much it has changed.
Vec3 set_gravity(Flow& flow, const Vec3& gravity);

/// gh and ghf of the present gravity and mesh.
void renew_gravity_potential(Flow& flow);

/// The gravity potential's zero, m2/s2: constant/hRef is a height, taken along the axis of g.
dimensionedScalar reference_potential(const Foam::uniformDimensionedVectorField& g, const Foam::fvMesh& mesh);

/// Corrects phi by a potential so that div(phi) = -wanted_rate (1/s, per cell; nullptr: 0), with the
/// least impulse where mobility (m3 s/kg, at faces) is a measure of how easily the fluid moves. Solver of
/// fvSolution: pcorr with a wanted rate, which the next step makes up for where it is missed; else
/// pcorrFinal.
void fit_flux(Flow& flow, const surfaceScalarField& mobility, const scalarField* wanted_rate);

/// OpenFOAM's adjustPhi. A wall that slides along itself lets nothing through, not even the last bit of the
/// product of its velocity and area, of which a closed box at rest would ask where it goes.
void adjust_outflow(Flow& flow, surfaceScalarField& flux, volScalarField& pressure);

/// The same for any flux of volume. Returns the potential.
tmp<volScalarField> fit_flux(Flow& flow, surfaceScalarField& flux, const surfaceScalarField& mobility,
                             const scalarField* wanted_rate, const Foam::dictionary& solver);

/// A flux of which this is left to fit (1/s, per cell): fitted as well as fvSolution asks for with respect to
/// the whole rate of the void fraction.
Foam::dictionary solver_for_rest(const Flow& flow, const scalarField& missed);

/// What fvSolution says for it.
const Foam::dictionary& flux_solver(const Flow& flow, bool to_the_end);

/// face_force of the present alpha and rho.
void update_face_force(Flow& flow);

/// along and carried of the void fraction from the particles' velocity and its present rate. at_start: there
/// is no rate to know. False if no particle moves or has moved.
bool follow_solid(Flow& flow, bool at_start = false);

/// phi of a fluid that has the velocity u.S = velocity_flux (m3/s) at the faces.
tmp<surfaceScalarField> flux_of(const Flow& flow, const surfaceScalarField& velocity_flux);

/// And back: u.S at the faces.
tmp<surfaceScalarField> velocity_flux_of(const Flow& flow, const surfaceScalarField& flux);

/// Void fraction at faces that keeps a uniform flux uniform where eps jumps: 1/e = mean(1/eps).
tmp<surfaceScalarField> face_void_fraction(const volScalarField& eps);

/// Mobility for fit_flux from density, void fraction and drag, m3 s/kg.
tmp<surfaceScalarField> projection_mobility(const Flow& flow);

/// d(eps V)/dt per volume, as the particles prescribe it for the present step of a mesh that moves, 1/s.
tmp<scalarField> prescribed_growth(const Flow& flow);

/// Volumes at the begin of the step, m3.
const scalarField& volumes_before(const Flow& flow);

/// u.S of the face velocity on a mesh that changes, m3/s; at patches with a given velocity that one's.
tmp<surfaceScalarField> flux_of_face_velocity(const Flow& flow);

/// Between a flux in space and that through the faces, which may move.
void make_relative(const Flow& flow, surfaceScalarField& flux);
void make_absolute(const Flow& flow, surfaceScalarField& flux);

/// Rate at which the void fraction has to grow to be where it should be after the coming step, 1/s.
tmp<scalarField> wanted_porosity_rate(const Flow& flow);

// ---- to be read by others ----------------------------------------------------------------------

/// Gradient of the total pressure from the face values that drive the momentum equation, Pa/m:
/// exactly rho g in a fluid at rest.
Foam::vectorField pressure_gradient(const Flow& flow, bool with_laplace_jump = true);

/// Effective (laminar and turbulent) dynamic viscosity, Pa s, one value per cell: of the mixture; of liquid
/// (0) or gas (1) alone.
tmp<scalarField> dynamic_viscosity(const Flow& flow);
tmp<scalarField> dynamic_viscosity(const Flow& flow, int fluid);

/// Density of the fluid between the particles, kg/m3: rho, less what stands for particles in it.
double density_between_particles(const Flow& flow, label cell);
double density_of(const Flow& flow, int fluid);  // 0: liquid, 1: gas, kg/m3

}  // namespace demvof
