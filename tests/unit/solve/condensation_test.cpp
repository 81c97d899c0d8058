// SPDX-License-Identifier: GPL-3.0-or-later
//
// Jumps on the intact mesh against a mesh whose nodes are doubled along the path.
#include "crackle/solve/condensation.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

#include "../../acceptance.hpp"
#include "crackle/mesh/grid.hpp"
#include "crackle/solve/equilibrium.hpp"

namespace crackle {
namespace {

std::size_t at(Index i) { return static_cast<std::size_t>(i); }

std::vector<double> solve(const Condensation& rock, std::vector<double> load) {
  const std::size_t n = load.size();
  std::vector<std::vector<double>> a(n, std::vector<double>(n));
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = 0; j <= i; ++j) a[i][j] = a[j][i] = rock.row(i)[j];
  }
  for (std::size_t k = 0; k < n; ++k) {
    for (std::size_t i = k + 1; i < n; ++i) {
      const double f = a[i][k] / a[k][k];
      for (std::size_t j = k; j < n; ++j) a[i][j] -= f * a[k][j];
      load[i] -= f * load[k];
    }
  }
  for (std::size_t i = n; i-- > 0;) {
    for (std::size_t j = i + 1; j < n; ++j) load[i] -= a[i][j] * load[j];
    load[i] /= a[i][i];
  }
  return load;
}

struct Body {
  std::shared_ptr<const Mesh> mesh = std::make_shared<const Mesh>(
      jittered(structured_rectangle({-1.0, -1.0}, {1.0, 1.0}, 16, 16, MeshPattern::cross), 0.0, 1));
  PlaneStiffness stiffness = isotropic_plane_strain(30e9, 0.25);
  Bulk bulk{*mesh, stiffness, 2500.0, {}, {}};
  Held held() const {
    Held h(mesh->vertices.size(), 0);
    for (const Edge& e : mesh->edges) {
      if (e.triangle[1] < 0) h[at(e.vertex[0])] = h[at(e.vertex[1])] = 3;
    }
    return h;
  }
  Index vertex(Vec2 where) const {
    for (std::size_t v = 0; v < mesh->vertices.size(); ++v) {
      if (norm(mesh->vertices[v] - where) < 1e-9) return static_cast<Index>(v);
    }
    return -1;
  }
};

TEST(Condensation, KinkedPathAgainstDoubledNodes) {
  const Body body;
  const Vec2 corners[] = {{-0.5, -0.25}, {0.0, -0.25}, {0.5, 0.25}};
  FracturePath path(body.mesh, body.held(), true);
  Index inner = body.vertex(corners[0]), parent = -1;
  for (int leg = 0; leg < 2; ++leg) {
    for (const Index e : edges_along(*body.mesh, corners[leg], corners[leg + 1])) {
      parent = path.add(e, inner, parent);
      inner = path.edges()[at(parent)].vertex[1];
    }
  }
  Condensation rock(body.mesh, body.bulk, body.held());
  rock.follow(path.unknowns());
  // A pressure so small that finite rotation does not count, on both faces, half an edge to each end.
  std::vector<double> load(rock.size());
  for (const PathEdge& e : path.edges()) {
    for (const auto& end : e.jump) {
      for (const JumpTerm& t : end) load[at(t.unknown)] += 1e-3 * 0.5 * e.length * t.normal;
    }
  }
  const std::vector<double> jumps = solve(rock, load);

  // The same body, with every inner vertex of the path doubled for the triangles of the jump's sector.
  Mesh doubled = *body.mesh;
  std::vector<Index> twin(body.mesh->vertices.size(), -1);
  for (const JumpUnknown& u : path.unknowns()) {
    if (twin[at(u.vertex)] >= 0) continue;
    twin[at(u.vertex)] = doubled.vertex_count();
    doubled.vertices.push_back(doubled.vertices[at(u.vertex)]);
    for (const Index t : u.triangles) {
      for (Index& v : doubled.triangles[at(t)]) {
        if (v == u.vertex) v = twin[at(u.vertex)];
      }
    }
  }
  const auto split = std::make_shared<Mesh>(doubled);
  build_edges(*split);
  const Bulk bulk(*split, body.stiffness, 2500.0, {}, {});
  std::vector<char> fixed(split->vertices.size(), 0);
  const Held held = body.held();
  for (std::size_t v = 0; v < held.size(); ++v) fixed[v] = held[v] != 0;
  const auto push = [&](const State& state, std::span<Vec2> forces) {
    for (const PathEdge& p : path.edges()) {
      const Edge& e = body.mesh->edges[at(p.edge)];
      for (std::size_t side = 0; side < 2; ++side) {
        const Index t = e.triangle[side];
        for (std::size_t i = 0; i < 3; ++i) {
          const Index v = body.mesh->triangles[at(t)][i];
          if (v == e.vertex[0] || v == e.vertex[1])
            forces[3 * at(t) + i] += (side == 0 ? -0.5e-3 : 0.5e-3) * p.length * p.normal;
        }
      }
    }
    (void)state;
  };
  const std::vector<Vec2> u = static_displacement(split, bulk, fixed, push);
  double worst = 0.0, largest = 0.0;
  for (std::size_t k = 0; k < jumps.size(); ++k) {
    const JumpUnknown& unknown = path.unknowns()[k];
    const Vec2 jump = u[at(twin[at(unknown.vertex)])] - u[at(unknown.vertex)];
    worst = std::max(worst, std::abs(dot(jump, unknown.direction) - jumps[k]));
    largest = std::max(largest, std::abs(jumps[k]));
  }
  std::printf("split nodes against doubled ones, %zu unknowns: %.1e (of %.1e m)\n", jumps.size(),
              worst / largest, largest);
  accept(1, "split nodes against doubled ones, kinked path", "1e-10", text("%.1e", worst / largest),
         worst / largest <= 1e-10);
  EXPECT_LT(worst / largest, 1e-10);
}

TEST(FracturePath, BranchAndTakenBack) {
  const Body body;
  FracturePath path(body.mesh, body.held(), true);
  const auto add = [&](Vec2 from, Vec2 to) {
    Index inner = body.vertex(from), parent = -1;
    for (const Index e : edges_along(*body.mesh, from, to)) {
      parent = path.add(e, inner, parent);
      inner = path.edges()[at(parent)].vertex[1];
    }
  };
  add({-0.5, 0.0}, {0.5, 0.0});  // 8 edges, 7 inner vertices
  EXPECT_EQ(path.unknowns().size(), 14U);
  add({0.0, 0.0}, {0.0, 0.5});  // one more sector at the junction, 3 inner vertices
  EXPECT_EQ(path.unknowns().size(), 22U);
  Condensation rock(body.mesh, body.bulk, body.held());
  rock.follow(path.unknowns());
  for (std::size_t i = 0; i < rock.size(); ++i) EXPECT_GT(rock.row(i)[i], 0.0);
  path.truncate(8);
  EXPECT_EQ(path.unknowns().size(), 14U);
  for (const PathEdge& e : path.edges()) {
    for (const auto& end : e.jump) EXPECT_LE(end.size(), 2U);
  }
}

}  // namespace
}  // namespace crackle
