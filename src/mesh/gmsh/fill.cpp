// SPDX-License-Identifier: GPL-3.0-or-later
// The points of gmsh's Delaunay algorithm instead of random ones; refinement then only mends. gmsh gets lines
// that are already split where they cross: left to itself its built-in kernel drops crossing lines
// without a word.
#include <gmsh.h>

#include <unordered_map>

#include "crackle/core/errors.hpp"
#include "draft.hpp"
#include "gmsh_module.hpp"
#include "hilbert.hpp"
#include "random.hpp"
#include "session.hpp"
#include "wellbore.hpp"

namespace crackle::meshing::by_gmsh {
namespace {

constexpr double delaunay = 5;  // gmsh's Mesh.Algorithm
/// What the seed does: each of gmsh's points is moved at random by up to this share of the wanted
/// size each way before smoothing. (gmsh's frontal algorithm, number 6, lays rows of a lattice along
/// which fractures would run, and that through any jitter.)
constexpr double jitter = 0.15;
/// gmsh's mean edge and the points that refinement adds come out at the wanted size when gmsh is
/// asked for edges longer by this factor (tests hold it to 10 %).
constexpr double ask_for = 1.09;
constexpr int rock_surface = 1, core_surface = 2;

int curve_tag(std::size_t segment) { return static_cast<int>(segment) + 1; }

/// The curves of a closed line, in order; negative where they run backwards.
std::vector<int> loop_of(const Draft& draft, Line line) {
  std::unordered_map<Index, std::vector<std::size_t>> at;  // only looked up, never run through
  std::size_t first = draft.segments.size(), count = 0;
  for (std::size_t i = 0; i < draft.segments.size(); ++i) {
    if (draft.segments[i].line != line) continue;
    if (count++ == 0) first = i;
    for (const Index v : draft.segments[i].end) at[v].push_back(i);
  }
  std::vector<int> loop;
  std::size_t i = first;
  Index from = count > 0 ? draft.segments[first].end[0] : -1;
  while (loop.size() < count) {
    const bool forward = draft.segments[i].end[0] == from;
    loop.push_back(forward ? curve_tag(i) : -curve_tag(i));
    from = draft.segments[i].end[forward ? 1 : 0];
    const auto& both = at.at(from);
    if (both.size() != 2) throw MeshError("a joint runs along part of the wellbore or boundary: move it");
    i = both[0] == i ? both[1] : both[0];
  }
  return loop;
}

void set_options() {
  gmsh::option::setNumber("Mesh.Algorithm", delaunay);
  gmsh::option::setNumber("Mesh.MeshSizeExtendFromBoundary", 0);
  gmsh::option::setNumber("Mesh.MeshSizeFromPoints", 0);
  gmsh::option::setNumber("Mesh.MeshSizeFromCurvature", 0);
  gmsh::option::setNumber("General.NumThreads", 1);
}

void build_geometry(const Draft& draft, const std::vector<Vec2>& wellbore) {
  namespace geo = gmsh::model::geo;
  for (std::size_t v = 0; v < draft.points.size(); ++v) {
    geo::addPoint(draft.points[v].x, draft.points[v].y, 0.0, 0.0, static_cast<int>(v) + 1);
  }
  std::vector<int> in_rock, in_core;
  for (std::size_t i = 0; i < draft.segments.size(); ++i) {
    const Segment& segment = draft.segments[i];
    geo::addLine(segment.end[0] + 1, segment.end[1] + 1, curve_tag(i));
    if (segment.line != Line::joint) continue;
    const Vec2 middle = 0.5 * (draft.points[segment.end[0]] + draft.points[segment.end[1]]);
    (inside_polygon(wellbore, middle) ? in_core : in_rock).push_back(curve_tag(i));
  }
  geo::addCurveLoop(loop_of(draft, Line::outer), 1);
  if (wellbore.empty()) {
    geo::addPlaneSurface({1}, rock_surface);
  } else {
    geo::addCurveLoop(loop_of(draft, Line::wellbore), 2);
    geo::addPlaneSurface({1, 2}, rock_surface);
    geo::addPlaneSurface({2}, core_surface);
  }
  geo::synchronize();
  for (std::size_t i = 0; i < draft.segments.size(); ++i) {
    gmsh::model::mesh::setTransfiniteCurve(curve_tag(i), 2);  // one edge: it has its length already
  }
  if (!in_rock.empty()) gmsh::model::mesh::embed(1, in_rock, 2, rock_surface);
  if (!in_core.empty()) gmsh::model::mesh::embed(1, in_core, 2, core_surface);
}

/// The points that gmsh made inside the surfaces, jittered, neighbours close to each other.
std::vector<Vec2> read_points(const SizeField& size, std::uint64_t seed) {
  std::vector<std::size_t> tags;
  std::vector<double> coordinates, parameters;
  gmsh::model::mesh::getNodes(tags, coordinates, parameters, 2);
  Random random(seed);
  std::vector<Vec2> points;
  for (std::size_t i = 0; i < tags.size(); ++i) {
    const Vec2 place{coordinates[3 * i], coordinates[3 * i + 1]};
    const double x = random.between(-jitter, jitter), y = random.between(-jitter, jitter);
    points.push_back(place + size(place) * Vec2{x, y});
  }
  std::vector<Vec2> sorted;
  for (const Index i : hilbert_order(points)) sorted.push_back(points[i]);
  return sorted;
}

}  // namespace

void fill(Draft& draft, const MeshRecipe& recipe, const SizeField& size) {
  std::vector<Vec2> points;
  with_gmsh("gmsh cannot mesh the recipe", [&] {
    set_options();
    build_geometry(draft, wellbore_polygon(recipe));
    gmsh::model::mesh::setSizeCallback([&](int, int, double x, double y, double) {
      return ask_for * size({x, y});
    });
    gmsh::model::mesh::generate(2);
    points = read_points(size, recipe.seed);
  });
  Random random(recipe.seed);
  refine(draft, size, points, 0.5, random);
  smooth(draft, size);
}

}  // namespace crackle::meshing::by_gmsh
