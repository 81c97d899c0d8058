// SPDX-License-Identifier: GPL-3.0-or-later
// One wing of a straight fracture along y = 0 in a half plane x > 0 (symmetric at x = 0), on a graded
// grid. Volumes and rates of the scene are those of one wing.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>

#include "crackle/mesh/grid.hpp"
#include "crackle/solve/quasi_static.hpp"

namespace crackle::wing {

inline std::shared_ptr<const Mesh> mesh(double step, double path, double radius) {
  const std::vector<double> x = graded_line(0.0, path, radius, {step, 1.2});
  std::vector<double> y = graded_line(0.0, 6.0 * step, radius, {step, 1.1});
  std::vector<double> both;
  for (std::size_t i = y.size(); i-- > 1;) both.push_back(-y[i]);
  both.insert(both.end(), y.begin(), y.end());
  return std::make_shared<const Mesh>(grid_rectangle(x, both, 6.0 * step));
}

/// Symmetry at x = 0, free elsewhere, and held in y at the far end of y = 0.
inline Held symmetric(const Mesh& mesh) {
  Held held(mesh.vertices.size(), 0);
  std::size_t far = 0;
  for (std::size_t v = 0; v < held.size(); ++v) {
    if (mesh.vertices[v].x == 0.0) held[v] = 1;
    if (mesh.vertices[v].y == 0.0 && mesh.vertices[v].x > mesh.vertices[far].x) far = v;
  }
  held[far] |= 2;
  return held;
}

/// The scene of a mesh with a path of `length` [m], `open` of it broken at first.
inline QuasiStaticScene scene(std::shared_ptr<const Mesh> mesh, double length, double open) {
  QuasiStaticScene s;
  s.held = symmetric(*mesh);
  Wing w;
  w.path = edges_along(*mesh, {0.0, 0.0}, {length, 0.0});
  const Edge& first = mesh->edges[static_cast<std::size_t>(w.path.front())];
  w.start =
      mesh->vertices[static_cast<std::size_t>(first.vertex[0])].x == 0.0 ? first.vertex[0] : first.vertex[1];
  const double step = length / static_cast<double>(w.path.size());
  w.open = static_cast<std::size_t>(std::lround(open / step));
  s.wings.push_back(std::move(w));
  s.law = find_law("linear");
  s.mesh = std::move(mesh);
  return s;
}

/// Mean and root mean square of relative errors, by weight d ln t.
class Errors {
 public:
  void add(double weight, double value, double reference) {
    const double error = value / reference - 1.0;
    weight_ += weight;
    sum_ += weight * error;
    squares_ += weight * error * error;
  }
  double mean() const { return 100.0 * sum_ / weight_; }  ///< [%]
  double rms() const { return 100.0 * std::sqrt(squares_ / weight_); }

 private:
  double weight_ = 0.0, sum_ = 0.0, squares_ = 0.0;
};

}  // namespace crackle::wing
