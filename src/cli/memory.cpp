// SPDX-License-Identifier: GPL-3.0-or-later
//
// Memory of a run, counted from the arrays it holds at its largest: rock, cohesive elements and the
// factor of the geostatic stage. Within 20 % of the measured peak from 4e3 to 3.4e5 triangles.
#include <fmt/format.h>
#include <sys/resource.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <limits>
#include <string>

#include "crackle/core/errors.hpp"
#include "forecast.hpp"
#include "scene.hpp"

namespace crackle {
namespace {

// The program and its libraries before any mesh (measured).
constexpr double program = 24e6;

// A triangulation has half a vertex and 1.5 edges a triangle; the split state has three nodes a
// triangle and a cohesive element on every edge.
constexpr double vertices = 0.5, edges = 1.5, nodes = 3.0, corners = 3.0;

constexpr double mesh_bytes =
    vertices * sizeof(Vec2) + 2 * sizeof(std::array<Index, 3>) + sizeof(Region) + edges * sizeof(Edge);
constexpr double element_bytes = sizeof(Index) + sizeof(std::array<Index, 4>) + sizeof(Vec2) +
                                 sizeof(std::array<double, 4>) + sizeof(EndForces) + sizeof(CohesiveStatus) +
                                 sizeof(Index);
constexpr double state_bytes = corners * 3 * sizeof(Index) +  // corners and their elements
                               nodes * (2 * sizeof(Index) + 2 * sizeof(Vec2) + sizeof(double)) +
                               sizeof(Sym2) + edges * (element_bytes + sizeof(Index)) +
                               vertices * sizeof(Index);
constexpr double bulk_bytes = sizeof(std::array<double, 4>) + 2 * sizeof(double) + sizeof(Sym2);
constexpr double loop_bytes = (corners + nodes) * sizeof(Vec2);  // corner forces, velocities of the ledger
constexpr double held_bytes = mesh_bytes + state_bytes + bulk_bytes + loop_bytes;

// Geostatic stage: loads and forces per corner, a tied state, and the factor of the stiffness
// matrix, whose fill grows with the logarithm of the mesh (fitted to peaks at 1e5 and 3.4e5).
double solve_bytes(double triangles) {
  constexpr double entry = sizeof(double) + sizeof(Index);
  const double fill = entry * std::max(20.0, 9.0 * std::log2(std::max(2.0, triangles)) - 46.0);
  return 2.0 * corners * sizeof(Vec2) + fill;
}

/// Kilobytes behind a name in /proc/meminfo, as bytes; infinity without it.
double meminfo(const std::string& name) {
  std::ifstream file("/proc/meminfo");
  for (std::string key, rest; file >> key && std::getline(file, rest);) {
    if (key == name + ":") return 1024.0 * std::strtod(rest.c_str(), nullptr);
  }
  return std::numeric_limits<double>::infinity();
}

/// First number in a file; infinity if there is none ("max").
double number_in(const char* path) {
  double value = std::numeric_limits<double>::infinity();
  std::ifstream file(path);
  double read = 0.0;
  if (file >> read) value = read;
  return value;
}

void refuse_if_too_large(const Case& scene, double triangles, const char* about) {
  const double needed = memory_of_run(triangles), available = available_memory();
  if (needed <= available) return;
  const std::string count = triangles < 1e6 ? fmt::format("{:.0f} thousand", 1e-3 * triangles)
                                            : fmt::format("{:.0f} million", 1e-6 * triangles);
  throw CaseError(scene.file, 0, 0,
                  fmt::format("a mesh of {}{} triangles needs {} of memory and {} are available: increase "
                              "mesh.size_fine, or reduce mesh.fine_radius or mesh.size_coarse",
                              about, count, bytes_text(needed), bytes_text(available)));
}

}  // namespace

double memory_of_run(double triangles) { return program + triangles * (held_bytes + solve_bytes(triangles)); }

double available_memory() {
  double available = meminfo("MemAvailable");
  const double group = number_in("/sys/fs/cgroup/memory.max");
  if (std::isfinite(group)) {
    const double used = number_in("/sys/fs/cgroup/memory.current");
    available = std::min(available, std::isfinite(used) ? std::max(0.0, group - used) : group);
  }
  rlimit limit{};
  if (getrlimit(RLIMIT_AS, &limit) == 0 && limit.rlim_cur != RLIM_INFINITY) {
    available = std::min(available, static_cast<double>(limit.rlim_cur));
  }
  return available;
}

void require_memory(const Case& scene) {
  if (!scene.mesh.file.empty()) return;
  refuse_if_too_large(scene, estimate_triangles(mesh_recipe(scene)), "about ");
}

void require_memory(const Case& scene, Index triangles) { refuse_if_too_large(scene, triangles, ""); }

}  // namespace crackle
