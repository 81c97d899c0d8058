// SPDX-License-Identifier: GPL-3.0-or-later
//
// Viscous flow in a network of fractures beside explicit steps of the rock: implicit, so that it does not
// limit the step (explicit flow would, to Δt ≤ 6 μ L²/(K_f w²): 1e-9 s for a crack of 0.1 mm in water).
//   cell      m_c = m_cⁿ + Δt (ρ₀ Q_c + ρ₀ Σ_d T_cd (p_d − p_c)),   m_c = ρ(p_c) V_c
//   volume    V_c = V_c* + Δt² Σ_d S_cd p_d,   S_cd = Σ_nodes ∂V_c/∂x · ∂V_d/∂x / mass
//   filling   m_c < ρ(p_cav) V_c: the cell is not full, and p_c = p_cav
// with V* after the rock has moved without the fluid, and T by the cubic law (fracture_flow.hpp) of the
// apertures then. A cell is a wetted edge of the mesh between two triangles, or the wellbore. In limits it is
// the cavity of one pressure (μ → 0) and the incompressible fluid (K_f → ∞).
//
// | parameter           | unit | range | meaning                                                      |
// |---------------------|------|-------|--------------------------------------------------------------|
// | viscosity           | Pa s | > 0   | μ                                                            |
// | reference_density   | kg/m3| >= 0  | 0: all flow is laminar                                       |
// | smallest_aperture   | m    | > 0   | what closed, broken faces leave open, for flow and storage   |
// | cavitation_pressure | Pa   | any   | p_cav, of what is not full; as dry fractures by default: 0   |
//
// Limits: inertia of the fluid along the fracture is left out; no leak-off; no smeared damage.
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "crackle/fluid/compressible.hpp"
#include "crackle/fluid/fracture_flow.hpp"
#include "crackle/state/state.hpp"

namespace crackle {

/// An entry of a sparse matrix.
struct MatrixEntry {
  Index row = 0, column = 0;
  double value = 0.0;
};
/// Solves A x = b: entries of A, their places the same from call to call until `fresh`; b becomes x.
/// @throws NumericalError when A is singular
using SparseSolver = std::function<void(std::span<const MatrixEntry>, std::span<double>, bool fresh)>;

/// What it takes to have viscous flow.
struct FlowChoice {
  FractureFluid law;
  SparseSolver solver;
};

class ViscousFlow {
 public:
  ViscousFlow(CompressibleFluid fluid, FlowChoice choice);

  /// Cells that are wet and not yet in the state join it, empty; all that is derived is made anew.
  void take_up(State& state);
  /// The same of a state whose cells are complete.
  void rebuild(const State& state);
  /// Fills all cells at the pressures of their cavities.
  void fill(State& state);

  /// One step after the rock has moved without the fluid: cells' masses and pressures, then the wetted nodes,
  /// viscous dissipation, the cavities' sums. @param injected into the wellbore, or where there is none into
  /// the edges at the wetted vertex nearest to the origin [m2]
  void advance(State& state, double dt, double injected);

  double energy(const State& state) const;                ///< [J/m]
  double lost_ahead() const { return lost_ahead_; }       ///< in the last step, after its beginning [J/m]
  double pressure(const State& state, Index edge) const;  ///< in a wet edge [Pa]
  /// Calls `add(corner, force)` [N/m] for every share of a cell in a corner, at present pressures.
  void for_each_load(const State& state, const std::function<void(Index, Vec2)>& add) const;

 private:
  struct Polygon {  // encloses fluid when its corners are taken in order, anticlockwise
    Index cell;
    double weight;
    std::vector<Index> corners;
  };
  struct Touch {  // a node at a cell
    Index node, cell;
    Vec2 gradient;  // of the cell's volume
  };
  struct Link {  // between two cells, or of one in the star of a vertex
    Index a, b;
    std::size_t star;
  };

  void add_polygons(const State& state);
  void measure(const State& state);
  void set_conductances(const State& state, double dt);
  void move(State& state, double dt) const;
  double mass_at(std::size_t cell, double pressure) const;  // in its volume, over reference density [m2]
  double held_energy(double mass, double volume) const;     // [J/m]; mass [kg/m]
  bool find_pressures(const State& state, double dt, const std::vector<double>& inflow);

  CompressibleFluid fluid_;
  FlowChoice choice_;
  std::vector<Index> cell_of_edge_;
  std::vector<double> length_;  // of a cell; 0: the wellbore
  std::vector<Polygon> polygons_;
  std::vector<std::vector<std::size_t>> slots_;  // per polygon: touch of each corner's node
  std::vector<Touch> touches_;                   // by node
  std::vector<std::vector<Index>> stars_;        // cells round a vertex
  std::vector<Link> links_;
  std::vector<double> conductance_;  // per link, times the step [m2/Pa]
  std::vector<Index> inlets_;
  bool fresh_ = true;
  double lost_ahead_ = 0.0;
  // of a step, per cell
  std::vector<double> start_;     // V* [m2]
  std::vector<double> implicit_;  // share of the pressure at the step's end in what pushes
  std::vector<double> pressure_, push_, volume_;
  std::vector<char> full_;
  std::vector<MatrixEntry> softness_;  // Δt² S
  std::vector<MatrixEntry> matrix_;
  std::vector<double> right_;
};

}  // namespace crackle
