// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "crackle/core/parallel.hpp"
#include "crackle/core/vec2.hpp"
#include "crackle/mesh/mesh.hpp"
#include "crackle/state/slip_memory.hpp"

namespace crackle {

/// Life of a cohesive element.
enum class CohesiveStatus : std::uint8_t {
  intact = 0,    ///< on its elastic branch, evaluated by the fast loop
  active = 1,    ///< near or past its strength: evaluated point by point, from then on
  broken = 2,    ///< no cohesion left; faces still lie opposite one another and touch as a pair
  released = 3,  ///< faces have moved past one another: general contact looks after them
};

/// One of the three integration points of an active cohesive element (ends 0 and 1, middle 2).
struct CohesivePoint {
  // history
  double damage = 0.0;        ///< D, 0 intact ... 1 broken [-]
  double opening_max = 0.0;   ///< largest opening since the point yields [m]
  double slip_max = 0.0;      ///< largest |slip| since the point yields [m]
  double plastic_slip = 0.0;  ///< of the friction spring [m]
  // last evaluated state, for the work of the next step
  double opening = 0.0;   ///< [m]
  double slip = 0.0;      ///< [m]
  double normal = 0.0;    ///< traction across, tension positive [Pa]
  double shear = 0.0;     ///< cohesive part of the traction along [Pa]
  double friction = 0.0;  ///< frictional part of the traction along [Pa]
  double stored = 0.0;    ///< recoverable energy [J/m2]
  double inserted = 0.0;  ///< given to the spring when it was inserted under load [J/m2]
  double repaid = 0.0;    ///< of it, paid back by breaking [J/m2]
  double path = 0.0;      ///< given by the law (taken: negative) where it has no potential [J/m2]

  /// Recoverable energy that came from the rock [J/m2]. What insertion gave, and the rock may have had from
  /// the spring since, the breaking pays back before it dissipates: neither makes energy.
  double recoverable() const { return stored - inserted + repaid; }
};

/// History of one cohesive element that was inserted on demand, is active or broken. While it is intact its
/// points are those of when it was last loaded by an insertion.
struct CohesiveHistory {
  Index element = -1;
  std::array<CohesivePoint, 3> point;
  double penalty = 0.0;               ///< of its springs [Pa]; 0: its material's
  double fracture_energy = 0.0;       ///< dissipated by breaking [J/m]
  double sliding_work = 0.0;          ///< part of fracture_energy done in shear [J/m]
  double friction_energy = 0.0;       ///< dissipated by friction [J/m]
  double made_energy = 0.0;           ///< given back beyond what it held: an error of the steps [J/m]
  double slid = 0.0;                  ///< in the last step, past sticking: mean over its points [m]
  double rubbed = 0.0;                ///< dissipated by friction in the last step [J/m]
  double yield_time = -1.0;           ///< first damage [s]; -1: none yet
  std::array<double, 4> face_mass{};  ///< see face_masses(), once it yields [kg/m]
  double kinetic_at_yield = 0.0;      ///< of its faces, see face_kinetic_energy() [J/m]
  double kinetic_rise = 0.0;          ///< largest rise above kinetic_at_yield [J/m]
  double break_time = -1.0;           ///< [s]; -1: not broken
  std::int8_t mode = 0;               ///< FailureMode once broken
};

/// Forces per metre of thickness [N/m] that an element puts on face a at its two ends; face b
/// gets the opposite.
struct EndForces {
  Vec2 end0, end1;
};

/// Cohesive elements as plain arrays, one entry an element.
struct CohesiveElements {
  std::vector<Index> edge;                  ///< of the mesh
  std::vector<std::array<Index, 4>> nodes;  ///< a0, a1, b0, b1: faces a and b at ends 0 and 1
  std::vector<Vec2> direction;              ///< end1 − end0 in the reference state [m]
  std::vector<double> inverse_length;       ///< of direction [1/m]
  std::vector<std::array<double, 4>>
      offset;  ///< opening0, slip0, opening1, slip1 that make the traction borne at insertion [m]
  std::vector<std::uint16_t> material;  ///< number of its material
  std::vector<EndForces> force;         ///< of the last evaluation
  std::vector<CohesiveStatus> status;
  std::vector<Index> history_of;           ///< into histories; -1: none, intact
  std::vector<CohesiveHistory> histories;  ///< in the order in which they began
  std::vector<Index> active;               ///< elements that are not intact, in order of activation
  std::vector<Index> of_edge;              ///< element of a mesh edge; -1: tied, or a boundary

  Index count() const { return static_cast<Index>(edge.size()); }
};

/// A triangle with a smeared crack in it. Strains are over its element length; index 0 is across the
/// crack (opening), 1 along it (slip).
struct DamagedTriangle {
  Index triangle = -1;
  Vec2 normal;                       ///< of the crack, unit, in the frame that turns with the triangle
  double length = 0.0;               ///< over which the crack is smeared: area over length of crack [m]
  std::array<double, 2> strength{};  ///< at which it softens [Pa]
  std::array<double, 2> history{};   ///< largest opening, slip, over G/strength [-]
  double slip_strain = 0.0;          ///< slip of what is broken of it [-]
  Sym2 offset;                       ///< strain that a closed, failed triangle bears nothing at [-]
  std::uint8_t open = 1;             ///< 1: its faces are apart
  std::uint8_t failed = 0;           ///< 1: bears no tension any more
  double damage = 0.0;               ///< the larger of both directions', 0 to 1 [-]
  double opening = 0.0;              ///< w_n times length [m]
  double slip = 0.0;                 ///< w_s times length [m]
  double opening_strain = 0.0;       ///< across, the elastic part included, of the last evaluation [-]
  double friction = 0.0;             ///< on what is broken, of the last evaluation [Pa]
  Sym2 stress;                       ///< in that frame [Pa]
  double stored = 0.0;               ///< recoverable energy, from the in-situ state [J/m]
  double fracture_energy = 0.0;      ///< dissipated by breaking [J/m]
  double sliding_work = 0.0;         ///< part of it done in shear [J/m]
  double dropped = 0.0;              ///< part of it that failed at once [J/m]
  double friction_energy = 0.0;      ///< dissipated by friction [J/m]
  double yield_time = 0.0;           ///< of initiation [s]
  double kinetic_at_yield = 0.0;     ///< of its corners [J/m]
  double kinetic_rise = 0.0;         ///< largest rise above kinetic_at_yield until it fails [J/m]
  Index cavity = -1;                 ///< whose fluid is in it; -1: dry
  std::array<Vec2, 3> force;         ///< on its corners, of the last evaluation [N/m]
};

struct DamageState {
  std::vector<DamagedTriangle> triangles;  ///< in order of initiation
  std::vector<Index> of_triangle;          ///< into triangles; -1: intact. Empty where nothing is damaged
  Index lowered = 0;                       ///< triangles above the size limit, whose strength was lowered
};

/// A connected volume of fluid.
struct Cavity {
  double mass = 0.0;      ///< per metre of thickness [kg/m]
  double pressure = 0.0;  ///< [Pa]
  double volume = 0.0;    ///< per metre of thickness [m2]
  double injected = 0.0;  ///< at reference density [m2]
  double work = 0.0;      ///< done by the pump [J/m]
};

/// Fluid of an edge, or of the wellbore, where pressure differs from place to place.
struct FlowCell {
  Index edge = -1;        ///< of the mesh; -1: the wellbore
  double mass = 0.0;      ///< per metre of thickness [kg/m]
  double pressure = 0.0;  ///< [Pa]
  double volume = 0.0;    ///< per metre of thickness [m2]
  double gained = 0.0;    ///< of it, in the last step [m2]
};

struct FluidState {
  std::vector<Cavity> cavities;         ///< 0 is the wellbore; a merged cavity stays with zero mass
  std::vector<Index> cavity_of_edge;    ///< per mesh edge; -1: dry
  std::vector<Index> cavity_of_vertex;  ///< per mesh vertex; -1: not reached
  std::vector<FlowCell> cells;          ///< by edge; empty: a cavity has one pressure
};

/// Cumulative energies that are sums of increments, per metre of thickness [J/m].
struct Dissipation {
  double fracture = 0.0;
  double friction = 0.0;
  double viscous = 0.0;
  double boundary = 0.0;  ///< radiated through an absorbing boundary
  double made = 0.0;      ///< not dissipated: given back by cohesive elements beyond what they held
  /// Given to the rock by springs that were inserted under load and broke before they had paid it back: all
  /// of an element breaks when two of its points have, and the third's debt goes with it. And to the fluid,
  /// by closed faces that overlap where it comes to them.
  double inserted = 0.0;
  double path = 0.0;  ///< given to the rock by laws without a potential, see law.hpp; negative: taken
};

/// A point of a free side (3 t + i: side i of triangle t) that touches another free side, or that
/// lay behind it when it was first looked at.
struct ContactPoint {
  Index side = -1;            ///< that carries the point
  Index place = 0;            ///< on it: 0 its start, 1 its end, 2 its middle
  Index target = -1;          ///< side that it touches
  double depth = 0.0;         ///< of the point behind the target [m]; negative: a gap
  double offset = 0.0;        ///< depth at which it bears nothing [m]
  double slip = 0.0;          ///< along the target since it touched [m]
  double plastic_slip = 0.0;  ///< of the friction spring [m]
};

struct ContactState {
  std::vector<ContactPoint> points;  ///< in order of side, place, target
  Index broken = -1;  ///< elements broken or released when free sides were last looked up; -1: never
  std::vector<std::array<Vec2, 2>>
      listed;          ///< ends of the free sides when those that may meet were listed [m]
  double moved = 0.0;  ///< bound of the motion of two sides against one another since [m]
};

/// Strain rates of a block of triangles [1/s], in rows of eight as the step takes them: component k of
/// triangle i is in row 3 (i mod 32) + k, at i / 32.
struct alignas(64) StrainRates {
  static constexpr Index groups = block_size / 8;
  std::array<double, 3 * static_cast<std::size_t>(block_size)> number{};

  static constexpr std::size_t place(Index i) {
    return 24 * static_cast<std::size_t>(i % groups) + static_cast<std::size_t>(i / groups);
  }
  Sym2 of(Index i) const { return {number[place(i)], number[place(i) + 8], number[place(i) + 16]}; }
  void set(Index i, Sym2 rate) {
    number[place(i)] = rate.xx;
    number[place(i) + 8] = rate.yy;
    number[place(i) + 16] = rate.xy;
  }
};

/// Every number that changes during a run, as plain arrays: what a checkpoint saves.
///
/// A triangle has three corners (corner 3 t + i). A node is a group of corners that move together:
/// with cohesive elements on all edges every corner is a node of its own, without any the corners
/// round a vertex are one node, and part into the fans that are still tied as elements are inserted.
/// Corners of a node are a segment of `node_corners`.
struct State {
  std::shared_ptr<const Mesh> mesh;

  double time = 0.0;  ///< [s]
  std::int64_t step = 0;
  double time_step = 0.0;  ///< of the last step [s]

  // nodes
  std::vector<Index> node_of_corner;
  std::vector<Index> node_corners;   ///< corners grouped by node
  std::vector<Index> node_first;     ///< first of a node in node_corners
  std::vector<Index> node_size;      ///< corners of a node
  std::vector<Vec2> displacement;    ///< from the in-situ state [m]
  std::vector<Vec2> velocity;        ///< half a step behind the displacement [m/s]
  std::vector<double> inverse_mass;  ///< [m/kg]; 0: fixed

  // triangles
  std::vector<double> density;  ///< [kg/m3]; empty: the same in all
  std::vector<StrainRates>
      strain_rate;  ///< by blocks of triangles, of the last evaluation; empty without viscosity

  CohesiveElements cohesive;
  std::vector<Index>
      element_on_side;  ///< per corner 3 t + i: 2 x element + (1 on face b) on side i; -1: none
  DamageState damage;
  ContactState contact;
  FluidState fluid;
  Dissipation dissipation;
  SlipMemory slips;

  /// [1/s]
  Sym2 strain_rate_of(Index triangle) const {
    return strain_rate[static_cast<std::size_t>(triangle / block_size)].of(triangle % block_size);
  }
  Index node_count() const { return static_cast<Index>(displacement.size()); }
  Vec2 reference(Index corner) const {
    return mesh->vertices[static_cast<std::size_t>(
        mesh->triangles[static_cast<std::size_t>(corner / 3)][static_cast<std::size_t>(corner % 3)])];
  }
  /// Reference position of a node [m].
  Vec2 node_reference(Index node) const {
    return reference(node_corners[static_cast<std::size_t>(node_first[static_cast<std::size_t>(node)])]);
  }
  /// Current position of a corner [m].
  Vec2 position(Index corner) const {
    return reference(corner) +
           displacement[static_cast<std::size_t>(node_of_corner[static_cast<std::size_t>(corner)])];
  }
};

/// A state at rest with one node a corner: every interior edge can carry a cohesive element.
State make_split_state(std::shared_ptr<const Mesh> mesh);

/// A state at rest with one node a vertex: every interior edge is tied.
State make_tied_state(std::shared_ptr<const Mesh> mesh);

/// Lumps the mass of every triangle to its corners, a third each. @param density [kg/m3], of all triangles
void set_mass(State& state, double density);
/// @param density of each triangle, which the state keeps
void set_mass(State& state, std::vector<double> density);

/// Holds all nodes on edges of that kind (inverse mass 0).
void fix_nodes(State& state, EdgeKind kind);

/// Adds a cohesive element on every interior edge; needs a split state. Offsets are zero.
void insert_all(State& state);

/// Corners at a mesh vertex, of all its nodes, in a state that was made tied.
std::span<const Index> corners_at(const State& state, Index vertex);

/// A node that has parted into several, each a fan of corners round a vertex that are still tied.
struct Parting {
  Index vertex = -1;
  std::vector<Index> nodes;  ///< the first kept its number
};

/// Adds cohesive elements, without a history yet, on tied interior edges of a state that was made tied,
/// and parts the nodes at their ends: mass goes with the corners, displacement and velocity are
/// copied, so mass and momentum are the same to round-off.
/// @param edges in ascending order @param material number of each @return nodes that parted, by vertex
std::vector<Parting> insert_elements(State& state, std::span<const Index> edges,
                                     std::span<const std::uint16_t> material);

/// Mass [kg/m] of a corner, a third of its triangle's: the same however many corners move together as a node.
/// 0 where the node is fixed.
double corner_mass(const State& state, Index corner);
/// Kinetic energy [J/m] of it.
double corner_kinetic_energy(const State& state, Index corner);

/// Masses [kg/m] of the four corners at the faces of a cohesive element (a0, a1, b0, b1).
std::array<double, 4> face_masses(const State& state, Index element);

/// Kinetic energy [J/m] of these corners.
double face_kinetic_energy(const State& state, Index element, const std::array<double, 4>& masses);
inline double face_kinetic_energy(const State& state, Index element) {
  return face_kinetic_energy(state, element, face_masses(state, element));
}

}  // namespace crackle
