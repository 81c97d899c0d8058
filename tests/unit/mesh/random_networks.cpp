// SPDX-License-Identifier: GPL-3.0-or-later
#include "random_networks.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <random>

#include "mesh_checks.hpp"

namespace crackle::test {
namespace {

/// Of an edge from the joint it stands for, in element sizes.
constexpr double farthest_off = 1.5;

/// The n-th network: densities, lengths and directions of all kinds, some of them of round numbers that
/// overlap and touch exactly.
MeshRecipe recipe_of(int n, const std::string& generator) {
  std::mt19937_64 random(static_cast<std::uint64_t>(n));
  const auto uniform = [&](double low, double high) {
    return low + (high - low) * static_cast<double>(random() >> 11) * 0x1.0p-53;
  };
  MeshRecipe recipe;
  recipe.generator = generator;
  recipe.width = recipe.height = 0.3;
  recipe.wellbore_diameter = n % 4 == 0 ? 0.0 : 0.05;
  recipe.size_fine = 0.005;
  recipe.fine_radius = 0.05;
  recipe.size_coarse = 0.02;
  recipe.seed = static_cast<std::uint64_t>(n);
  recipe.joint_sets = {"a", "b"};
  for (Index set = 0; set < 2; ++set) {
    JointSet joints;
    joints.density = uniform(50.0, 700.0);
    joints.length.law = static_cast<JointLengths::Law>(random() % 4);
    joints.length.mean = uniform(0.01, 0.06);
    joints.length.deviation = 0.3 * joints.length.mean;
    joints.length.exponent = uniform(1.0, 3.0);
    joints.length.min = 0.002;
    joints.length.max = 0.2;
    joints.direction.law = static_cast<JointDirections::Law>(random() % 3);
    joints.direction.angle = uniform(0.0, std::numbers::pi);
    joints.direction.concentration = uniform(1.0, 100.0);
    joints.region = {{-0.16, -0.16}, {0.16, 0.16}};
    joints.clear_radius = n % 3 == 0 ? 0.035 : 0.0;
    joints.seed = random();
    for (Joint joint : generate_joints(joints, set)) {
      if (n % 5 == 0) {  // on a lattice: ends coincide, lines overlap, triple crossings
        for (double* x : {&joint.from.x, &joint.from.y, &joint.to.x, &joint.to.y})
          *x = 0.01 * std::round(100.0 * *x);
        if (joint.from == joint.to) continue;
      }
      recipe.joints.push_back(joint);
    }
  }
  return recipe;
}

double distance(Vec2 p, const Joint& joint) {
  const Vec2 along = joint.to - joint.from;
  const double share = std::clamp(dot(p - joint.from, along) / dot(along, along), 0.0, 1.0);
  return norm(p - joint.from - share * along);
}

/// Expects every point of a joint that lies in the rock to be near an edge of a joint, the wall or the
/// boundary.
void expect_covered(const Mesh& rock, const MeshRecipe& recipe, int n) {
  std::vector<Joint> lines;
  for (const Edge& edge : rock.edges) {
    if (edge.joint < 0 && edge.kind == EdgeKind::interior) continue;
    lines.push_back({rock.vertices[edge.vertex[0]], rock.vertices[edge.vertex[1]]});
  }
  for (const Joint& joint : recipe.joints) {
    const double length = norm(joint.to - joint.from);
    if (length < 0.02) continue;  // may be left out
    for (int i = 0; i <= 20; ++i) {
      const Vec2 p = joint.from + 0.05 * i * (joint.to - joint.from);
      if (std::abs(p.x) > 0.15 || std::abs(p.y) > 0.15 || norm(p) < 0.5 * recipe.wellbore_diameter) continue;
      double nearest = 1.0;
      for (const Joint& line : lines) nearest = std::min(nearest, distance(p, line));
      EXPECT_LE(nearest, farthest_off * target_size(recipe, p))
          << "network " << n << " at " << p.x << ", " << p.y;
    }
  }
}

}  // namespace

void expect_sound_networks(int first, int count, const std::string& generator) {
  double smallest = 180.0, sharpest = 180.0, farthest = 0.0, shortest = 1.0;
  Index joints = 0, shown = 0, sharp = 0, snapped = 0;
  int least = -1;
  for (int n = first; n < first + count; ++n) {
    SCOPED_TRACE("network " + std::to_string(n));
    const MeshRecipe recipe = recipe_of(n, generator);
    NetworkReport report;
    const Mesh mesh = generate_mesh(recipe, &report);
    expect_sound(mesh);
    EXPECT_EQ(euler_number(mesh), 1);
    EXPECT_EQ(checksum(mesh), checksum(generate_mesh(recipe)));
    const Mesh rock = excavate(mesh);
    expect_covered(rock, recipe, n);
    for (const Edge& edge : rock.edges) {
      if (edge.joint < 0) continue;
      const Joint& joint = recipe.joints.at(edge.joint);
      for (const Index v : edge.vertex) {
        const Vec2 p = rock.vertices[v];
        const double off = distance(p, joint) / target_size(recipe, p);
        farthest = std::max(farthest, off);
        EXPECT_LE(off, farthest_off);
      }
    }
    const double angle = measure_quality(rock, nullptr).min_angle_deg;
    if (angle < smallest) least = n;
    smallest = std::min(smallest, angle);
    EXPECT_GE(angle, least_angle_deg);
    sharpest = std::min(sharpest, report.sharpest_deg);
    joints += report.joints;
    shown += report.shown;
    sharp += report.sharp;
    snapped += report.snapped;
    EXPECT_EQ(report.joints, report.shown + report.merged + report.too_short + report.outside);
    for (const Edge& edge : rock.edges) {
      const Vec2 p = rock.vertices[edge.vertex[0]], q = rock.vertices[edge.vertex[1]];
      shortest = std::min(shortest, norm(q - p) / target_size(recipe, 0.5 * (p + q)));
    }
  }
  std::printf(
      "%d networks by %s: %d joints, %d with edges of their own, %d sharp angles (to %.2g degrees), %d "
      "points "
      "moved, edges within %.2f of the element size from their joint\n",
      count, generator.c_str(), joints, shown, sharp, sharpest, snapped, farthest);
  std::printf("  smallest angle of a triangle %.2f degrees (network %d), shortest edge %.2f of its target\n",
              smallest, least, shortest);
}

}  // namespace crackle::test
