// SPDX-License-Identifier: GPL-3.0-or-later
#include "newton.hpp"

#include <Eigen/Dense>
#include <Eigen/SparseCore>
#include <Eigen/SparseLU>
#include <cmath>

#include "bore.hpp"
#include "dynamics.hpp"

namespace crackle::quasi_static {
namespace {

std::size_t at(Index i) { return static_cast<std::size_t>(i); }

constexpr int most_iterations = 30;
constexpr double rock_tolerance = 1e-8;
constexpr double fluid_tolerance = 1e-8;
constexpr double bore_tolerance = 1e-10;  // where a step of the well alone is all there is to find
constexpr double round_off = 1e-15;
constexpr double pressure_unit = 1e6;  // [Pa]
constexpr double rate_unit = 1e-4;     // [m2/s]
constexpr double jump_unit = 1e-6;     // [m], in motion

double opening_of(const std::vector<JumpTerm>& terms, const std::vector<double>& jumps) {
  double w = 0.0;
  for (const JumpTerm& t : terms) w += t.normal * jumps[at(t.unknown)];
  return w;
}
double slip_of(const std::vector<JumpTerm>& terms, const std::vector<double>& jumps) {
  double s = 0.0;
  for (const JumpTerm& t : terms) s += t.tangent * jumps[at(t.unknown)];
  return s;
}

// The equations of one Newton iteration. Unknowns of the fluid: pressures of wet cells, rates of
// inlets, pressure of the well.
class System {
 public:
  System(const Equations& equations, const State& state, double dt, double rate)
      : e_(equations), s_(state), dt_(dt), rate_(rate) {
    jumps_ = static_cast<Index>(e_.path.unknowns().size());
    pressure_.assign(s_.cells.size(), -1);
    if (dt_ > 0.0) {
      for (std::size_t c = 0; c < s_.cells.size(); ++c) {
        if (s_.cells[c].wet) pressure_[c] = fluid_++;
      }
      first_inlet_ = fluid_;
      for (const Inlet& inlet : s_.inlets)
        inlet_.push_back(s_.connected && pressure_[at(inlet.cell)] >= 0 ? fluid_++ : -1);
      well_ = fluid_++;
    }
  }

  Index fluid_unknowns() const { return fluid_; }

  // careful: without the negative slopes of softening, which may turn Newton's step round at the peak
  void assemble(bool careful) {
    careful_ = careful;
    if (!e_.moving) {
      stiffness_.setZero(jumps_, jumps_);
      by_jumps_.setZero(fluid_, jumps_);
    }
    coupling_.clear();
    rock_residual_.setZero(jumps_);
    fluid_residual_.setZero(fluid_);
    by_fluid_.clear();
    fluid_entries_.clear();
    rock_scale_ = fluid_scale_ = fluid_error_ = fluid_noise_ = 0.0;
    if (e_.moving) {
      add_inertia();
    } else {
      add_rock();
      add_bore();
    }
    add_faces();
    if (fluid_ == 0) return;
    add_cells();
    add_vertices();
    add_well();
  }

  bool converged() const {
    if (rock_residual_.lpNorm<1>() > rock_tolerance * rock_scale_) return false;
    return fluid_ == 0 ||
           fluid_error_ + fluid_residual_.head(first_inlet_).lpNorm<1>() <=
               (e_.bore > 0.0 ? bore_tolerance : fluid_tolerance) * fluid_scale_ + fluid_noise_;
  }

  // Newton's step of jumps and fluid unknowns.
  bool solve(Eigen::VectorXd& jumps, Eigen::VectorXd& fluid) const {
    if (e_.moving) return solve_sparse(jumps, fluid);
    if (fluid_ == 0) {
      jumps = stiffness_.partialPivLu().solve(-rock_residual_);
      return jumps.allFinite();
    }
    // Rows scaled by their largest entry; right-hand sides [∂R/∂jumps | R].
    Eigen::VectorXd largest = Eigen::VectorXd::Zero(fluid_);
    for (const auto& t : fluid_entries_) largest[t.row()] += std::abs(t.value());
    std::vector<Eigen::Triplet<double>> scaled = fluid_entries_;
    for (auto& t : scaled) t = {t.row(), t.col(), t.value() / largest[t.row()]};
    Eigen::SparseMatrix<double> matrix(fluid_, fluid_);
    matrix.setFromTriplets(scaled.begin(), scaled.end());
    Eigen::SparseLU<Eigen::SparseMatrix<double>> lu(matrix);
    if (lu.info() != Eigen::Success) return false;
    Eigen::MatrixXd right(fluid_, jumps_ + 1);
    right.leftCols(jumps_) = by_jumps_;
    right.col(jumps_) = fluid_residual_;
    right.array().colwise() /= largest.array();
    const Eigen::MatrixXd x = lu.solve(right);
    Eigen::MatrixXd condensed = stiffness_;
    Eigen::VectorXd load = -rock_residual_;
    for (const auto& t : by_fluid_) {
      condensed.row(t.row()) -= t.value() * x.row(t.col()).head(jumps_);
      load[t.row()] += t.value() * x(t.col(), jumps_);
    }
    jumps = condensed.partialPivLu().solve(load);
    fluid = -x.col(jumps_) - x.leftCols(jumps_) * jumps;
    return jumps.allFinite() && fluid.allFinite();
  }

  // All unknowns at once, rows scaled by their largest entry.
  bool solve_sparse(Eigen::VectorXd& jumps, Eigen::VectorXd& fluid) const {
    std::vector<Eigen::Triplet<double>> all;
    for (const auto& t : coupling_) all.emplace_back(t.row(), t.col(), jump_unit * t.value());
    for (const auto& t : by_fluid_) all.emplace_back(t.row(), jumps_ + t.col(), t.value());
    for (const auto& t : fluid_entries_) all.emplace_back(jumps_ + t.row(), jumps_ + t.col(), t.value());
    Eigen::VectorXd largest = Eigen::VectorXd::Zero(jumps_ + fluid_);
    for (const auto& t : all) largest[t.row()] = std::max(largest[t.row()], std::abs(t.value()));
    for (auto& t : all) t = {t.row(), t.col(), t.value() / largest[t.row()]};
    Eigen::SparseMatrix<double> matrix(jumps_ + fluid_, jumps_ + fluid_);
    matrix.setFromTriplets(all.begin(), all.end());
    Eigen::SparseLU<Eigen::SparseMatrix<double>> lu(matrix);
    if (lu.info() != Eigen::Success) return false;
    Eigen::VectorXd residual(jumps_ + fluid_);
    residual << rock_residual_, fluid_residual_;
    const Eigen::VectorXd step = lu.solve(-(residual.array() / largest.array()).matrix());
    jumps = jump_unit * step.head(jumps_);
    fluid = step.tail(fluid_);
    return step.allFinite();
  }

  // Forces of faces and the fluid in them on the jumps.
  std::vector<double> face_forces() {
    coupling_.clear();
    by_fluid_.clear();
    stiffness_.setZero(e_.moving ? 0 : jumps_, e_.moving ? 0 : jumps_);
    rock_residual_.setZero(jumps_);
    add_faces();
    std::vector<double> forces(at(jumps_));
    for (Index k = 0; k < jumps_; ++k) forces[at(k)] = -rock_residual_[k];
    return forces;
  }

  // Share of a step that leaves every closing point at least 30 % of its opening.
  double share(const Eigen::VectorXd& step) const {
    double share = 1.0;
    for (std::size_t c = 0; c < s_.cells.size(); ++c) {
      const auto now = openings(e_.path.edges()[c], s_.jumps);
      for (std::size_t i = 0; i < 2; ++i) {
        if (s_.cells[c].points[i].max_opening <= e_.laws[c].elastic_opening() || now[i] <= 0.0) continue;
        double change = 0.0;
        for (const JumpTerm& t : e_.path.edges()[c].jump[i]) change += t.normal * step[t.unknown];
        if (change < -0.7 * now[i]) share = std::min(share, -0.7 * now[i] / change);
      }
    }
    return share;
  }

  void move(State& state, const Eigen::VectorXd& jumps, const Eigen::VectorXd& fluid, double share) const {
    for (Index k = 0; k < jumps_; ++k) state.jumps[at(k)] += share * jumps[k];
    if (fluid_ == 0) return;
    for (std::size_t c = 0; c < s_.cells.size(); ++c) {
      if (pressure_[c] >= 0) state.cells[c].pressure += share * pressure_unit * fluid[pressure_[c]];
    }
    for (std::size_t i = 0; i < s_.inlets.size(); ++i) {
      if (inlet_[i] >= 0) state.inlets[i].rate += share * rate_unit * fluid[inlet_[i]];
    }
    state.well_pressure += share * pressure_unit * fluid[well_];
  }

 private:
  void add_rock() {
    for (Index i = 0; i < jumps_; ++i) {
      const double* row = e_.rock.row(at(i));
      for (Index j = 0; j <= i; ++j) {
        const double s = row[j];
        stiffness_(i, j) = stiffness_(j, i) = s;
        rock_residual_[i] += s * s_.jumps[at(j)];
        if (j < i) rock_residual_[j] += s * s_.jumps[at(i)];
      }
    }
    rock_scale_ += rock_residual_.lpNorm<1>();
  }

  void add_inertia() {
    const Dynamics& moving = *e_.moving;
    for (const Dynamics::Block& block : moving.blocks()) {
      const std::size_t n = block.unknowns.size();
      for (std::size_t k = 0; k < n; ++k) {
        rock_residual_[block.unknowns[k]] +=
            Dynamics::inertia(block, k, s_.jumps, moving.target(), moving.dt());
        for (std::size_t l = 0; l < n; ++l)
          stiffen(block.unknowns[k], block.unknowns[l],
                  block.inertia[k * n + l] / (moving.dt() * moving.dt()));
      }
    }
    rock_scale_ += rock_residual_.lpNorm<1>();
  }

  // d(force on jump a)/d(jump b), with the sign of a stiffness.
  void stiffen(Index a, Index b, double slope) {
    if (e_.moving) {
      coupling_.emplace_back(a, b, slope);
    } else {
      stiffness_(a, b) += slope;
    }
  }
  // d(row of the fluid)/d(jump).
  void by_jump(Index row, Index jump, double slope) {
    if (e_.moving) {
      coupling_.emplace_back(jumps_ + row, jump, slope);
    } else {
      by_jumps_(row, jump) += slope;
    }
  }

  // What excavation took from the wall of the wellbore, and the pressure of the well on it.
  void add_bore() {
    if (e_.bore == 0.0) return;
    const std::array<double, 2> loads = wall_loads(e_, s_);
    for (Index k = 0; k < jumps_; ++k) {
      for (std::size_t l = 0; l < 2; ++l) {
        const double load = loads[l] * e_.rock.force(l, at(k));
        rock_residual_[k] -= load;
        rock_scale_ += std::abs(load);
      }
      if (well_ >= 0) by_fluid_.emplace_back(k, well_, -e_.rock.force(pressed, at(k)) * pressure_unit);
    }
  }

  // Tractions and pressure on the faces, half an edge to each end.
  void add_faces() {
    for (std::size_t c = 0; c < s_.cells.size(); ++c) {
      const PathEdge& edge = e_.path.edges()[c];
      const Index source = pressure_source(e_, s_, static_cast<Index>(c));
      const double p = source < 0 ? e_.scene.pore_pressure : s_.cells[at(source)].pressure;
      for (std::size_t i = 0; i < 2; ++i) {
        const Point& point = s_.cells[c].points[i];
        MixedTraction t = traction_at(e_, s_, c, i);
        const double weight = 0.5 * edge.length;
        if (careful_) {
          t.nn = std::max(t.nn, 0.0);
          t.ss = std::max(t.ss, 0.0);
        }
        const double load = weight * (p - e_.scene.pore_pressure - t.normal + point.in_situ);
        const double drag = weight * (point.in_situ_shear - t.shear);
        for (const JumpTerm& a : edge.jump[i]) {
          rock_residual_[a.unknown] -= load * a.normal + drag * a.tangent;
          rock_scale_ += weight *
                         (std::abs(p - e_.scene.pore_pressure) + std::abs(t.normal - point.in_situ)) *
                         std::abs(a.normal);
          for (const JumpTerm& b : edge.jump[i]) {
            double slope = weight * t.nn * a.normal * b.normal;
            if (e_.scene.slip) slope += weight * (t.sn * a.tangent * b.normal + t.ss * a.tangent * b.tangent);
            stiffen(a.unknown, b.unknown, slope);
          }
          if (source >= 0 && pressure_[at(source)] >= 0)
            by_fluid_.emplace_back(a.unknown, pressure_[at(source)], -weight * a.normal * pressure_unit);
        }
      }
    }
  }

  double aperture(Index cell) const {
    const auto w = openings(e_.path.edges()[at(cell)], s_.jumps);
    return 0.5 * (w[0] + w[1]);
  }
  // d(row)/d(aperture of cell) into the columns of the jumps.
  void by_aperture(Index row, Index cell, double slope) {
    for (const auto& end : e_.path.edges()[at(cell)].jump) {
      for (const JumpTerm& t : end) by_jump(row, t.unknown, 0.5 * slope * t.normal);
    }
  }
  void by_pressure(Index row, Index cell, double slope) {
    fluid_entries_.emplace_back(row, pressure_[at(cell)], slope * pressure_unit);
  }

  // Fluid of a cell, and of the dry one ahead that it pushes on.
  void add_cells() {
    for (std::size_t c = 0; c < s_.cells.size(); ++c) {
      const auto index = static_cast<Index>(c);
      const Index source = pressure_source(e_, s_, index);
      if (source < 0 || pressure_[at(source)] < 0) continue;
      const Index row = pressure_[at(source)];
      const Cell& cell = s_.cells[c];
      const double h = e_.path.edges()[c].length, w = aperture(index), p = s_.cells[at(source)].pressure;
      const ValueSlope density = e_.scene.fluid.density(p);
      const ValueSlope lost = source == index ? leak(e_, s_, index, p, dt_) : ValueSlope{};
      fluid_residual_[row] += h * w * density.value - cell.mass + lost.value;
      fluid_scale_ +=
          std::abs(h * w * density.value - cell.mass) + std::abs(lost.value) + 1e-6 * std::abs(cell.mass);
      by_aperture(row, index, h * density.value);
      by_pressure(row, source, h * w * density.slope + lost.slope);
    }
  }

  // Flow through every vertex between wet cells: conductances of half edges in a star,
  //   q_i = a_i κ (p̄ − p_i),  a_i = 2/h_i,  p̄ = Σ a p / Σ a,  κ of the cells' mean aperture,
  // slowed by turbulence as the largest of them is.
  void add_vertices() {
    std::vector<char> done(s_.cells.size(), 0);  // outer vertex of the cell
    for (std::size_t c = 0; c < s_.cells.size(); ++c) {
      if (pressure_[c] < 0) continue;
      for (const Index vertex : e_.path.edges()[c].vertex) {
        std::vector<Index> around;
        bool first = true, well = false;
        for (const Index other : e_.path.at_vertex(vertex)) {
          if (pressure_[at(other)] < 0) continue;
          if (at(other) < c) first = false;
          around.push_back(other);
          const PathEdge& edge = e_.path.edges()[at(other)];
          if (edge.parent == -1 && edge.vertex[0] == vertex) well = true;
        }
        if (first && !well && around.size() > 1) add_star(around);
      }
    }
  }

  void add_star(const std::vector<Index>& around) {
    double sum = 0.0, mean = 0.0, width = 0.0;
    for (const Index c : around) {
      const double a = 2.0 / e_.path.edges()[at(c)].length;
      sum += a;
      mean += a * s_.cells[at(c)].pressure;
      width += aperture(c);
    }
    mean /= sum;
    const auto count = static_cast<double>(around.size());
    const ValueSlope k = e_.scene.fluid.conductivity(width / count);
    double largest = 0.0;
    for (const Index c : around) {
      const double a = 2.0 / e_.path.edges()[at(c)].length;
      largest = std::max(largest, k.value * a * std::abs(mean - s_.cells[at(c)].pressure));
    }
    const ValueSlope flow = e_.scene.fluid.flow(largest);
    const double share = largest > 0.0 ? flow.value / largest : 1.0;
    // of several branches the slower ones follow the largest: their own slope is left at its share
    const double slope = around.size() == 2 ? flow.slope : share;
    double rest = 0.0;  // what the others' drops leave for the last one, so that nothing is lost by round-off
    for (const Index c : around) {
      const Index row = pressure_[at(c)];
      const double a = 2.0 / e_.path.edges()[at(c)].length;
      const double drop = c == around.back() ? rest : a * (mean - s_.cells[at(c)].pressure);
      rest -= drop;
      fluid_residual_[row] -= dt_ * share * k.value * drop;
      fluid_noise_ += round_off * dt_ * k.value * a * std::abs(mean);
      for (const Index j : around) {
        const double aj = 2.0 / e_.path.edges()[at(j)].length;
        by_pressure(row, j, -dt_ * slope * k.value * a * (aj / sum - (j == c ? 1.0 : 0.0)));
        by_aperture(row, j, -dt_ * slope * k.slope * drop / count);
      }
    }
  }

  void add_well() {
    const Well& well = e_.scene.well;
    double out = 0.0;
    const auto by_rate = [&](Index row, Index inlet, double slope) {
      fluid_entries_.emplace_back(row, inlet, slope * rate_unit);
    };
    for (std::size_t i = 0; i < s_.inlets.size(); ++i) {
      const Inlet& inlet = s_.inlets[i];
      const Index row = inlet_[i], cell = inlet.cell;
      if (row < 0) continue;
      out += inlet.rate;
      fluid_residual_[pressure_[at(cell)]] -= dt_ * inlet.rate;
      by_rate(pressure_[at(cell)], row, -dt_);
      by_rate(well_, row, dt_);
      // κ (2/h) (p_w − p − loss) − q = 0
      const double a = 2.0 / e_.path.edges()[at(cell)].length;
      const ValueSlope k = e_.scene.fluid.conductivity(aperture(cell));
      const ValueSlope loss = well.loss(inlet.rate, s_.time - s_.breakdown_time);
      const double drop = s_.well_pressure - s_.cells[at(cell)].pressure - loss.value;
      const ValueSlope flow = e_.scene.fluid.flow(a * k.value * drop);
      fluid_residual_[row] = flow.value - inlet.rate;
      fluid_error_ += dt_ * std::abs(fluid_residual_[row]);
      fluid_entries_.emplace_back(row, well_, flow.slope * a * k.value * pressure_unit);
      by_pressure(row, cell, -flow.slope * a * k.value);
      by_rate(row, row, -flow.slope * a * k.value * loss.slope - 1.0);
      by_aperture(row, cell, flow.slope * a * k.slope * drop);
    }
    double stored = well.storage * (s_.well_pressure - s_.well_before);
    if (e_.bore > 0.0) {
      stored += fluid_in_bore(e_, s_) - s_.bore;
      fluid_noise_ += round_off * e_.bore;
      const double density = e_.scene.fluid.density(s_.well_pressure).value;
      for (Index k = 0; k < jumps_; ++k)
        by_jump(well_, k,
                density * (e_.moving ? e_.moving->bore_by_jump()[at(k)] : e_.rock.force(pressed, at(k))));
    }
    fluid_residual_[well_] = stored - dt_ * (rate_ - out);
    fluid_error_ += std::abs(fluid_residual_[well_]);
    fluid_scale_ += dt_ * (std::abs(rate_) + std::abs(out)) + std::abs(stored);
    // A well without storage that is shut off keeps its pressure.
    const double storage = well_storage(e_, s_);
    const double slope = storage > 0.0 || s_.connected ? storage : 1.0;
    fluid_entries_.emplace_back(well_, well_, slope * pressure_unit);
  }

  const Equations& e_;
  const State& s_;
  double dt_, rate_;
  bool careful_ = false;
  Index jumps_ = 0, fluid_ = 0, first_inlet_ = 0, well_ = -1;
  std::vector<Index> pressure_;  // per cell: fluid unknown, -1: none
  std::vector<Index> inlet_;     // per inlet: the same
  Eigen::MatrixXd stiffness_, by_jumps_;
  Eigen::VectorXd rock_residual_, fluid_residual_;
  std::vector<Eigen::Triplet<double>> by_fluid_, fluid_entries_;
  std::vector<Eigen::Triplet<double>> coupling_;  // in motion: of all rows by jumps
  double rock_scale_ = 0.0, fluid_scale_ = 0.0, fluid_error_ = 0.0;
  double fluid_noise_ =
      0.0;  // round-off of flow between cells at nearly the same pressure, of a full wellbore
};

}  // namespace

std::array<double, 2> openings(const PathEdge& edge, const std::vector<double>& jumps) {
  return {edge.aperture + opening_of(edge.jump[0], jumps), edge.aperture + opening_of(edge.jump[1], jumps)};
}

std::array<double, 2> slips(const PathEdge& edge, const std::vector<double>& jumps) {
  return {slip_of(edge.jump[0], jumps), slip_of(edge.jump[1], jumps)};
}

MixedTraction traction_at(const Equations& equations, const State& state, std::size_t cell, std::size_t end) {
  const Point& point = state.cells[cell].points[end];
  const PathEdge& edge = equations.path.edges()[cell];
  const InterfaceLaw& law = equations.laws[cell];
  const double opening = openings(edge, state.jumps)[end];
  if (equations.scene.slip) {
    return law.traction(opening, slip_of(edge.jump[end], state.jumps), point.max_opening, point.plastic_slip,
                        point.bond, point.bond_shear);
  }
  const TractionSlope t = law.traction(opening, point.max_opening, point.bond);
  MixedTraction all;
  all.normal = t.traction;
  all.nn = t.slope;
  return all;
}

Index pressure_source(const Equations& equations, const State& state, Index cell) {
  if (state.cells[at(cell)].wet) return cell;
  if (equations.scene.wetting != Wetting::tip_pressure) return -1;
  const Index parent = equations.path.edges()[at(cell)].parent;
  return parent >= 0 && state.cells[at(parent)].wet ? parent : -1;
}

std::span<const double> profile(const Equations& equations, const State& state, Index cell) {
  if (!equations.matrix) return {};
  const std::size_t n = equations.matrix->cells();
  return std::span(state.matrix).subspan(at(cell) * n, n);
}

ValueSlope leak(const Equations& equations, const State& state, Index cell, double pressure, double dt) {
  const Cell& c = state.cells[at(cell)];
  if (state.time < c.exposed) return {};
  const double faces = 2.0 * equations.path.edges()[at(cell)].length;
  if (const auto* carter = std::get_if<CarterLeakOff>(&equations.scene.leak_off)) {
    const double since = state.time + dt - c.exposed, bare = since < c.sweep ? since / c.sweep : 1.0;
    const auto v = carter->volume(c.leaked / faces, dt, pressure, bare);
    return {faces * v.value, faces * v.slope};
  }
  if (equations.matrix) {
    const auto r = equations.matrix->response(profile(equations, state, cell), dt);
    return {faces * (r.slope * pressure + r.constant), faces * r.slope};
  }
  return {};
}

std::vector<double> face_forces(const Equations& equations, const State& state) {
  return System(equations, state, 0.0, 0.0).face_forces();
}

NewtonResult solve(const Equations& equations, State& state, double dt, double rate) {
  System system(equations, state, dt, rate);
  Eigen::VectorXd jumps, fluid;
  for (int iteration = 0; iteration < most_iterations; ++iteration) {
    system.assemble(iteration >= 6 && iteration < 14);
    if (iteration > 0 && system.converged()) return {true, iteration};
    if (!system.solve(jumps, fluid)) return {false, iteration};
    system.move(state, jumps, fluid, system.share(jumps));
  }
  return {false, most_iterations};
}

}  // namespace crackle::quasi_static
