// SPDX-License-Identifier: GPL-3.0-or-later
// Edges along the constraints, before the plane is filled: refinement alone would halve a segment
// again and again and so miss the wanted size by up to a factor of two.
#include <algorithm>
#include <cmath>

#include "draft.hpp"

namespace crackle::meshing {
namespace {

Vec2 closest_to_origin(Vec2 p, Vec2 q) {
  const Vec2 along = q - p;
  return p + std::clamp(-dot(p, along) / dot(along, along), 0.0, 1.0) * along;
}

/// Places along a segment (0 at p, 1 at q) that cut it into pieces of about the wanted size.
std::vector<double> cuts(Vec2 p, Vec2 q, const SizeField& size) {
  const double length = norm(q - p);
  const double smallest = std::min({size(p), size(q), size(0.5 * (p + q)), size(closest_to_origin(p, q))});
  const int samples = static_cast<int>(std::clamp(8.0 * length / smallest, 16.0, 1e6));
  std::vector<double> pieces(samples + 1, 0.0);  // how many pieces fit between p and each sample
  for (int i = 0; i < samples; ++i) {
    const double middle = (i + 0.5) / samples;
    pieces[i + 1] = pieces[i] + length / samples / size(p + middle * (q - p));
  }
  const int count = std::max(1, static_cast<int>(std::lround(pieces.back())));
  std::vector<double> at;
  int i = 0;
  for (int k = 1; k < count; ++k) {
    const double wanted = pieces.back() * k / count;
    while (pieces[i + 1] < wanted) ++i;
    at.push_back((i + (wanted - pieces[i]) / (pieces[i + 1] - pieces[i])) / samples);
  }
  return at;
}

}  // namespace

void subdivide(Draft& draft, const SizeField& size) {
  std::vector<Segment> pieces;
  for (const Segment& segment : draft.segments) {
    const Vec2 p = draft.points[segment.end[0]], q = draft.points[segment.end[1]];
    Index last = segment.end[0];
    for (const double at : cuts(p, q, size)) {
      const Index next = static_cast<Index>(draft.points.size());
      draft.points.push_back(p + at * (q - p));
      pieces.push_back({{last, next}, segment.line, segment.joint});
      last = next;
    }
    pieces.push_back({{last, segment.end[1]}, segment.line, segment.joint});
  }
  draft.segments = std::move(pieces);
}

}  // namespace crackle::meshing
