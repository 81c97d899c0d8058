// SPDX-License-Identifier: GPL-3.0-or-later
//
// Memory of a run at its largest, counted from the arrays it holds then; what the static solve takes
// is fitted to measured peaks. tests/restart/resources_test.cpp holds it to 20 %.
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

// The program and its libraries before any mesh; HDF5 and its buffers (measured).
constexpr double program = 26e6, checkpoint_library = 14e6;

// A triangulation has half a vertex and 1.5 edges a triangle. A tied state has a node a vertex; the split one
// three a triangle, and a cohesive element on every edge.
constexpr double vertices = 0.5, edges = 1.5, split_nodes = 3.0, corners = 3.0;

constexpr double mesh_bytes =
    vertices * sizeof(Vec2) + 2 * sizeof(std::array<Index, 3>) + sizeof(Region) + edges * sizeof(Edge);
constexpr double node_bytes = 2 * sizeof(Index) + 2 * sizeof(Vec2) + sizeof(double);
constexpr double element_bytes = sizeof(Index) + sizeof(std::array<Index, 4>) + sizeof(Vec2) +
                                 sizeof(double) + sizeof(std::array<double, 4>) + sizeof(std::uint16_t) +
                                 sizeof(EndForces) + sizeof(CohesiveStatus) + sizeof(Index);
constexpr double bulk_bytes = sizeof(std::array<double, 4>) + 2 * sizeof(double) + sizeof(Sym2);

// A triangle's share of the state, which a checkpoint holds too.
double state_bytes(bool split) {
  return corners * 3 * sizeof(Index) + (split ? split_nodes : vertices) * node_bytes + sizeof(Sym2) +
         (split ? edges * element_bytes : 0.0) + edges * 2 * sizeof(Index) + vertices * sizeof(Index);
}

// Corner forces, velocities of the ledger, and a frame with the copy that VTK compresses.
double loop_bytes(bool split) {
  constexpr double frame = corners * 2 * sizeof(Vec2) + 2 * (corners * 4 + 3) * sizeof(float);
  return (corners + (split ? split_nodes : vertices)) * sizeof(Vec2) + frame;
}

// The geostatic stage of a tied state with all that it holds, for the most part the factor of the stiffness
// matrix, whose fill grows with the logarithm of the mesh.
double static_stage_bytes(double triangles) {
  return std::max(950.0, 1000.0 + 30.0 * std::log2(1e-5 * triangles));
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
  const RunMemoryUse use = memory_of_run(scene, triangles);
  const double needed = scene.output.checkpoint_every > 0.0 ? use.checkpoint : use.run,
               available = available_memory();
  if (needed <= available) return;
  const std::string count = triangles < 1e6 ? fmt::format("{:.0f} thousand", 1e-3 * triangles)
                                            : fmt::format("{:.0f} million", 1e-6 * triangles);
  throw CaseError(scene.file, 0, 0,
                  fmt::format("a mesh of {}{} triangles needs {} of memory and {} are available: increase "
                              "mesh.size_fine, or reduce mesh.fine_radius or mesh.size_coarse",
                              about, count, bytes_text(needed), bytes_text(available)));
}

}  // namespace

RunMemoryUse memory_of_run(const Case& scene, double triangles) {
  const bool split = scene.cohesive.insertion == "all";
  const double saved = mesh_bytes + state_bytes(split);
  const double loop = saved + bulk_bytes + loop_bytes(split);
  RunMemoryUse use;
  use.run = program + triangles * std::max(static_stage_bytes(triangles), loop);
  // The file as HDF5 has it in memory, and what goes to the disk.
  use.checkpoint = std::max(use.run, program + checkpoint_library + triangles * (loop + 2.0 * saved));
  return use;
}

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
