// SPDX-License-Identifier: GPL-3.0-or-later
#include "quasi_static_scene.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "crackle/core/errors.hpp"
#include "crackle/mesh/grid.hpp"
#include "crackle/solve/estimates.hpp"
#include "joints.hpp"
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

void require(bool holds, const Case& scene, const std::string& what) {
  if (!holds) throw CaseError(scene.file, 0, 0, fmt::format("run.regime = \"quasi_static\": {}", what));
}

// What hinders a straight path along x, mirrored at both axes; empty: nothing.
std::string asymmetry(const Case& scene) {
  if (scene.fracture.angle != 0.0) return "fracture.angle is not 0";
  if (scene.fracture.offset != 0.0) return "fracture.offset is not 0";
  if (!scene.joints.empty() || !scene.joint_sets.empty()) return "there are joints";
  if (scene.stress.xy != 0.0) return "stress.xy is not 0";
  return {};
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

// The edges of a notch, in order along it; two wings leave the vertex nearest to the origin.
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
  for (const double side : {1.0, -1.0}) {
    Wing wing;
    wing.start = well;
    wing.free = true;
    for (const Index e : notch) {
      if (side * (middle(e) - where(well)) > 0.0) wing.path.push_back(e);
    }
    require(!wing.path.empty(), scene,
            "the well is in the origin: fracture.offset has to leave it between the ends of the notch");
    if (side < 0.0) std::ranges::reverse(wing.path);
    wing.open = wing.path.size();
    Index from = wing.start;
    for (const Index e : wing.path) {
      const auto& v = mesh.edges[at(e)].vertex;
      require(v[0] == from || v[1] == from, scene,
              "fracture.notch is no one line of edges: does it run along a joint?");
      from = v[0] == from ? v[1] : v[0];
    }
    s.wings.push_back(std::move(wing));
  }
}

// On the whole domain, held at its rim: wings that choose their way, and joints.
void set_free_path(const Case& scene, QuasiStaticScene& s) {
  const Scene rock = make_scene(scene, s.mesh);
  require(!rock.cracks.empty(), scene, "fracture.notch is shorter than an edge of the mesh");
  s.slip = true;
  s.shear.friction = rock.cohesive.tan_residual;
  s.held.assign(s.mesh->vertices.size(), 0);
  for (const Edge& e : s.mesh->edges) {
    if (e.kind == EdgeKind::outer) s.held[at(e.vertex[0])] = s.held[at(e.vertex[1])] = 3;
  }
  for (const JointEdge& joint : rock.joints) {
    require(!joint.bonded, scene, "bonded joints are not yet taken");
    s.joints.push_back({joint.edge, rock.joint_materials[joint.material - 1U].tan_residual});
  }
  set_wings(scene, rock.cracks, s);
}

}  // namespace

RegimeChoice choose_regime(const Case& scene) {
  const WaveSpeeds waves = wave_speeds(rock_stiffness(scene.rock), scene.rock.density);
  const double across = std::max(scene.domain.width, scene.domain.height) / waves.s;
  const double ratio = across > 0.0 ? scene.run.end_time / across : 0.0;
  RegimeChoice choice;
  if (scene.run.regime == "auto") {
    choice.quasi_static = ratio > 1000.0 && scene.fracture.notch > 0.0;
    choice.reason = fmt::format(
        "regime: {} (the run lasts {:.2g} times as long as a shear wave takes across the domain; from 1000 "
        "on, "
        "with fracture.notch > 0, quasi-static)",
        choice.quasi_static ? "quasi-static" : "dynamic", ratio);
  } else {
    choice.quasi_static = scene.run.regime == "quasi_static";
    choice.reason = fmt::format("regime: {}, as run.regime says ({:.2g} shear wave times across the domain)",
                                choice.quasi_static ? "quasi-static" : "dynamic", ratio);
  }
  if (choice.quasi_static) {
    require(scene.fracture.notch > 0.0, scene, "it starts from a fracture: give fracture.notch");
    require(scene.mesh.file.empty(), scene, "meshes from a file are not yet taken");
    require(!scene.rock.tensile_strength_bedding && !scene.rock.cohesion_bedding &&
                !scene.rock.fracture_energy_mode1_bedding && !scene.rock.fracture_energy_mode2_bedding,
            scene, "strengths along the bedding are not yet taken");
    require(scene.layers.empty(), scene, "layers are not yet taken");
    require(scene.notches.empty(), scene, "[[notches]] are not yet taken, give fracture.notch");
    require(scene.loads.empty(), scene, "[[loads]] are not yet taken");
    require(scene.cohesive.insertion != "none", scene,
            "it needs cohesive elements: cohesive.insertion = \"none\" has none");
    require(scene.fluid.viscosity > 0.0, scene, "give fluid.viscosity");
    require(!scene.fluid.pump.empty(), scene, "give a [[fluid.pump]]");
    require(scene.stress_gradient == Sym2{}, scene, "stress gradients are not yet taken");
    if (is_straight(scene)) {
      require(asymmetry(scene).empty(), scene, "fracture.path = \"straight\" cannot be: " + asymmetry(scene));
      require(scene.mesh.fine_radius > scene.fracture.notch + scene.mesh.size_fine, scene,
              "mesh.fine_radius is where the path of the fracture ends: it has to be above fracture.notch");
    } else {
      require(scene.wellbore.diameter == 0.0, scene,
              "a free path starts from a notch alone: wellbore.diameter has to be 0");
      require(std::abs(scene.fracture.offset) <= scene.fracture.notch, scene,
              "the well is in the origin: fracture.offset has to leave it on the notch");
    }
  }
  return choice;
}

bool is_straight(const Case& scene) {
  return scene.fracture.path == "straight" || (scene.fracture.path == "auto" && asymmetry(scene).empty());
}

double modelled_halves(const Case& scene) { return is_straight(scene) ? 1.0 : 2.0; }

Mesh make_quasi_static_mesh(const Case& scene, NetworkReport* network) {
  if (!is_straight(scene)) return excavate(make_mesh(scene, network));
  const Case::Mesh& m = scene.mesh;
  const double path = m.size_fine * std::round(m.fine_radius / m.size_fine);
  const std::vector<double> x =
      graded_line(0.0, path, 0.5 * scene.domain.width, {m.size_fine, 1.2, m.size_coarse});
  const std::vector<double> y =
      graded_line(0.0, 6.0 * m.size_fine, 0.5 * scene.domain.height, {m.size_fine, 1.15, m.size_coarse});
  return grid_rectangle(x, mirrored(y));
}

QuasiStaticScene make_quasi_static_scene(const Case& scene, std::shared_ptr<const Mesh> mesh) {
  QuasiStaticScene s;
  s.stiffness = rock_stiffness(scene.rock);
  s.stress = scene.stress;
  s.pore_pressure = scene.rock.pore_pressure;
  s.law = find_law(scene.cohesive.law);
  s.tensile_strength = scene.rock.tensile_strength;
  s.fracture_energy = scene.rock.fracture_energy_mode1;
  s.closure = {scene.fracture.residual_aperture, scene.fracture.closure_stress};
  s.fluid.viscosity = scene.fluid.viscosity;
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

  s.mesh = std::move(mesh);
  if (is_straight(scene)) {
    set_straight_path(scene, s);
  } else {
    set_free_path(scene, s);
  }
  return s;
}

std::string quasi_static_mesh_text(const Case& scene, const QuasiStaticScene& stage) {
  std::string text =
      fmt::format("{} triangles, {} vertices", stage.mesh->triangle_count(), stage.mesh->vertex_count());
  if (is_straight(scene))
    return text + fmt::format(", half of the domain; a path of {} edges", stage.wings.front().path.size());
  text += fmt::format("; a notch of {} wings, free beyond", stage.wings.size());
  for (const Wing& wing : stage.wings) text += fmt::format("; {} edges", wing.path.size());
  if (!stage.joints.empty()) text += fmt::format("; {} edges of joints", stage.joints.size());
  return text;
}

std::vector<std::string> quasi_static_notes(const Case& scene, const QuasiStaticScene& stage) {
  const double modulus = plane_strain_modulus(stage.stiffness), k = toughness(modulus, stage.fracture_energy);
  double rate = 0.0;
  for (const Case::PumpStage& p : scene.fluid.pump) rate = std::max(rate, p.rate / scene.well.height);
  const double mu = 12.0 * stage.fluid.viscosity;
  const double number = dimensionless_toughness(modulus, k, stage.fluid.viscosity, rate);
  const double confinement = -stage.stress.yy;
  std::vector<std::string> notes;
  notes.push_back(fmt::format("K_m = {:.3g}: {}", number,
                              number > 4.8    ? "toughness rules, pressure is uniform along the fracture"
                              : number < 0.70 ? "viscosity rules, pressure falls along the fracture"
                                              : "toughness and viscosity both count"));
  if (confinement > 0.0) {
    notes.push_back(
        fmt::format("the fluid would lag behind the tip for {:.2g} s (E'^2 12 viscosity / stress^3): the "
                    "stage takes the fracture as filled to its tip",
                    modulus * modulus * mu / (confinement * confinement * confinement)));
  }
  const double strength = resolved_strength(stage.tensile_strength, modulus, stage.fracture_energy,
                                            scene.mesh.size_fine, stage.edges_per_zone);
  if (strength < stage.tensile_strength) {
    notes.push_back(
        fmt::format("note: edges of {:.3g} m cannot resolve a tensile strength of {:.3g} MPa: it is taken as "
                    "{:.3g} MPa, at the "
                    "same fracture energy",
                    scene.mesh.size_fine, 1e-6 * stage.tensile_strength, 1e-6 * strength));
  }
  if (const auto* carter = std::get_if<CarterLeakOff>(&stage.leak_off)) {
    const double kp = 4.0 * std::sqrt(2.0 / M_PI) * k, cp = 2.0 * carter->coefficient;
    notes.push_back(
        fmt::format("leak-off: Carter; time scale of the change from toughness to leak-off {:.2g} s",
                    rate * rate * std::pow(kp, 4) / std::pow(modulus, 4) / std::pow(cp, 6)));
  } else if (const auto* rock = std::get_if<MatrixRock>(&stage.leak_off)) {
    const double depth = 2.0 * std::sqrt(rock->permeability * scene.run.end_time /
                                         (rock->porosity * rock->compressibility * rock->viscosity));
    notes.push_back(
        fmt::format("leak-off: diffusion, {:.2g} m deep by the end; Carter's coefficient would be {:.3g} "
                    "m/s^0.5 at the closure stress",
                    depth,
                    confinement * std::sqrt(rock->permeability * rock->porosity * rock->compressibility /
                                            (M_PI * rock->viscosity))));
  } else {
    notes.push_back("leak-off: none");
  }
  if (scene.fluid.leak_off != "none")
    notes.push_back("note: stress from the fluid that leaks off (poroelastic) is left out");
  return notes;
}

}  // namespace crackle
