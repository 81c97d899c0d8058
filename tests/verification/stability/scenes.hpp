// SPDX-License-Identifier: GPL-3.0-or-later
//
// Small scenes that drive the program to where explicit FDEM codes fail: the list T1 to T15 of the stability
// map (cases/stability). Each runs with one setting at one point of the map:
//   all, on_demand, tied            which edges carry elements
//   damage                          none but those of the notch: smeared damage
//   ... "-naive"                    what the program does not do: shown beside, to be seen to fail
#pragma once

#include <limits>
#include <string>
#include <vector>

#include "../../granite.hpp"

namespace crackle::stability {

inline constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

/// A point of the map: one line of points.csv.
struct Row {
  std::string scene, setting;
  double x = 0.0, y = 0.0;     ///< what is varied
  double predicted = unknown;  ///< by theory, and what was found; what they are says the scene
  double measured = unknown;
  double bound = unknown;       ///< proven bound, where predicted is an estimate
  double joint_work = unknown;  ///< into the cohesive elements, over fracture energy x area broken
  double dissipated = unknown;  ///< by breaking, over the same
  double made = unknown;        ///< energy that elements made, over what they dissipated
  long broken = 0, stray = 0;   ///< elements; of them away from any fracture
  double fastest = unknown;     ///< node [m/s]
  std::string alarm = {};       ///< the first that stops a run
  long alarm_step = -1;
};

/// Whether a setting is the naive one, and what stands before that.
inline bool is_naive(const std::string& setting) { return setting.ends_with("-naive"); }
inline std::string insertion_of(const std::string& setting) {
  return setting.substr(0, setting.find("-naive"));
}

/// A pre-strained strip with a notch that is let go, G0 = 1.2 G (T1). x: step over the stable one, which for
/// "all" is that of Lanczos and for "on_demand" the program's own. predicted 1.
Row strip(const std::string& setting, double x);

/// Step at which a slightly disturbed body blows up, over h √(ρ/E); predicted: Lanczos; bound: the program's
/// own. "on_demand": elements on every fifth edge.
Row penalty(const std::string& setting, double x);    ///< x: penalty over E (T4)
Row damping(const std::string& setting, double x);    ///< x: viscosity over critical (T5)
Row viscosity(const std::string& setting, double x);  ///< x: edge over 50 mm at fixed viscosity (T5, h²)
Row poisson(const std::string& setting, double x);    ///< x: Poisson's ratio (T3)
Row skew(const std::string& setting, double x);       ///< x: smallest angle [degrees] (T2)

/// Edges cut under 20 MPa, handed to general contact (T9). x: contact over cohesive penalty; measured:
/// kinetic energy over σ²h/p_f x length; predicted: ½/x where nothing is handed over (what the contact's own
/// spring takes up), 0 for the program's.
Row handover(const std::string& setting, double x);

/// A thin closed crack full of fluid (T8). x: bulk modulus [Pa], y: aperture [m]; measured: largest speed
/// over that of the elastic rebound; predicted: (ω_f Δt)² of the fluid at the dry step; naive: the fluid
/// explicit.
Row thin_crack(const std::string& setting, double x, double y);

/// Elements that come into stressed rock (T6). x: stress over strength; measured: wave over the stress.
Row activation(const std::string& setting, double x);

/// Rigid rotation (T7). x: angle [degrees]; measured: stress over E; naive: small strains.
Row rotation(const std::string& setting, double x);

/// Positions in single precision (T14). x: distance from the origin [m]; measured: noise of the traction over
/// the tensile strength; predicted: p_f ulp(x) / (h f_t); not naive: displacements in single precision.
Row precision(const std::string& setting, double x);

/// A pump that draws from a closed hole (T15). x: share of the fluid drawn; measured, predicted: pressure
/// [Pa].
Row drawing(const std::string& setting, double x);

/// A lattice of triangles, pulled in all directions, with a notch turned in it (x [degrees]): what the
/// direction of a mesh does to strength. measured: largest stress over that of the straight cohesive crack.
Row turned(const std::string& setting, double x);

/// Any of them by name. @throws std::invalid_argument
Row run(const std::string& scene, const std::string& setting, double x, double y);

/// Makes a row of edges, given by their number in the mesh, elements that do not break of themselves, so that
/// they can be cut by hand, however the others are inserted.
void prepare_cut(Scene& scene, const std::vector<Index>& edges);
void cut(Simulation& simulation, const std::vector<Index>& edges);

/// Interior edges on y = 0 with both ends at |x − centre| <= half.
std::vector<Index> edges_on_axis(const Mesh& mesh, double centre, double half);

}  // namespace crackle::stability
