// SPDX-License-Identifier: GPL-3.0-or-later
//
// A fracture driven by fluid in field time: rock in static equilibrium at every moment, flow and
// leak-off implicit (backward Euler), one Newton iteration for jumps, pressures and the well together.
//   rock      S δ = ∫ (p − p_pore − t(w) + σ'_n) ∂w/∂δ ds       (condensation.hpp, interface.hpp)
//   cell      h [w ρ(p)]ⁿ⁺¹ − h [w ρ]ⁿ + Δt Σ q_out + V_leak = 0   (fracture_flow.hpp, leak_off.hpp)
//   well      C_w Δp_w = Δt (Q − Σ q)                               (well.hpp)
// A cell is an edge of the path. The fracture grows by an edge where the opening at its tip passes the
// elastic one; this is iterated within the step. Tension positive; volumes at reference density, per
// metre of thickness.
// Faces open, and on general paths slip. A tip chooses its next edge by the stress round it; joints without
// cohesion take part from the beginning, with friction, and take fluid where a fracture meets them. Where it
// meets one that holds, the joint's edges stand as tips beside its own, each with its own bond: what opens
// first goes on. Where the mesh has a wellbore its excavation and the pressure of the well load the rock, and
// its fluid is part of the well's. Layers have stiffness, stress and strength of their own.
// Where a tip gets faster than a tenth of the Rayleigh speed, or no step converges, the rock goes on by
// explicit steps with inertia (control.hand_over; dynamics.hpp in src), until equilibrium is near again.
// Limits: elastic rock, no stress from fluid that leaks off; joints without cohesion do not grow
// at their ends, those that hold break only where a fracture has come to them, by opening, and a fracture
// that has turned into one follows it to its end.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <variant>
#include <vector>

#include "crackle/cohesive/interface.hpp"
#include "crackle/cohesive/law.hpp"
#include "crackle/fluid/fracture_flow.hpp"
#include "crackle/fluid/leak_off.hpp"
#include "crackle/fluid/pump.hpp"
#include "crackle/fluid/well.hpp"
#include "crackle/seismic/event.hpp"
#include "crackle/solve/fracture_path.hpp"
#include "crackle/solve/quasi_static_state.hpp"
#include "crackle/solve/rock_model.hpp"

namespace crackle {

/// Which edges ahead of the fluid carry its pressure.
enum class Wetting : std::uint8_t {
  tip_pressure,  ///< damaged edges hold fluid, the edge ahead of them carries the pressure of the last one
  damaged,       ///< damaged edges hold fluid, the edge ahead is dry: a spurious toughness under confinement
  broken,        ///< only edges without any cohesion left hold fluid (Y-Geo)
};

/// A fracture that starts at the well, or the wall of the wellbore, and follows given edges, as far as they
/// go.
struct Wing {
  Index start = -1;         ///< vertex at the well
  std::vector<Index> path;  ///< mesh edges in order
  /// How many of them are broken, and filled, from the beginning; 0: none, at the wall of a wellbore.
  std::size_t open = 1;
  /// Beyond its path it goes on along the edge whose direction is nearest to that across which the
  /// mean stress round its tip pulls most.
  bool free = false;
};

struct TimeControl {
  double relative = 0.02;   ///< largest step over the time since the last change of the schedule [-]
  double growth = 1.25;     ///< of a step over the one before [-]
  double first = 1e-3;      ///< step after a change of the schedule [s]
  double smallest = 1e-10;  ///< below it the stage gives up [s]
  int edges_per_step = 3;   ///< a tip may advance by in one step
  double energy = 3e-4;     ///< that the ledger of a step may miss, over what the step turns over [-]
  bool hand_over = false;   ///< to explicit steps where the fracture snaps, and back; else the run ends there
};

/// Of the materials of its rock, joints and layers the stage takes tensile strength, fracture energy of
/// opening and residual friction. Joints without cohesion are mated, full of fluid at pore pressure; the
/// others are part of the rock until a fracture comes to them.
struct QuasiStaticScene : RockModel {
  Held held;                   ///< components held at zero displacement, per vertex
  double pore_pressure = 0.0;  ///< in the dry rock; also that of the fluid at first [Pa]
  std::shared_ptr<const CohesiveLaw> law;
  double edges_per_zone = 8.0;  ///< strength is lowered until E'G/f² is as many edges long
  Closure closure;
  FractureFluid fluid;
  std::variant<std::monostate, CarterLeakOff, MatrixRock> leak_off;
  Well well;
  Pump pump;
  Wetting wetting = Wetting::tip_pressure;
  std::vector<Wing> wings;
  bool slip = false;  ///< faces may slip: for any path that is no straight line of symmetry
  TimeControl control;
};

/// What is recorded of every step; volumes [m2] per metre of thickness at reference density.
struct QuasiStaticRow {
  double time = 0.0, step = 0.0;              ///< [s]
  double well_pressure = 0.0;                 ///< [Pa]
  double fracture_pressure = 0.0;             ///< mean of the cells at the well [Pa]
  double least_pressure = 0.0;                ///< of all cells [Pa]
  double rate = 0.0, perforation_rate = 0.0;  ///< pumped, and into the fracture, mean of the step [m2/s]
  double injected = 0.0, well_stored = 0.0, fracture_volume = 0.0, leaked = 0.0;
  double mass_defect = 0.0;       ///< injected less what is found [m2]
  double broken_length = 0.0;     ///< all wings, up to where nothing holds any more [m]
  double damaged_length = 0.0;    ///< up to where damage begins [m]
  double elastic_length = 0.0;    ///< of the crack without cohesion that opens as this one does [m]
  double opening = 0.0;           ///< at the well [m]
  double mean_opening = 0.0;      ///< of fluid-filled cells [m]
  double contact_fraction = 0.0;  ///< of their length, where faces touch [-]
  double dissipated = 0.0;        ///< by fracture, in all [J/m]
  quasi_static::Energies energies;
  int iterations = 0;  ///< of Newton, in this step
};

/// An edge of the fracture as it is now.
struct FractureCell {
  Index edge = -1;                ///< of the mesh
  double length = 0.0;            ///< [m]
  bool joint = false;             ///< there before the fracture
  std::array<double, 2> opening;  ///< at its inner and outer vertex [m]
  std::array<double, 2> slip;     ///< [m]
  std::array<double, 2> damage;   ///< [-]
  bool wet = false;
  double pressure = 0.0;  ///< [Pa]
  double leaked = 0.0;    ///< [m2]
};

class QuasiStatic {
 public:
  /// Factorises the rock and finds the equilibrium of the initial fracture at pore pressure.
  /// @throws CaseError for a scene that cannot run, NumericalError
  explicit QuasiStatic(QuasiStaticScene scene);
  /// Goes on from a state of the same scene, with the same bits.
  QuasiStatic(QuasiStaticScene scene, quasi_static::State state);
  ~QuasiStatic();

  const QuasiStaticScene& scene() const;
  double time() const;
  const quasi_static::State& state() const;
  /// The state now, without what belongs to a step.
  QuasiStaticRow row() const;
  /// One step of the length that suits, or a number of explicit ones, ending at `end` [s] at the latest.
  /// @throws NumericalError when no step converges, or the fracture comes to the end of its path
  QuasiStaticRow step(double end);
  /// Steps until `end`; `record` gets every row.
  void run(double end, const std::function<void(const QuasiStaticRow&)>& record = {});

  /// The last snap, as soon as the fracture is at rest again: one event, of what is modelled, without
  /// magnitudes. Its length is what has been damaged, its energy all that waves took along.
  SeismicEvent last_snap() const;
  std::vector<FractureCell> cells() const;
  const FracturePath& path() const;
  /// Displacement [m] of every corner of every triangle, three a triangle, with the jumps.
  std::vector<Vec2> corner_displacement() const;
  /// Effective stress [Pa] of every triangle at such a displacement.
  std::vector<Sym2> stress(const std::vector<Vec2>& corner_displacement) const;
  /// Strength that the mesh resolves [Pa], the least of the path so far.
  double strength() const;
  std::int64_t rejected_steps() const { return state().rejected; }
  std::int64_t newton_iterations() const { return state().iterations; }

 private:
  class Solver;
  std::unique_ptr<Solver> solver_;
};

}  // namespace crackle
