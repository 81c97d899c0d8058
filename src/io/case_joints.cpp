// SPDX-License-Identifier: GPL-3.0-or-later
// What [[joints]] and [[joint_sets]] need, and which of their keys go together.
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <initializer_list>
#include <set>

#include "case_row.hpp"

namespace crackle {
namespace {

namespace fs = std::filesystem;

void finish_lengths(Case::JointSet& set, const Row& row) {
  if (set.length_distribution.empty()) set.length_distribution = "constant";
  const std::string& law = set.length_distribution;
  const std::string why = fmt::format("length_distribution is \"{}\"", law);
  if (law == "power_law") {
    row.need({"length_exponent", "length_min", "length_max"}, why);
    row.refuse({"length_mean", "length_deviation"}, why);
  } else {
    row.need({"length_mean"}, why);
    row.refuse({"length_exponent"}, why);
  }
  if (law == "constant") row.refuse({"length_deviation", "length_min", "length_max"}, why);
  if (law == "normal" || law == "lognormal") row.need({"length_deviation"}, why);
  if (set.length_min && set.length_max && *set.length_min >= *set.length_max) {
    fail(row.place("length_min"),
         fmt::format("length_min = {} m is not below length_max = {} m", *set.length_min, *set.length_max));
  }
}

void finish_orientation(Case::JointSet& set, const Row& row) {
  if (set.orientation.empty()) set.orientation = "uniform";
  const std::string why = fmt::format("orientation is \"{}\"", set.orientation);
  if (set.orientation == "uniform") {
    row.refuse({"angle", "concentration"}, why);
  } else {
    row.need({"angle"}, why);
  }
  if (set.orientation == "von_mises") row.need({"concentration"}, why);
  if (set.orientation == "constant") row.refuse({"concentration"}, why);
}

void finish_region(Case::JointSet& set, const Row& row, const Case& scene) {
  if (set.region_radius) {
    row.refuse({"region_x_min", "region_x_max", "region_y_min", "region_y_max"}, "region_radius is given");
  } else {
    const double a = 0.5 * scene.domain.width, b = 0.5 * scene.domain.height;
    if (!set.region_x_min) set.region_x_min = -a;
    if (!set.region_x_max) set.region_x_max = a;
    if (!set.region_y_min) set.region_y_min = -b;
    if (!set.region_y_max) set.region_y_max = b;
    const auto check = [&](double low, double high, const char* axis) {
      if (low < high) return;
      fail(row.place(fmt::format("region_{}_{}", axis,
                                 row.has(fmt::format("region_{}_min", axis)) ? "min" : "max")),
           fmt::format("region_{0}_min = {1} m is not below region_{0}_max = {2} m", axis, low, high));
    };
    check(*set.region_x_min, *set.region_x_max, "x");
    check(*set.region_y_min, *set.region_y_max, "y");
  }
  if (set.clear_distance.value_or(0.0) > 0.0 && scene.wellbore.diameter <= 0.0) {
    fail(row.place("clear_distance"), "clear_distance needs a wellbore: wellbore.diameter is 0");
  }
}

/// Joints of a file, of the mesh file, or random ones.
void finish_source(Case::JointSet& set, const Row& row, std::size_t number, const Case& scene) {
  const std::initializer_list<std::string_view> random{"density",
                                                       "length_distribution",
                                                       "length_mean",
                                                       "length_deviation",
                                                       "length_exponent",
                                                       "length_min",
                                                       "length_max",
                                                       "orientation",
                                                       "angle",
                                                       "concentration",
                                                       "region_radius",
                                                       "region_x_min",
                                                       "region_x_max",
                                                       "region_y_min",
                                                       "region_y_max",
                                                       "clear_distance",
                                                       "seed"};
  if (!scene.mesh.file.empty()) {
    const std::string_view why = "the joints are those of mesh.file, the set says how they bear";
    row.refuse({"file"}, why);
    row.refuse(random, why);
    return;
  }
  if (!row.has("name")) set.name = fmt::format("set{}", number);
  if (!set.file.empty()) {
    row.refuse(random, "the joints are those of the set's file");
    set.file = resolved_path(set.file, row.place("file"));
    std::error_code error;
    if (!fs::is_regular_file(set.file, error)) {
      fail(row.place("file"), fmt::format("{}: there is no file {}", row.path("file"), set.file));
    }
    return;
  }
  row.need({"density"}, "give a density, for random joints, or a file");
  finish_lengths(set, row);
  finish_orientation(set, row);
  finish_region(set, row, scene);
  if (!set.seed) set.seed = number;
}

}  // namespace

void finish_properties(Case::JointProperties& joint, const Row& row, const Case& scene) {
  const std::initializer_list<std::string_view> strengths{"tensile_strength", "cohesion", "friction_angle",
                                                          "fracture_energy_mode1", "fracture_energy_mode2"};
  if (joint.law == "bonded") {
    row.need(strengths, "a bonded joint breaks by values of its own");
  } else {
    row.refuse(strengths, "a frictional joint has none; write law = \"bonded\", or residual_friction_angle");
  }
  if (!joint.residual_friction_angle) joint.residual_friction_angle = scene.contact.friction_angle;
  if (!joint.normal_penalty) joint.normal_penalty = scene.cohesive.penalty;
  if (!joint.tangential_penalty) joint.tangential_penalty = scene.contact.tangential_penalty;
}

void finish_joints(ReadCase& read) {
  Case& scene = read.scene;
  for (std::size_t i = 0; i < scene.joints.size(); ++i) {
    const Row row(read.given, "joints", i);
    Case::Joint& joint = scene.joints[i];
    if (!scene.mesh.file.empty()) {
      fail(row.place("x1"),
           "[[joints]] cannot be added to mesh.file: put them into its mesh, as curves \"joint_...\"");
    }
    if (joint.x1 == joint.x2 && joint.y1 == joint.y2) {
      fail(row.place("x2"),
           fmt::format("the joint from ({0} m, {1} m) to ({0} m, {1} m) has no length", joint.x1, joint.y1));
    }
    finish_properties(joint, row, scene);
  }
  std::set<std::string> names;
  for (std::size_t i = 0; i < scene.joint_sets.size(); ++i) {
    const Row row(read.given, "joint_sets", i);
    Case::JointSet& set = scene.joint_sets[i];
    finish_source(set, row, i + 1, scene);
    finish_properties(set, row, scene);
    if (!names.insert(set.name).second) {
      fail(row.place("name"), set.name.empty()
                                  ? "two [[joint_sets]] without a name for the joints of mesh.file"
                                  : fmt::format("two [[joint_sets]] are named \"{}\"", set.name));
    }
  }
}

}  // namespace crackle
