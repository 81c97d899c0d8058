// SPDX-License-Identifier: GPL-3.0-or-later
// Points move to where they make better triangles. The explicit time step of a run is set by its
// worst triangle, so this pays in every step. Only single points round triangles that fall short are
// moved, by trial (Freitag and Ollivier-Gooch 1997), and edges flipped back to Delaunay, which never
// makes the smallest angle smaller (Lawson 1977). Relaxing all points would do no better at the
// smallest angle, and would draw out rows of equilateral triangles along the walls, which steer
// fractures (see insert_ring() in cgal_generator.cpp).
#include <algorithm>
#include <cmath>
#include <span>

#include "draft.hpp"

namespace crackle::meshing {
namespace {

constexpr int mending_sweeps = 20;  // at most; it ends when nothing is left to mend

// What a triangle should fulfil. An equilateral one has 60 degrees, 0.866 and 1.
constexpr double wanted_sine2 = 0.2808;      // sin^2 of its smallest angle: 32 degrees
constexpr double wanted_height = 0.50;       // its smallest height over the wanted edge length
constexpr double wanted_longest_edge = 1.5;  // over the wanted edge length

/// Squares of a triangle's measures; doubled_area <= 0 when it is turned over.
struct Shape {
  double doubled_area, shortest, longest, product;
  Shape(Vec2 p, Vec2 q, Vec2 r) : doubled_area(cross(q - p, r - p)) {
    const double a = dot(q - p, q - p), b = dot(r - q, r - q), c = dot(p - r, p - r);
    shortest = std::min({a, b, c});
    longest = std::max({a, b, c});
    product = a * b * c;
  }
  /// sin^2 of the smallest angle, or -1
  double sine2() const {
    return doubled_area > 0.0 ? doubled_area * doubled_area * shortest / product : -1.0;
  }
  /// 1 and above: all wishes fulfilled for edges of length h
  double fitness(double h) const {
    const double height = doubled_area * doubled_area / (longest * h * h);
    return std::min({sine2() / wanted_sine2, height / (wanted_height * wanted_height),
                     wanted_longest_edge * wanted_longest_edge * h * h / longest});
  }
};

/// The triangles round every point: for each its other two corners, counter-clockwise.
class Stars {
 public:
  explicit Stars(const Draft& draft)
      : begin_(draft.points.size() + 1, 0), opposite_(3 * draft.triangles.size()) {
    for (const auto& triangle : draft.triangles) {
      for (const Index v : triangle) ++begin_[v + 1];
    }
    for (std::size_t v = 0; v < draft.points.size(); ++v) begin_[v + 1] += begin_[v];
    std::vector<Index> next(begin_.begin(), begin_.end() - 1);
    for (const auto& triangle : draft.triangles) {
      for (int i = 0; i < 3; ++i) {
        opposite_[next[triangle[i]]++] = {triangle[(i + 1) % 3], triangle[(i + 2) % 3]};
      }
    }
  }
  std::span<const std::array<Index, 2>> of(Index v) const {
    return {opposite_.data() + begin_[v], opposite_.data() + begin_[v + 1]};
  }

 private:
  std::vector<Index> begin_;
  std::vector<std::array<Index, 2>> opposite_;
};

std::vector<Index> free_points(const Draft& draft) {
  std::vector<bool> fixed(draft.points.size(), false);
  for (const Segment& segment : draft.segments) {
    for (const Index v : segment.end) fixed[v] = true;
  }
  std::vector<Index> free;
  for (Index v = 0; v < static_cast<Index>(draft.points.size()); ++v) {
    if (!fixed[v]) free.push_back(v);
  }
  return free;
}

/// Moves every free point with an unfit triangle, by trial in eight directions, to where the least
/// fit triangle round it is fittest. @returns whether any point moved
bool mend(Draft& draft, const SizeField& size, const std::vector<Index>& free) {
  constexpr double d = 0.70710678118654752;
  constexpr std::array<Vec2, 8> directions{
      {{1, 0}, {d, d}, {0, 1}, {-d, d}, {-1, 0}, {-d, -d}, {0, -1}, {d, -d}}};
  const Stars stars(draft);
  bool any_moved = false;
  for (const Index v : free) {
    const double h = size(draft.points[v]);
    double sharpest = wanted_sine2;  // a better height or length must not cost the smallest angle
    for (const auto& [q, r] : stars.of(v)) {
      sharpest = std::min(sharpest, Shape(draft.points[v], draft.points[q], draft.points[r]).sine2());
    }
    const auto worst = [&](Vec2 place) {
      double least = 1.0;
      for (const auto& [q, r] : stars.of(v)) {
        const Shape shape(place, draft.points[q], draft.points[r]);
        if (shape.sine2() < sharpest) return -1.0;
        least = std::min(least, shape.fitness(h));
      }
      return least;
    };
    double best = worst(draft.points[v]);
    for (double step = 0.2 * h; step > 0.005 * h && best < 1.0;) {
      const Vec2 here = draft.points[v];
      for (const Vec2 direction : directions) {
        const double trial = worst(here + step * direction);
        if (trial > best) {
          best = trial;
          draft.points[v] = here + step * direction;
          any_moved = true;
        }
      }
      if (draft.points[v] == here) step *= 0.5;
    }
  }
  return any_moved;
}

}  // namespace

void smooth(Draft& draft, const SizeField& size) {
  const std::vector<Index> free = free_points(draft);
  for (int sweep = 0; sweep < mending_sweeps && mend(draft, size, free); ++sweep) triangulate(draft);
}

}  // namespace crackle::meshing
