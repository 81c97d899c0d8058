// SPDX-License-Identifier: GPL-3.0-or-later
#include "quasi_static_scene.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>

#include "crackle/core/errors.hpp"
#include "crackle/mesh/grid.hpp"
#include "crackle/solve/estimates.hpp"
#include "joints.hpp"
#include "layers.hpp"
#include "regime.hpp"
#include "scene.hpp"

namespace crackle {
namespace {

std::size_t at(Index i) { return static_cast<std::size_t>(i); }

std::vector<double> mirrored(const std::vector<double>& upper) {
  std::vector<double> line;
  for (std::size_t i = upper.size(); i-- > 1;) line.push_back(-upper[i]);
  line.insert(line.end(), upper.begin(), upper.end());
  return line;
}

// One wing along x, on the half x > 0: symmetric at x = 0, free on the other sides, and held in y where the
// path's line leaves the domain.
void set_straight_path(const Case& scene, QuasiStaticScene& s) {
  s.held.assign(s.mesh->vertices.size(), 0);
  std::size_t far = 0, start = 0;
  for (std::size_t v = 0; v < s.held.size(); ++v) {
    const Vec2 place = s.mesh->vertices[v];
    if (place.x == 0.0) s.held[v] = 1;
    if (place.y != 0.0) continue;
    if (place.x > s.mesh->vertices[far].x) far = v;
    if (place.x == 0.0) start = v;
  }
  s.held[far] |= 2;
  const double step = scene.mesh.size_fine;
  Wing wing;
  wing.start = static_cast<Index>(start);
  wing.path = edges_along(*s.mesh, {0.0, 0.0}, {step * std::round(scene.mesh.fine_radius / step), 0.0});
  wing.open = static_cast<std::size_t>(std::max(1.0, std::round(scene.fracture.notch / step)));
  s.wings.push_back(std::move(wing));
}

bool is_wall(const Edge& edge) { return edge.kind == EdgeKind::wellbore; }

// The outer boundary: all of it, or, where it is free, so much at its lower left and right that nothing
// turns.
void hold_rim(const Case& scene, QuasiStaticScene& s) {
  const Mesh& mesh = *s.mesh;
  s.held.assign(mesh.vertices.size(), 0);
  std::vector<Index> outer;
  for (const Edge& e : mesh.edges) {
    if (e.kind == EdgeKind::outer) outer.insert(outer.end(), e.vertex.begin(), e.vertex.end());
  }
  if (scene.boundary.outer == "free") {
    const auto far = [&](Vec2 way) {
      return *std::ranges::max_element(outer, {}, [&](Index v) { return dot(mesh.vertices[at(v)], way); });
    };
    s.held[at(far({-1.0, -1.0}))] = 3;
    s.held[at(far({1.0, -1.0}))] = 2;
    return;
  }
  for (const Index v : outer) s.held[at(v)] = 3;
}

// The vertex of the wellbore's wall that lies most in a direction.
Index on_wall(const Mesh& mesh, Vec2 direction) {
  Index best = -1;
  double most = -2.0;
  for (const Edge& e : mesh.edges) {
    if (!is_wall(e)) continue;
    for (const Index v : e.vertex) {
      const Vec2 place = mesh.vertices[at(v)];
      if (const double aligned = dot(place, direction) / norm(place); aligned > most)
        most = aligned, best = v;
    }
  }
  return best;
}

// Two wings along x from the wall of the wellbore, on all of the domain.
void set_straight_paths_of_wellbore(const Case& scene, QuasiStaticScene& s) {
  hold_rim(scene, s);
  const Mesh& mesh = *s.mesh;
  for (const double side : {1.0, -1.0}) {
    Wing wing;
    wing.start = on_wall(mesh, {side, 0.0});
    wing.path = edges_along(mesh, mesh.vertices[at(wing.start)], {side * scene.mesh.fine_radius, 0.0});
    wing.open = 0;
    for (const Index e : wing.path) {
      const auto& v = mesh.edges[at(e)].vertex;
      const double middle = 0.5 * side * (mesh.vertices[at(v[0])].x + mesh.vertices[at(v[1])].x);
      if (middle < scene.fracture.notch) ++wing.open;
    }
    s.wings.push_back(std::move(wing));
  }
}

// Two wings that start where the wall of the wellbore is pulled most: along the larger compression, or, where
// it is the same all round, at fracture.angle.
void set_wings_of_wall(const Case& scene, QuasiStaticScene& s) {
  const Mesh& mesh = *s.mesh;
  const Sym2& stress = stress_at_well(scene);
  const double difference = std::hypot(0.5 * (stress.xx - stress.yy), stress.xy);
  const double angle = 0.5 * std::atan2(-2.0 * stress.xy, stress.yy - stress.xx);
  const Vec2 along = difference > 1e-9 * std::abs(stress.xx + stress.yy)
                         ? Vec2{std::cos(angle), std::sin(angle)}
                         : notch_direction(scene);
  for (const double side : {1.0, -1.0}) {
    Wing wing;
    wing.start = on_wall(mesh, side * along);
    wing.free = true;
    wing.open = 0;
    double most = 0.0;
    Index first = -1;
    for (Index i = 0; i < mesh.edge_count(); ++i) {
      const Edge& e = mesh.edges[at(i)];
      if (is_wall(e) || (e.vertex[0] != wing.start && e.vertex[1] != wing.start)) continue;
      if (const JointEdge* joint = s.joint_at(i); joint != nullptr && !joint->bonded) continue;
      const Vec2 way =
          mesh.vertices[at(e.vertex[e.vertex[0] == wing.start ? 1 : 0])] - mesh.vertices[at(wing.start)];
      const double aligned = side * dot(way, along) / norm(way);
      if (aligned > most) most = aligned, first = i;
    }
    require_quasi_static(first >= 0, scene,
                         "no edge of the mesh leads from the wall of the wellbore into the rock");
    wing.path = {first};
    s.wings.push_back(std::move(wing));
  }
}

// The edges of a notch, in order along it; two wings leave the vertex nearest to the origin, or the wall.
void set_wings(const Case& scene, std::vector<Index> notch, QuasiStaticScene& s) {
  const Mesh& mesh = *s.mesh;
  const Vec2 along = notch_direction(scene);
  const auto where = [&](Index v) { return dot(mesh.vertices[at(v)], along); };
  const auto middle = [&](Index e) {
    return 0.5 * (where(mesh.edges[at(e)].vertex[0]) + where(mesh.edges[at(e)].vertex[1]));
  };
  std::ranges::sort(notch, {}, middle);
  Index well = mesh.edges[at(notch.front())].vertex[0];
  for (const Index e : notch) {
    for (const Index v : mesh.edges[at(e)].vertex) {
      if (std::abs(where(v)) < std::abs(where(well))) well = v;
    }
  }
  const double parting = is_bored(scene) ? 0.0 : where(well);
  for (const double side : {1.0, -1.0}) {
    Wing wing;
    wing.free = true;
    for (const Index e : notch) {
      if (side * (middle(e) - parting) > 0.0) wing.path.push_back(e);
    }
    require_quasi_static(
        !wing.path.empty(), scene,
        "the well is in the origin: fracture.offset has to leave it between the ends of the notch");
    if (side < 0.0) std::ranges::reverse(wing.path);
    wing.open = wing.path.size();
    const auto& first = mesh.edges[at(wing.path.front())].vertex;
    wing.start = side * where(first[0]) < side * where(first[1]) ? first[0] : first[1];
    Index from = wing.start;
    for (const Index e : wing.path) {
      const auto& v = mesh.edges[at(e)].vertex;
      require_quasi_static(v[0] == from || v[1] == from, scene,
                           "fracture.notch is no one line of edges: does it run along a joint?");
      from = v[0] == from ? v[1] : v[0];
    }
    s.wings.push_back(std::move(wing));
  }
}

// Lines of the grid on the half x > 0: even along the path and beside it, then coarser.
struct GridLine {
  double fine_end, to;
  Grading grading;
};
struct GridLines {
  GridLine x, y;  // of y the upper half
};
GridLines grid_lines(const Case& scene) {
  const Case::Mesh& m = scene.mesh;
  const double path = m.size_fine * std::round(m.fine_radius / m.size_fine);
  return {{path, 0.5 * scene.domain.width, {m.size_fine, 1.2, m.size_coarse}},
          {6.0 * m.size_fine, 0.5 * scene.domain.height, {m.size_fine, 1.1, m.size_coarse}}};
}

// Cuts that the fluid of the well is not in are joints without cohesion, with the friction of the rock.
void add_dry_notches(const std::vector<Index>& edges, QuasiStaticScene& s) {
  if (edges.empty()) return;
  s.joint_materials.push_back(s.cohesive);
  const auto material = static_cast<std::uint16_t>(s.joint_materials.size());
  for (const Index e : edges) s.joints.push_back({e, material, false});
  std::ranges::sort(s.joints, {}, &JointEdge::edge);
}

// On the whole domain: wings that choose their way, and joints.
void set_free_path(const Case& scene, const Scene& in_steps, QuasiStaticScene& s) {
  s.slip = true;
  require_quasi_static(std::ranges::any_of(s.mesh->edges, is_wall) == is_bored(scene), scene,
                       is_bored(scene)
                           ? "mesh.file has no curve \"wellbore_wall\", but there is a wellbore.diameter"
                           : "mesh.file has a wellbore: give wellbore.diameter");
  hold_rim(scene, s);
  add_dry_notches(in_steps.dry_cracks, s);
  if (scene.fracture.notch == 0.0) return set_wings_of_wall(scene, s);
  std::vector<Index> notch;
  std::ranges::set_difference(in_steps.cracks, in_steps.dry_cracks, std::back_inserter(notch));
  require_quasi_static(!notch.empty(), scene,
                       scene.mesh.file.empty()
                           ? "fracture.notch is shorter than an edge of the mesh"
                           : "mesh.file has no curve \"joint_notch\", the fracture.notch");
  set_wings(scene, std::move(notch), s);
}

}  // namespace

double modelled_halves(const Case& scene) { return on_half_grid(scene) ? 1.0 : 2.0; }

double estimate_grid_triangles(const Case& scene) {
  const GridLines lines = grid_lines(scene);
  const auto steps = [](const GridLine& line) {
    const auto& [step, ratio, largest] = line.grading;
    const double growing = std::log(std::max(1.0, largest / step)) / std::log(ratio);
    const double grown = std::max(0.0, largest - step) * ratio / (ratio - 1.0);
    const double rest = line.to - line.fine_end;
    return line.fine_end / step + (rest > grown
                                       ? growing + (rest - grown) / largest
                                       : std::log1p(rest * (ratio - 1.0) / (step * ratio)) / std::log(ratio));
  };
  const double crossed = lines.y.fine_end / lines.y.grading.step;  // rows of twice as many
  return 4.0 * steps(lines.x) * (steps(lines.y) + crossed);
}

Mesh make_quasi_static_mesh(const Case& scene, NetworkReport* network) {
  if (!on_half_grid(scene)) {
    Case laid = scene;
    if (is_straight(scene)) {  // edges along both paths, from corners of the wall
      laid.fracture.notch = scene.mesh.fine_radius;
      const double half = 0.5 * std::numbers::pi * scene.wellbore.diameter / scene.mesh.size_fine;
      if (laid.wellbore.segments == 0)
        laid.wellbore.segments = 2 * std::max(4, static_cast<int>(std::lround(half)));
    }
    return excavate(make_mesh(laid, is_straight(scene) ? nullptr : network));
  }
  const GridLines lines = grid_lines(scene);
  const auto line = [](const GridLine& l) { return graded_line(0.0, l.fine_end, l.to, l.grading); };
  return grid_rectangle(line(lines.x), mirrored(line(lines.y)), lines.y.fine_end);
}

// Viscosity [Pa s] of K_m = 48, ten times that from which pressure is uniform.
double viscosity_of_uniform_pressure(const Case& scene) {
  const Case::Rock& rock = rock_at_well(scene);
  const double modulus = plane_strain_modulus(rock_stiffness(rock));
  double rate = 0.0;
  for (const Case::PumpStage& p : scene.fluid.pump) rate = std::max(rate, p.rate / scene.well.height);
  const double k = toughness(modulus, rock.fracture_energy_mode1);
  constexpr double any = 1e-6;
  return any * std::pow(dimensionless_toughness(modulus, k, any, rate) / 48.0, 4);
}

QuasiStaticScene make_quasi_static_scene(const Case& scene, std::shared_ptr<const Mesh> mesh) {
  const Scene in_steps =
      make_scene(scene, is_straight(scene) ? nullptr : mesh);  // a straight path has rock alone
  QuasiStaticScene s;
  static_cast<RockModel&>(s) = in_steps;
  s.triangle_stiffness.reset();  // that makes up for cohesive elements on all edges
  for (RockMass& layer : s.layers) layer.triangle_stiffness.reset();
  s.mesh = std::move(mesh);
  s.control.hand_over = scene.run.hand_over;
  s.pore_pressure = scene.rock.pore_pressure;
  s.control.first = std::min(s.control.first, 1e-3 * scene.run.end_time);
  s.law = find_law(scene.cohesive.law);
  s.wetting = scene.fluid.wets == "tip"       ? Wetting::tip_pressure
              : scene.fluid.wets == "damaged" ? Wetting::damaged
                                              : Wetting::broken;
  s.closure = {scene.fracture.residual_aperture, scene.fracture.closure_stress};
  s.fluid.viscosity =
      scene.fluid.flow == "uniform" ? viscosity_of_uniform_pressure(scene) : scene.fluid.viscosity;
  if (scene.fluid.flow == "turbulent") s.fluid.reference_density = scene.fluid.density;
  s.fluid.compressibility = 1.0 / scene.fluid.bulk_modulus;
  s.fluid.reference_pressure = s.pore_pressure;
  s.fluid.cavitation_pressure =
      scene.fluid.cavitation_pressure.value_or(s.pore_pressure > 1e6 ? 0.0 : s.pore_pressure - 5e6);
  if (scene.fluid.leak_off == "carter") {
    s.leak_off = CarterLeakOff{scene.fluid.leak_off_coefficient, s.pore_pressure, 2e6};
  } else if (scene.fluid.leak_off == "diffusion") {
    MatrixRock rock{scene.rock.permeability, scene.rock.porosity, scene.rock.pore_compressibility,
                    scene.rock.pore_viscosity, s.pore_pressure};
    rock.cells = diffusion_cells(rock, scene.run.end_time);
    s.leak_off = rock;
  }
  // Of what is modelled, per metre of height.
  const double wings = 2.0 / modelled_halves(scene) * scene.well.height;
  s.well.storage = scene.well.storage / wings;
  s.well.impedance = scene.well.impedance * wings;
  s.well.impedance_time = scene.well.impedance_time;
  s.well.perforation = scene.well.perforation_friction * wings * wings;
  s.well.tortuosity = scene.well.tortuosity * std::sqrt(wings);
  s.well.breakdown_pressure = scene.well.breakdown_pressure;
  std::vector<PumpStage> stages;
  for (const Case::PumpStage& stage : scene.fluid.pump)
    stages.push_back({stage.from, stage.to, stage.rate / wings});
  s.pump = Pump(std::move(stages));

  if (on_half_grid(scene)) {
    set_straight_path(scene, s);
  } else if (is_straight(scene)) {
    set_straight_paths_of_wellbore(scene, s);
  } else {
    set_free_path(scene, in_steps, s);
  }
  return s;
}

std::string quasi_static_mesh_text(const Case& scene, const QuasiStaticScene& stage) {
  std::string text =
      fmt::format("{} triangles, {} vertices", stage.mesh->triangle_count(), stage.mesh->vertex_count());
  if (on_half_grid(scene))
    return text + fmt::format(", half of the domain; a path of {} edges", stage.wings.front().path.size());
  text += fmt::format("; {} wings from {}{}", stage.wings.size(),
                      is_bored(scene) ? "the wall of the wellbore" : "the well",
                      is_straight(scene) ? " along x" : ", free");
  for (const Wing& wing : stage.wings) {
    if (&wing != &stage.wings.front() && wing.path.size() == stage.wings.front().path.size() &&
        wing.open == stage.wings.front().open)
      continue;
    text += fmt::format("; {} edges, {} of them open", wing.path.size(), wing.open);
  }
  const auto bonded = std::ranges::count_if(stage.joints, &JointEdge::bonded);
  if (!stage.joints.empty())
    text += fmt::format("; {} edges of joints, {} of them bonded", stage.joints.size(), bonded);
  if (const std::string layers = layers_text(scene, *stage.mesh); !layers.empty()) text += "; " + layers;
  return text;
}

// Of the first edge of the path [m].
double first_edge(const QuasiStaticScene& stage) {
  const auto& v = stage.mesh->edges[at(stage.wings.front().path.front())].vertex;
  return norm(stage.mesh->vertices[at(v[1])] - stage.mesh->vertices[at(v[0])]);
}

std::vector<std::string> quasi_static_notes(const Case& scene, const QuasiStaticScene& stage) {
  const Case::Rock& rock = rock_at_well(scene);
  const double modulus = plane_strain_modulus(rock_stiffness(rock)),
               k = toughness(modulus, rock.fracture_energy_mode1);
  double rate = 0.0;
  for (const Case::PumpStage& p : scene.fluid.pump) rate = std::max(rate, p.rate / scene.well.height);
  const double mu = 12.0 * stage.fluid.viscosity;
  const double across = confinement(scene);
  std::vector<std::string> notes;
  if (across > 0.0) {
    notes.push_back(
        fmt::format("the fluid would lag behind the tip for {:.2g} s (E'^2 12 viscosity / stress^3): the "
                    "stage takes the fracture as filled to its tip",
                    modulus * modulus * mu / (across * across * across)));
  }
  if (is_bored(scene) && scene.fracture.notch == 0.0) {
    const Sym2& s = stress_at_well(scene);
    const double mean = 0.5 * (s.xx + s.yy), half = std::hypot(0.5 * (s.xx - s.yy), s.xy);
    notes.push_back(
        fmt::format("the wall of the wellbore breaks from {:.2f} MPa (Hubbert-Willis)",
                    1e-6 * (rock.tensile_strength - 2.0 * mean - 4.0 * half + stage.pore_pressure)));
  }
  const double edge = scene.mesh.file.empty() ? scene.mesh.size_fine : first_edge(stage);
  const double strength = resolved_strength(rock.tensile_strength, modulus, rock.fracture_energy_mode1, edge,
                                            stage.edges_per_zone);
  if (strength < rock.tensile_strength) {
    notes.push_back(
        fmt::format("note: edges of {:.3g} m cannot resolve a tensile strength of {:.3g} MPa: it is taken as "
                    "{:.3g} MPa, at the "
                    "same fracture energy",
                    edge, 1e-6 * rock.tensile_strength, 1e-6 * strength));
  }
  // What flow through half an edge of closed faces takes: nothing opens them before the well's own pressure
  // does.
  const double closed = std::max(stage.fluid.smallest_aperture, stage.closure.opening(across));
  const double entry = mu * 0.5 * rate * 0.5 * edge / (closed * closed * closed);
  if (!is_bored(scene) && scene.well.storage == 0.0 && scene.fluid.flow != "uniform" &&
      entry > 10.0 * std::max(across, 0.0)) {
    notes.push_back(
        fmt::format("warning: the well stores nothing, and the first fluid has to enter a closed notch, "
                    "{:.3g} um open: its "
                    "pressure may begin at {:.3g} MPa, and fall within milliseconds; give the well its "
                    "well.storage, or a "
                    "larger fracture.residual_aperture",
                    1e6 * closed, 1e-6 * (stage.pore_pressure + across + entry)));
  }
  const double reynolds = scene.fluid.density * rate / stage.fluid.viscosity;
  if (reynolds > 2300.0 && scene.fluid.flow != "uniform")
    notes.push_back(fmt::format("note: flow near the well is turbulent (Reynolds number {:.2g} of a wing){}",
                                reynolds, scene.fluid.flow == "turbulent" ? "" : ", and taken as laminar"));
  if (const auto* carter = std::get_if<CarterLeakOff>(&stage.leak_off)) {
    const double kp = 4.0 * std::sqrt(2.0 / M_PI) * k, cp = 2.0 * carter->coefficient;
    notes.push_back(fmt::format("time scale of the change from toughness to leak-off {:.2g} s",
                                rate * rate * std::pow(kp, 4) / std::pow(modulus, 4) / std::pow(cp, 6)));
  } else if (const auto* matrix = std::get_if<MatrixRock>(&stage.leak_off)) {
    const double depth = 2.0 * std::sqrt(matrix->permeability * scene.run.end_time /
                                         (matrix->porosity * matrix->compressibility * matrix->viscosity));
    notes.push_back(
        fmt::format("diffusion {:.2g} m deep by the end; Carter's coefficient would be {:.3g} "
                    "m/s^0.5 at the closure stress",
                    depth,
                    across * std::sqrt(matrix->permeability * matrix->porosity * matrix->compressibility /
                                       (M_PI * matrix->viscosity))));
  }
  if (std::ranges::any_of(stage.joints, &JointEdge::bonded)) {
    notes.emplace_back(
        "note: joints that hold break by opening, where a fracture has come to them, and it follows them to "
        "their end: not ahead of it, nor by sliding alone");
  }
  if (scene.fluid.leak_off != "none")
    notes.push_back("note: stress from the fluid that leaks off (poroelastic) is left out");
  return notes;
}

}  // namespace crackle
