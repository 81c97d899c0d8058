// SPDX-License-Identifier: GPL-3.0-or-later
#include "scene.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "crackle/core/errors.hpp"
#include "crackle/solve/estimates.hpp"
#include "joints.hpp"
#include "layers.hpp"

namespace crackle {
namespace {

// Below this a triangle would set the time step of the whole run, or nearly have no area.
constexpr double smallest_angle_deg = 5.0;

Bedding bedding_of(const Case::Rock& rock) {
  if (!rock.tensile_strength_bedding && !rock.cohesion_bedding && !rock.fracture_energy_mode1_bedding &&
      !rock.fracture_energy_mode2_bedding) {
    return {};
  }
  return {{-std::sin(rock.bedding_angle), std::cos(rock.bedding_angle)},
          rock.bedding_exponent,
          rock.tensile_strength_bedding.value_or(rock.tensile_strength),
          rock.cohesion_bedding.value_or(rock.cohesion),
          rock.fracture_energy_mode1_bedding.value_or(rock.fracture_energy_mode1),
          rock.fracture_energy_mode2_bedding.value_or(rock.fracture_energy_mode2)};
}

CohesiveMaterial cohesive_material(const Case& scene, const Case::Rock& rock, double penalty) {
  CohesiveMaterial m;
  m.tensile_strength = rock.tensile_strength;
  m.cohesion = rock.cohesion;
  m.tan_friction = std::tan(rock.friction_angle);
  m.tan_residual = std::tan(scene.contact.friction_angle);
  m.fracture_energy_mode1 = rock.fracture_energy_mode1;
  m.fracture_energy_mode2 = rock.fracture_energy_mode2;
  m.bedding = bedding_of(rock);
  m.penalty = penalty;
  m.tangential_penalty = scene.contact.tangential_penalty;
  m.mixed_mode_exponent = scene.cohesive.mixed_mode_exponent;
  m.calibration = scene.cohesive.calibration == "y_geo" ? Calibration::y_geo : Calibration::exact;
  return m;
}

DamageMaterial damage_material(const Case& scene, const Case::Rock& rock) {
  DamageMaterial m;
  m.tensile_strength = rock.tensile_strength;
  m.cohesion = rock.cohesion;
  m.tan_friction = std::tan(rock.friction_angle);
  m.tan_residual = std::tan(scene.contact.friction_angle);
  m.fracture_energy_mode1 = rock.fracture_energy_mode1;
  m.fracture_energy_mode2 = rock.fracture_energy_mode2;
  m.apply(scene.damage.preset == "faithful" ? DamagePreset::faithful : DamagePreset::recommended);
  m.initiation = *find_initiation(scene.damage.initiation);
  m.bedding = bedding_of(rock);
  return m;
}

void set_damage(const Case& scene, Scene& s) {
  s.damage.law = find_softening(scene.damage.law);
  s.damage.materials = {damage_material(scene, scene.rock)};
  for (const Case::Layer& layer : scene.layers)
    s.damage.materials.push_back(damage_material(scene, layer.rock));
  s.damage.of_triangle = s.layer_of_triangle;
}

bool may_part(const Case& scene) {
  return std::ranges::any_of(scene.layers,
                             [](const Case::Layer& layer) { return layer.interface.law != "perfect"; });
}

void compensate(RockMass& rock, const Mesh& mesh) {
  const double shape = measure_mesh(mesh).sum_length2_over_area;
  rock.triangle_stiffness = compensated(rock.stiffness, artificial_compliance(rock.cohesive.penalty, shape));
}

void set_loads(const Case& scene, Scene& s) {
  s.free_boundary = scene.boundary.outer == "free";
  for (const Case::Load& row : scene.loads) {
    Load load;
    const bool upright = row.side == "left" || row.side == "right";
    load.side = row.side == "left"    ? Load::Side::left
                : row.side == "right" ? Load::Side::right
                : row.side == "top"   ? Load::Side::top
                                      : Load::Side::bottom;
    if (row.from) load.from = *row.from;
    if (row.to) load.to = *row.to;
    load.traction = {row.traction_x.value_or(0.0), row.traction_y.value_or(0.0)};
    load.ramp = row.ramp;
    load.one_sided = row.contact == "one_sided";
    const auto motion = [&](std::size_t i, std::optional<double> velocity, std::optional<double> displacement,
                            bool held) {
      if (velocity) load.motion[i] = {*velocity, true};
      if (displacement) load.motion[i] = {*displacement, false};
      if (held) load.motion[i] = {0.0, true};
    };
    const bool fixed = row.support == "fixed", roller = row.support == "roller";
    motion(0, row.velocity_x, row.displacement_x, fixed || (roller && upright));
    motion(1, row.velocity_y, row.displacement_y, fixed || (roller && !upright));
    s.loads.push_back(load);
  }
}

// Pressure that falls along the fractures, where it is asked for; "auto" is uniform in steps.
void set_flow(const Case& scene, Scene& s) {
  const Case::Fluid& fluid = scene.fluid;
  if (fluid.flow != "viscous" && fluid.flow != "turbulent") return;
  const auto require = [&](bool holds, const char* what) {
    if (!holds) throw CaseError(scene.file, 0, 0, fmt::format("fluid.flow = \"{}\": {}", fluid.flow, what));
  };
  require(fluid.viscosity > 0.0, "it needs a fluid.viscosity above 0");
  require(scene.cohesive.insertion != "none", "it needs fractures between triangles, not smeared damage");
  FractureFluid law;
  law.viscosity = fluid.viscosity;
  law.reference_density = fluid.flow == "turbulent" ? fluid.density : 0.0;
  law.cavitation_pressure = std::min(0.0, s.initial_pressure);  // that of dry fractures
  if (fluid.cavitation_pressure) law.cavitation_pressure = *fluid.cavitation_pressure - s.pore_pressure;
  require(law.cavitation_pressure <= s.initial_pressure,
          "fluid.cavitation_pressure is above fluid.initial_pressure");
  s.flow = law;
}

}  // namespace

PlaneStiffness rock_stiffness(const Case::Rock& rock) {
  if (!rock.young_modulus_normal) return isotropic_plane_strain(rock.young_modulus, rock.poisson_ratio);
  return transversely_isotropic_plane_strain({rock.young_modulus, *rock.young_modulus_normal,
                                              rock.poisson_ratio, *rock.poisson_ratio_normal,
                                              *rock.shear_modulus_normal, rock.bedding_angle});
}

RockMass rock_mass(const Case& scene, const Case::Layer& layer) {
  RockMass rock;
  rock.stiffness = rock_stiffness(layer.rock);
  rock.density = layer.rock.density;
  rock.stress = layer.stress;
  rock.stress_gradient = layer.stress_gradient;
  rock.cohesive = cohesive_material(scene, layer.rock, layer.penalty);
  return rock;
}

MeshRecipe mesh_recipe(const Case& scene) {
  MeshRecipe recipe;
  recipe.generator = scene.mesh.generator;
  recipe.width = scene.domain.width;
  recipe.height = scene.domain.height;
  recipe.wellbore_diameter = scene.wellbore.diameter;
  recipe.wellbore_segments = scene.wellbore.segments;
  recipe.size_fine = scene.mesh.size_fine;
  recipe.fine_radius = scene.mesh.fine_radius;
  recipe.size_coarse = scene.mesh.size_coarse;
  recipe.seed = scene.mesh.seed;
  return recipe;
}

Mesh make_mesh(const Case& scene, NetworkReport* network) {
  if (!scene.mesh.file.empty()) {
    Mesh mesh = read_gmsh(scene.mesh.file);
    order_along_hilbert_curve(mesh);
    require_quality(mesh, measure_quality(mesh, nullptr), smallest_angle_deg);
    return mesh;
  }
  MeshRecipe recipe = mesh_recipe(scene);
  add_joints(scene, recipe);
  Mesh mesh = generate_mesh(recipe, network);
  weld_perfect_interfaces(scene, mesh);
  require_quality(mesh, measure_quality(mesh, &recipe), smallest_angle_deg);
  return mesh;
}

Scene make_scene(const Case& scene, std::shared_ptr<const Mesh> excavated) {
  Scene s;
  s.mesh = std::move(excavated);
  s.stiffness = rock_stiffness(scene.rock);
  s.density = scene.rock.density;
  s.stress = scene.stress;
  s.stress_gradient = scene.stress_gradient;
  s.damping = {scene.damping.viscosity.value_or(0.0), scene.damping.ratio.value_or(0.0)};
  const bool damaged = scene.cohesive.insertion == "none";
  const bool has_lines = !scene.joints.empty() || !scene.joint_sets.empty() || !scene.notches.empty() ||
                         scene.fracture.notch > 0.0 || may_part(scene);
  if (!damaged || has_lines) s.law = find_law(scene.cohesive.law);
  s.cohesive = cohesive_material(scene, scene.rock, scene.cohesive.penalty);
  set_layers(scene, s);
  if (scene.cohesive.compliance == "compensated" && s.mesh) {
    compensate(s, *s.mesh);
    for (RockMass& layer : s.layers) compensate(layer, *s.mesh);
  }
  if (damaged) set_damage(scene, s);
  s.insertion.on_demand = scene.cohesive.insertion == "on_demand" || (damaged && has_lines);
  s.insertion.threshold = scene.cohesive.threshold;
  s.contact = {scene.contact.normal_penalty, scene.contact.tangential_penalty, s.cohesive.tan_residual};
  s.absorbing_boundary = scene.boundary.outer == "absorbing";
  set_loads(scene, s);
  if (scene.wellbore.diameter > 0.0 || !scene.fluid.pump.empty()) {
    s.pore_pressure = scene.rock.pore_pressure;
    s.initial_pressure = scene.fluid.initial_pressure - s.pore_pressure;
    s.fluid = CompressibleFluid{scene.fluid.bulk_modulus, scene.fluid.density, s.initial_pressure};
    s.wets_damaged = scene.fluid.wets == "damaged";
    set_flow(scene, s);
    std::vector<PumpStage> stages;
    for (const auto& stage : scene.fluid.pump) stages.push_back({stage.from, stage.to, stage.rate});
    s.pump = Pump(std::move(stages));
  }
  s.fast_forward = scene.run.fast_forward;
  if (s.mesh) set_joints(scene, s);
  s.thickness = scene.seismic.thickness;
  s.slip_rate = scene.seismic.slip_rate;
  return s;
}

}  // namespace crackle
