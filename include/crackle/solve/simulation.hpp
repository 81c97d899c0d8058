// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "crackle/cohesive/cohesive.hpp"
#include "crackle/contact/general_contact.hpp"
#include "crackle/fluid/fluid.hpp"
#include "crackle/seismic/slip_events.hpp"
#include "crackle/solid/bulk.hpp"
#include "crackle/solid/damage.hpp"
#include "crackle/solve/boundary.hpp"
#include "crackle/solve/loads.hpp"
#include "crackle/solve/ramp.hpp"
#include "crackle/solve/rock_model.hpp"
#include "crackle/solve/stopwatch.hpp"
#include "crackle/solve/tiles.hpp"
#include "crackle/solve/time_step.hpp"
#include "crackle/state/state.hpp"

namespace crackle {

/// Which edges carry a cohesive element: all from the start, or those that come near their strength.
struct InsertionPolicy {
  bool on_demand = false;
  double threshold = 0.7;  ///< of the strength (Cohesive::utilisation) at which an edge gets its element
  double step = 0.75;      ///< time step over the tied rock's, which leaves room for the elements' penalty
};

/// A triangle that is cracked from the start.
struct CutTriangle {
  Index triangle = -1;
  Vec2 normal;  ///< of its crack, unit
};

/// Rock that breaks by smeared damage of its triangles instead of its edges.
struct DamageChoice {
  std::shared_ptr<const SofteningLaw> law;  ///< nullptr: none
  std::vector<DamageMaterial> materials;
  std::vector<std::uint16_t> of_triangle;  ///< which of the materials; empty: all of the first
  std::vector<CutTriangle> cut;            ///< ascending
};

/// What is simulated: rock, fractures, fluid, boundary. All in SI, tension positive.
struct Scene : RockModel {
  Bulk::Damping damping;
  std::shared_ptr<const CohesiveLaw>
      law;  ///< nullptr: no cohesive elements; beside damage: on cracks and joints only, insertion on demand
  DamageChoice damage;  ///< without a law here and there the rock cannot break
  InsertionPolicy insertion;
  ContactMaterial contact;          ///< of faces that have moved past their partner
  bool absorbing_boundary = false;  ///< outer boundary: absorbing, or fixed
  bool free_boundary = false;       ///< or free: it bears the in-situ stress as a constant load
  std::vector<Load> loads;          ///< on parts of it, where it is then not held; not with an absorbing one
  std::vector<Index> cracks;        ///< mesh edges broken from the start
  std::vector<Index> dry_cracks;    ///< those of them that the fluid is not in at first, ascending
  bool joints_edge_by_edge =
      false;  ///< the fluid enters a joint's edges as they open; else a whole joint at once
  std::optional<CompressibleFluid> fluid;
  bool wets_damaged =
      false;  ///< the fluid enters elements and triangles that have begun to open; else broken ones
  std::optional<FractureFluid> flow;  ///< pressure falls along fractures; none: one pressure in each cavity
  double initial_pressure = 0.0;      ///< of the fluid, above pore_pressure [Pa]
  double pore_pressure = 0.0;         ///< of the formation: only what is told of pressures has it added [Pa]
  Pump pump;
  bool fast_forward = false;  ///< the elastic ramp by linear solves, where it holds
  double thickness = 1.0;     ///< for magnitudes [m]
  double slip_rate = 1e-2;    ///< at which slip of a joint or in general contact is an event [m/s]
  bool breaks() const { return law != nullptr || damage.law != nullptr; }
  /// The rock is whole and held, and a pump presses it: the elastic ramp may be found by static solves.
  bool may_ramp() const;
};

/// Lumps the mass of every triangle to its corners.
void set_mass(State& state, const Bulk& bulk);

/// Gives elements on all edges their materials, joints those of theirs.
void set_materials(State& state, const Scene& scene, const EdgeMaterials& materials);

/// Shear wave of the slowest of the rocks [m/s].
double slowest_shear_wave(const Scene& scene);

/// Energies per metre of thickness [J/m], at full steps; stored ones are changes since the start of
/// the dynamics, dissipated ones sums of their own increments.
struct Energies {
  double kinetic = 0.0;
  double strain = 0.0;    ///< rock, with the work against the in-situ stress
  double cohesive = 0.0;  ///< recoverable energy of cohesive elements and closed faces
  double fracture = 0.0;
  double friction = 0.0;
  double viscous = 0.0;
  double fluid = 0.0;
  double external = 0.0;  ///< work of the pump and of loads, less what an absorbing boundary took
  /// What the method itself gave to the rock, known errors that are computed where they arise: see
  /// Dissipation.
  double inserted = 0.0, path = 0.0;
  double residual = 0.0;  ///< |stored + dissipated − external − inserted − path| over the largest of them so
                          ///< far (or what strains of 3e-7 everywhere hold, if that is more)
};

/// What a simulation keeps beside its State, so that another can go on from there.
struct SimulationMemory {
  Energies reference;          ///< stored energies at the start [J/m]
  double scale = 0.0;          ///< largest energy so far [J/m]
  StableStep stable;           ///< at the start
  Index geostatic_slips = 0;   ///< elements beyond their strength in the geostatic stage
  double slowed = 1.0;         ///< share of the step that inserted elements leave
  Index rough_insertions = 0;  ///< elements inserted where forces jumped
  std::vector<std::uint8_t>
      stressed;  ///< per triangle, of the last step; empty: nothing is inserted on demand
  std::vector<BoundaryNode> boundary;  ///< of an absorbing boundary
  LoadsMemory loads;
};

/// The dynamic loop: explicit steps of a scene from its geostatic equilibrium on.
class Simulation {
 public:
  /// Sets the scene in equilibrium: in-situ stress, excavation, initial pressure; by a linear solve,
  /// and by relaxation where something slips or breaks on the way. @throws NumericalError
  explicit Simulation(Scene scene);
  /// Goes on, bit by bit, where another simulation of the same scene was.
  Simulation(Scene scene, State state, SimulationMemory memory);
  SimulationMemory memory() const;

  const State& state() const { return state_; }
  State& state() { return state_; }
  const Scene& scene() const { return scene_; }
  const Bulk& bulk() const { return bulk_; }
  /// Stress in a triangle [Pa]: Cauchy, or effective in the frame that turns with it where it is damaged.
  Sym2 stress(Index triangle) const;
  const Damage* damage() const { return damage_ ? &*damage_ : nullptr; }
  const Cohesive* cohesive() const { return cohesive_ ? &*cohesive_ : nullptr; }
  const Fluid* fluid() const { return fluid_ ? &*fluid_ : nullptr; }
  /// The stable step at the start, and what limits it.
  const StableStep& stable() const { return stable_; }
  /// The stable step now [s]: shorter where faces are in general contact.
  double stable_limit() const;
  const Stopwatch& stopwatch() const { return stopwatch_; }
  /// Elements that were beyond their strength in the geostatic stage; 0: it was elastic.
  Index geostatic_slips() const { return geostatic_slips_; }
  /// Elements inserted on demand that could not bear at once what their edge bore: forces jumped there.
  Index rough_insertions() const { return rough_insertions_; }
  double wellbore_pressure() const;  ///< with Scene::pore_pressure [Pa]; 0 without fluid

  /// End of the elastic ramp [s], up to which the state follows from static solves; 0: no ramp. It is
  /// there where elements come on demand, no crack is cut, the boundary is fixed, no edge is at its threshold
  /// at the start, and the ramp lasts twice as long as a shear wave takes round the wellbore.
  double ramp_end() const { return ramp_end_; }
  /// Sets the state on the ramp at a time [s], first at 0 and then ever later. @return the energies there
  Energies ramp_to(double time);

  /// One explicit step of length dt [s].
  void step(double dt) { advance(dt, nullptr); }
  /// The same, with the energies at the time before the step. @throws NumericalError when anything
  /// is not finite
  Energies step_and_account(double dt);
  /// Events of the last step: what broke, and slips of joints and of faces in general contact that ended.
  const std::vector<SeismicEvent>& new_events() const { return new_events_; }
  /// Forces and displacements of Scene::loads, one each, since the last call.
  std::vector<LoadRecord> take_loads();
  /// Ends the slips that are under way, at the end of a run.
  std::vector<SeismicEvent> end_slips() { return with_edges_of_mesh(finish_slip(state_.slips, medium())); }

  /// Largest unbalanced force over the largest corner force: how far from static equilibrium.
  double imbalance();

 private:
  static std::vector<Index> wetted_edges(const Scene& scene);
  std::vector<Vec2> geostatic_displacement();
  void find_ramp(const StaticSolver& solver, State& wet, std::optional<Fluid>& fluid,
                 const std::vector<Vec2>& first);
  void settle();
  void bear_geostatic_loads(std::vector<Vec2> forces);
  Energies with_residual(Energies e);
  void relax();
  void grade_masses();
  void come_to_rest();
  void advance(double dt, Energies* account);
  void move_nodes(double dt);
  void heed_activated();
  Tiles::Physics physics() const { return {bulk_, cohesive()}; }
  void listen_to_slips();
  std::vector<SeismicEvent> with_edges_of_mesh(std::vector<SeismicEvent> slips) const;
  static double longest_joint_edge(const Mesh& mesh);
  SeismicMedium medium() const;
  void cut_cracks();
  void part_tips();
  void unbond_joints();
  void wet_joints();
  void prepare_insertion();
  void set_screen();
  void add_tied_edges_at(Index vertex, std::vector<Index>& edges) const;
  void insert_stressed();
  void begin_damage();
  void crack_stressed();
  /// @param material of a joint; 0: that of the rock round each
  void insert(const std::vector<Index>& edges, std::uint16_t material = 0);
  void break_overstressed();
  void insert_joints();
  Energies potential_energies() const;
  /// ½ Σ m v_before · v [J/m]
  double kinetic_energy(const std::vector<Vec2>& before) const;
  [[noreturn]] void stop_not_finite() const;

  Scene scene_;
  EdgeMaterials materials_;
  State state_;
  Bulk bulk_;
  std::optional<Cohesive> cohesive_;
  std::optional<Damage> damage_;
  std::optional<GeneralContact> contact_;
  std::optional<Fluid> fluid_;
  std::optional<AbsorbingBoundary> boundary_;
  std::optional<Loads> loads_;
  StableStep stable_;
  Stopwatch stopwatch_;
  std::vector<SeismicEvent> new_events_;
  std::optional<Tiles> tiles_;
  std::size_t active_known_ = 0;  // of the active elements, to the tiles
  std::vector<Vec2> velocity_before_;
  StressScreen screen_;                 // on demand: near the threshold
  std::vector<std::uint8_t> stressed_;  // per triangle, of the last step
  std::vector<char> block_stressed_;    // per block of triangles: any
  double slowed_ = 1.0;                 // share of the step that inserted elements leave
  Index rough_insertions_ = 0;
  std::optional<Ramp> ramp_;
  double ramp_end_ = 0.0;
  Energies reference_;  // stored energies at the start
  double scale_ = 0.0;  // largest energy so far
  Index geostatic_slips_ = 0;
  double longest_joint_edge_ = longest_joint_edge(*scene_.mesh);  // [m]; 0: no joints
};

}  // namespace crackle
