// SPDX-License-Identifier: GPL-3.0-or-later
// Points move to where they make better triangles. The explicit time step of a run is set by its
// worst triangle, so this pays in every step.
//
// A point goes to the mean of the circumcentres of its triangles, weighted by area and by density
// 1 / size^4 (optimal Delaunay triangulation: Chen and Xu 2004, Alliez et al. 2005, eq. 2), but only
// where its smallest angle does not suffer; then the edges are flipped back to Delaunay, which never
// makes the smallest angle smaller (Lawson 1977). So the worst angle only gets better.
#include <algorithm>
#include <cmath>

#include "draft.hpp"

namespace crackle::meshing {
namespace {

constexpr double degree = 0.017453292519943295;
constexpr int sweeps = 12;

/// sin^2 of the smallest angle of a triangle; -1 when it is turned over.
double smallest_sine2(Vec2 p, Vec2 q, Vec2 r) {
  const double doubled_area = cross(q - p, r - p);
  if (doubled_area <= 0.0) return -1.0;
  const double a = dot(q - p, q - p), b = dot(r - q, r - q), c = dot(p - r, p - r);
  return doubled_area * doubled_area / (a * b * c) * std::min({a, b, c});
}

Vec2 circumcentre(Vec2 p, Vec2 q, Vec2 r) {
  const Vec2 u = q - p, v = r - p;
  const double d = 2.0 * cross(u, v);
  return p + (1.0 / d) * Vec2{v.y * dot(u, u) - u.y * dot(v, v), u.x * dot(v, v) - v.x * dot(u, u)};
}

/// The triangles round every point, and which points may move.
class Stars {
 public:
  explicit Stars(const Draft& draft) : draft_(draft), begin_(draft.points.size() + 1, 0) {
    for (const auto& triangle : draft.triangles) {
      for (const Index v : triangle) ++begin_[v + 1];
    }
    for (std::size_t v = 0; v < draft.points.size(); ++v) begin_[v + 1] += begin_[v];
    opposite_.resize(3 * draft.triangles.size());
    std::vector<Index> next(begin_.begin(), begin_.end() - 1);
    for (const auto& triangle : draft.triangles) {
      for (int i = 0; i < 3; ++i) {
        opposite_[next[triangle[i]]++] = {triangle[(i + 1) % 3], triangle[(i + 2) % 3]};
      }
    }
  }
  /// For every triangle of point v its other two corners, counter-clockwise.
  std::span<const std::array<Index, 2>> of(Index v) const {
    return {opposite_.data() + begin_[v], opposite_.data() + begin_[v + 1]};
  }
  /// sin^2 of the smallest angle round v, were v at `place`.
  double worst(Index v, Vec2 place) const {
    double least = 1.0;
    for (const auto& [q, r] : of(v)) {
      least = std::min(least, smallest_sine2(place, draft_.points[q], draft_.points[r]));
    }
    return least;
  }

 private:
  const Draft& draft_;
  std::vector<Index> begin_;
  std::vector<std::array<Index, 2>> opposite_;
};

std::vector<bool> on_segments(const Draft& draft) {
  std::vector<bool> fixed(draft.points.size(), false);
  for (const Segment& segment : draft.segments) {
    for (const Index v : segment.end) fixed[v] = true;
  }
  return fixed;
}

/// One sweep over all free points, in order: each sees where those before it have gone.
void relax(Draft& draft, const SizeField& size, const std::vector<bool>& fixed) {
  static const double good_enough = std::pow(std::sin(36.0 * degree), 2);
  const Stars stars(draft);
  for (Index v = 0; v < static_cast<Index>(draft.points.size()); ++v) {
    if (fixed[v]) continue;
    const Vec2 here = draft.points[v];
    Vec2 sum;
    double weight = 0.0;
    for (const auto& [q, r] : stars.of(v)) {
      const Vec2 b = draft.points[q], c = draft.points[r];
      const double h = size((1.0 / 3.0) * (here + b + c));
      const double w = cross(b - here, c - here) / (h * h * h * h);
      sum += w * (circumcentre(here, b, c) - here);
      weight += w;
    }
    const double before = std::min(stars.worst(v, here), good_enough);
    Vec2 step = (1.0 / weight) * sum;
    for (int attempt = 0; attempt < 3; ++attempt, step *= 0.5) {
      if (stars.worst(v, here + step) >= before) {
        draft.points[v] = here + step;
        break;
      }
    }
  }
}

}  // namespace

void smooth(Draft& draft, const SizeField& size) {
  for (int sweep = 0; sweep < sweeps; ++sweep) {
    relax(draft, size, on_segments(draft));
    triangulate(draft);
  }
}

}  // namespace crackle::meshing
