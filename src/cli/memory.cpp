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
#include "quasi_static_scene.hpp"
#include "regime.hpp"
#include "scene.hpp"

namespace crackle {
namespace {

// The program and its libraries before any mesh; VTK with a frame; HDF5 with a file (measured).
constexpr double program = 26e6, frame_library = 5e6, checkpoint_library = 8e6;

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

// What the loop reads beside the state (solve/tiles): numbers of corners, sides, viscosity of the rock;
// numbers, ends and limits of elements; lists of nodes.
double tile_bytes(bool split) {
  constexpr double rock = 3 * sizeof(std::uint16_t) + 4 * sizeof(double) + sizeof(double);
  constexpr double element = sizeof(Index) + 4 * sizeof(std::uint16_t) + 7 * sizeof(double);
  constexpr double nodes = 10;
  return rock + (split ? edges * element : 0.0) + nodes;
}

// Velocities that the ledger keeps; corner by corner a frame's places and fields of two components, with the
// copy of three that VTK compresses; its cells.
double row_bytes(bool split) { return (split ? split_nodes : vertices) * sizeof(Vec2); }
double frame_bytes(const Case& scene) {
  const auto wanted = [&](const char* name) {
    const auto& fields = scene.output.fields;
    return fields.empty() || std::ranges::find(fields, name) != fields.end();
  };
  double bytes = corners * (5 * sizeof(double) + sizeof(Index));
  for (const char* name : {"displacement_m", "velocity_m_s"})
    bytes += wanted(name) ? corners * 5 * sizeof(float) : 0.0;
  return bytes + (wanted("stress_Pa") ? 3 * sizeof(float) : 0.0) + sizeof(float);
}

// The geostatic stage of a tied state with all that it holds, for the most part the factor of the stiffness
// matrix, whose fill grows with the logarithm of the mesh.
double static_stage_bytes(double triangles) {
  return std::max(950.0, 1000.0 + 30.0 * std::log2(1e-5 * triangles));
}

// In field time the factor of the stiffness in double precision leads by far (fitted to measured peaks).
RunMemoryUse memory_of_field_time(const Case& scene, double triangles) {
  const double doublings = std::log2(triangles / 3e4);
  const double a_triangle = on_half_grid(scene) ? 950.0 + 110.0 * doublings : 1325.0 + 174.0 * doublings;
  const double run = program + frame_library + triangles * std::max(a_triangle, 700.0);
  return {run, run + 0.5 * checkpoint_library};
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
  if (in_field_time(scene)) return memory_of_field_time(scene, triangles);
  const bool split = scene.cohesive.insertion == "all";
  const double saved = mesh_bytes + state_bytes(split);
  const double resident = saved + bulk_bytes + tile_bytes(split);
  RunMemoryUse use;
  use.run =
      program + std::max(triangles * static_stage_bytes(triangles),
                         frame_library + triangles * (resident + row_bytes(split) + frame_bytes(scene)));
  // The file as HDF5 has it in memory, and what goes to the disk.
  use.checkpoint =
      std::max(use.run, program + frame_library + checkpoint_library + triangles * (resident + 2.0 * saved));
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
  const bool grid = in_field_time(scene) && on_half_grid(scene);
  refuse_if_too_large(scene, grid ? estimate_grid_triangles(scene) : estimate_triangles(mesh_recipe(scene)),
                      "about ");
}

void require_memory(const Case& scene, Index triangles) { refuse_if_too_large(scene, triangles, ""); }

}  // namespace crackle
