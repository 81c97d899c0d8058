// SPDX-License-Identifier: GPL-3.0-or-later
#include "joints.hpp"

#include <fmt/format.h>

#include <cmath>
#include <cstdint>
#include <optional>

#include "crackle/core/errors.hpp"
#include "crackle/io/joints_csv.hpp"
#include "layers.hpp"

namespace crackle {
namespace {

JointLengths lengths_of(const Case::JointSet& set) {
  JointLengths lengths;
  if (set.length_distribution == "normal") lengths.law = JointLengths::Law::normal;
  if (set.length_distribution == "lognormal") lengths.law = JointLengths::Law::lognormal;
  if (set.length_distribution == "power_law") lengths.law = JointLengths::Law::power_law;
  lengths.mean = set.length_mean.value_or(0.0);
  lengths.deviation = set.length_deviation.value_or(0.0);
  lengths.exponent = set.length_exponent.value_or(0.0);
  lengths.min = set.length_min.value_or(lengths.min);
  lengths.max = set.length_max.value_or(lengths.max);
  return lengths;
}

JointDirections directions_of(const Case::JointSet& set) {
  JointDirections directions;
  if (set.orientation == "constant") directions.law = JointDirections::Law::constant;
  if (set.orientation == "von_mises") directions.law = JointDirections::Law::von_mises;
  directions.angle = set.angle.value_or(0.0);
  directions.concentration = set.concentration.value_or(0.0);
  return directions;
}

JointSet random_set(const Case::JointSet& set, double wellbore_radius) {
  JointSet random;
  random.density = *set.density;
  random.length = lengths_of(set);
  random.direction = directions_of(set);
  if (set.region_radius) {
    random.region.radius = *set.region_radius;
  } else {
    random.region.lower = {*set.region_x_min, *set.region_y_min};
    random.region.upper = {*set.region_x_max, *set.region_y_max};
  }
  if (set.clear_distance) random.clear_radius = wellbore_radius + *set.clear_distance;
  random.seed = *set.seed;
  return random;
}

/// What is cut before the run into a mesh made from the case: each the set of joints of its own, after those
/// of the joints.
std::vector<Case::Notch> notches_of(const Case& scene) {
  std::vector<Case::Notch> notches;
  if (scene.fracture.notch > 0.0) {
    const Vec2 along = notch_direction(scene);
    const Vec2 from = (scene.fracture.offset - scene.fracture.notch) * along;
    const Vec2 to = (scene.fracture.offset + scene.fracture.notch) * along;
    notches.push_back({from.x, from.y, to.x, to.y, "pumped"});
  }
  notches.insert(notches.end(), scene.notches.begin(), scene.notches.end());
  return notches;
}

/// Which of the notches a set of the mesh is. Sets are numbered and named as for properties_of().
std::optional<std::size_t> notch_of(const Case& scene, const Mesh& mesh, std::size_t set,
                                    std::size_t notches) {
  if (scene.mesh.file.empty()) {
    const std::size_t first = mesh.joint_sets.size() - notches;
    return set < first ? std::nullopt : std::optional(set - first);
  }
  const bool named = mesh.joint_sets[set] == "notch" || mesh.joint_sets[set] == "notch1";
  return named && notches > 0 ? std::optional<std::size_t>(0) : std::nullopt;
}

std::string interface_name(std::size_t layer) { return fmt::format("layer{}", layer + 1); }

/// Of a set of the mesh. In a mesh that was made from the case they are numbered as add_joints() has them, in
/// one from a file they go by name.
const Case::JointProperties& properties_of(const Case& scene, const Mesh& mesh, std::size_t set) {
  if (scene.mesh.file.empty()) {
    if (set < scene.joints.size()) return scene.joints[set];
    if (set < first_interface(scene)) return scene.joint_sets[set - scene.joints.size()];
    return scene.layers[set - first_interface(scene)].interface;
  }
  for (std::size_t i = 0; i < scene.layers.size(); ++i) {
    if (mesh.joint_sets[set] == interface_name(i)) return scene.layers[i].interface;
  }
  for (const std::string& name : {mesh.joint_sets[set], std::string()}) {
    for (const Case::JointSet& row : scene.joint_sets) {
      if (row.name == name) return row;
    }
  }
  throw CaseError(
      scene.file, 0, 0,
      fmt::format("{} has joints of the set \"{}\": say how they bear in [[joint_sets]] with name = "
                  "\"{}\", or without a name for all sets",
                  scene.mesh.file, mesh.joint_sets[set], mesh.joint_sets[set]));
}

}  // namespace

void add_joints(const Case& scene, MeshRecipe& recipe) {
  for (const Case::Joint& joint : scene.joints) {
    const Index set = static_cast<Index>(recipe.joint_sets.size());
    recipe.joint_sets.push_back(fmt::format("joint{}", recipe.joint_sets.size() + 1));
    recipe.joints.push_back({{joint.x1, joint.y1}, {joint.x2, joint.y2}, set});
  }
  for (const Case::JointSet& set : scene.joint_sets) {
    const Index number = static_cast<Index>(recipe.joint_sets.size());
    recipe.joint_sets.push_back(set.name);
    const std::vector<Joint> joints =
        set.file.empty() ? generate_joints(random_set(set, 0.5 * scene.wellbore.diameter), number)
                         : read_joints_csv(set.file, number);
    recipe.joints.insert(recipe.joints.end(), joints.begin(), joints.end());
  }
  for (std::size_t i = 0; i < scene.layers.size(); ++i) recipe.joint_sets.push_back(interface_name(i));
  int number = 0;
  for (const Case::Notch& notch : notches_of(scene)) {
    const Index set = static_cast<Index>(recipe.joint_sets.size());
    recipe.joints.push_back({{notch.x1, notch.y1}, {notch.x2, notch.y2}, set});
    recipe.joint_sets.push_back(fmt::format("notch{}", ++number));
  }
  // Last: where lines overlap, the first counts.
  add_interfaces(scene, recipe);
}

Vec2 notch_direction(const Case& scene) {
  const double angle = scene.fracture.angle;
  return angle == 0.0 ? Vec2{1.0, 0.0} : Vec2{std::cos(angle), std::sin(angle)};
}

void set_joints(const Case& scene, Scene& solver_scene) {
  const Mesh& mesh = *solver_scene.mesh;
  std::vector<bool> bonded;
  const std::vector<Case::Notch> notches = notches_of(scene);
  for (std::size_t set = 0; set < mesh.joint_sets.size(); ++set) {
    CohesiveMaterial material = solver_scene.cohesive;
    solver_scene.joint_materials.push_back(material);
    bonded.push_back(false);
    if (notch_of(scene, mesh, set, notches.size())) continue;
    const Case::JointProperties& joint = properties_of(scene, mesh, set);
    bonded.back() = joint.law == "bonded";
    if (joint.law == "perfect") continue;  // no edge is of it
    material.penalty = *joint.normal_penalty;
    material.tangential_penalty = *joint.tangential_penalty;
    material.tan_residual = std::tan(*joint.residual_friction_angle);
    material.bedding = {};
    if (bonded.back()) {
      material.tensile_strength = *joint.tensile_strength;
      material.cohesion = *joint.cohesion;
      material.tan_friction = std::tan(*joint.friction_angle);
      material.fracture_energy_mode1 = *joint.fracture_energy_mode1;
      material.fracture_energy_mode2 = *joint.fracture_energy_mode2;
    }
    solver_scene.joint_materials.back() = material;
  }
  for (Index e = 0; e < mesh.edge_count(); ++e) {
    const Edge& edge = mesh.edges[static_cast<std::size_t>(e)];
    if (edge.joint < 0 || edge.kind != EdgeKind::interior) continue;
    const auto set = static_cast<std::size_t>(mesh.set_of_joint[static_cast<std::size_t>(edge.joint)]);
    if (const auto notch = notch_of(scene, mesh, set, notches.size())) {
      solver_scene.cracks.push_back(e);
      if (notches[*notch].fluid == "none") solver_scene.dry_cracks.push_back(e);
      continue;
    }
    solver_scene.joints.push_back({e, static_cast<std::uint16_t>(set + 1), bonded[set]});
  }
  solver_scene.joints_edge_by_edge = scene.fluid.joints == "edge";
}

std::string network_text(const NetworkReport& report) {
  if (report.joints == 0) return {};
  std::string text = fmt::format("{} joints: {} in the mesh, {:.4g} m of edges, {} junctions", report.joints,
                                 report.shown, report.length, report.junctions);
  if (report.merged > 0) text += fmt::format("; {} run along others all the way", report.merged);
  if (report.too_short > 0) text += fmt::format("; {} left out as shorter than an edge", report.too_short);
  if (report.outside > 0) text += fmt::format("; {} outside the rock", report.outside);
  text += fmt::format("\nshortest edge of a joint {:.3g} mm; smallest angle between joints {:.1f} degrees",
                      1e3 * report.shortest_edge, report.smallest_angle_deg);
  if (report.sharp > 0) {
    text += fmt::format(" ({} below 20 as given, the sharpest {:.2g} at ({:.4g}, {:.4g}) m)", report.sharp,
                        report.sharpest_deg, report.sharpest_at.x, report.sharpest_at.y);
  }
  if (report.snapped > 0) {
    text += fmt::format(
        "\n{} points nearly touched something and were moved onto it, by {:.3g} mm at most, at ({:.4g}, "
        "{:.4g}) m",
        report.snapped, 1e3 * report.largest_move, report.largest_move_at.x, report.largest_move_at.y);
  }
  if (const Index lost = report.merged + report.too_short; 20 * lost > report.joints) {
    text += fmt::format(
        "\nwarning: the mesh is too coarse for {} of {} joints, nearer to others or shorter than its edges: "
        "take a smaller "
        "mesh.size_coarse, or joints within mesh.fine_radius only (region_radius of the set)",
        lost, report.joints);
  }
  return text;
}

FractureFrame joint_frame(const Mesh& mesh) {
  FractureFrame frame;
  Field joint{"joint", 1, {}}, set{"joint_set", 1, {}};
  for (const Edge& edge : mesh.edges) {
    if (edge.joint < 0) continue;
    const Index first = static_cast<Index>(frame.points.size());
    for (const Index v : edge.vertex) frame.points.push_back(mesh.vertices[static_cast<std::size_t>(v)]);
    frame.lines.push_back({first, first + 1});
    joint.add(edge.joint);
    set.add(mesh.set_of_joint.at(static_cast<std::size_t>(edge.joint)));
  }
  frame.cell_fields = {std::move(joint), std::move(set)};
  return frame;
}

}  // namespace crackle
