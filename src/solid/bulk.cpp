// SPDX-License-Identifier: GPL-3.0-or-later
#include "crackle/solid/bulk.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "crackle/core/parallel.hpp"

namespace crackle {

struct TriangleRun {
  const Index* nodes;
  const Vec2* u;
  const Vec2* v;
  const std::array<double, 4>* inverse_shape;
  const double* area;
  const Sym2* in_situ;
  const double* viscosity;
  StrainRates* strain_rate;  // of the blocks from the mesh's first on; nullptr: not wanted
  Index begin, count;
};

namespace {

std::size_t at(Index i) { return static_cast<std::size_t>(i); }

using triangle::Gradient;

inline Gradient<double> gradient(const std::array<double, 4>& b, Vec2 a0, Vec2 a1, Vec2 a2) {
  return triangle::gradient<double>({b[0], b[1], b[2], b[3]}, a1.x - a0.x, a1.y - a0.y, a2.x - a0.x,
                                    a2.y - a0.y);
}

inline Sym2 green_strain(const Gradient<double>& h) {
  const auto e = triangle::green_strain(h);
  return {e.xx, e.yy, e.xy};
}

// Corner forces of one run of triangles; the viscous part is compiled out where there is none.
template <bool viscous>
[[gnu::always_inline]] inline double forces_of(const Index* __restrict nodes, const Vec2* __restrict u,
                                               const Vec2* __restrict v,
                                               const std::array<double, 4>* __restrict inverse_shape,
                                               const double* __restrict area, const Sym2* __restrict in_situ,
                                               const double* __restrict viscosity,
                                               StrainRates* __restrict strain_rate, const PlaneStiffness& c,
                                               Index begin, Index count, Vec2* __restrict forces) {
  double power = 0.0;
#pragma omp simd reduction(+ : power)
  for (Index t = 0; t < count; ++t) {
    const Index n0 = nodes[3 * t], n1 = nodes[3 * t + 1], n2 = nodes[3 * t + 2];
    const std::array<double, 4>& b = inverse_shape[t];
    const auto h = gradient(b, u[n0], u[n1], u[n2]);
    auto s = triangle::stress(c, triangle::green_strain(h));
    s = {s.xx + in_situ[t].xx, s.yy + in_situ[t].yy, s.xy + in_situ[t].xy};
    if constexpr (viscous) {
      const auto rate = triangle::strain_rate(h, gradient(b, v[n0], v[n1], v[n2]));
      if (strain_rate != nullptr) {
        StrainRates& of_block = strain_rate[(begin + t) / block_size];
        const Sym2 before = of_block.of((begin + t) % block_size);
        power += triangle::viscous_power(area[t], viscosity[t], rate, {before.xx, before.yy, before.xy});
        of_block.set((begin + t) % block_size, {rate.xx, rate.yy, rate.xy});
      }
      s = {s.xx + viscosity[t] * rate.xx, s.yy + viscosity[t] * rate.yy, s.xy + viscosity[t] * rate.xy};
    }
    const auto f = triangle::forces<double>(h, s, {b[0], b[1], b[2], b[3]}, area[t]);
    forces[3 * t] = Vec2{-f.x1 - f.x2, -f.y1 - f.y2};
    forces[3 * t + 1] = Vec2{f.x1, f.y1};
    forces[3 * t + 2] = Vec2{f.x2, f.y2};
  }
  return power;
}

template <bool viscous>
[[gnu::always_inline]] inline double forces_of(const TriangleRun& r, const PlaneStiffness& c, Vec2* forces) {
  return forces_of<viscous>(r.nodes, r.u, r.v, r.inverse_shape, r.area, r.in_situ, r.viscosity, r.strain_rate,
                            c, r.begin, r.count, forces);
}

CRACKLE_KERNEL double elastic_forces(const TriangleRun& r, const PlaneStiffness& c, Vec2* forces) {
  return forces_of<false>(r, c, forces);
}
CRACKLE_KERNEL double viscous_forces(const TriangleRun& r, const PlaneStiffness& c, Vec2* forces) {
  return forces_of<true>(r, c, forces);
}

// Energy of every triangle of a run [J/m], less what its weight [N/m3] has done.
[[gnu::always_inline]] inline void energies_of(const Index* __restrict nodes, const Vec2* __restrict u,
                                               const std::array<double, 4>* __restrict inverse_shape,
                                               const double* __restrict area, const Sym2* __restrict in_situ,
                                               const PlaneStiffness& c, double weight, Index count,
                                               double* __restrict energies) {
#pragma omp simd
  for (Index t = 0; t < count; ++t) {
    const Vec2 &u0 = u[nodes[3 * t]], &u1 = u[nodes[3 * t + 1]], &u2 = u[nodes[3 * t + 2]];
    const auto& b = inverse_shape[t];
    const triangle::Shape<double> shape{b[0], b[1], b[2], b[3]};
    const auto e =
        triangle::green_strain(triangle::gradient(shape, u1.x - u0.x, u1.y - u0.y, u2.x - u0.x, u2.y - u0.y));
    auto s = triangle::stress(c, e);
    s = {0.5 * s.xx + in_situ[t].xx, 0.5 * s.yy + in_situ[t].yy, 0.5 * s.xy + in_situ[t].xy};
    energies[t] = area[t] * (s.xx * e.xx + s.yy * e.yy + 2.0 * s.xy * e.xy) -
                  weight * area[t] / 3.0 * (u0.y + u1.y + u2.y);
  }
}

CRACKLE_KERNEL void energies(const TriangleRun& r, const PlaneStiffness& c, double weight, double* energy) {
  energies_of(r.nodes, r.u, r.inverse_shape, r.area, r.in_situ, c, weight, r.count, energy);
}

}  // namespace

Bulk::Bulk(const Mesh& mesh, std::vector<BulkMaterial> materials, std::vector<std::uint16_t> of_triangle,
           const Damping& damping)
    : materials_(std::move(materials)),
      of_triangle_(std::move(of_triangle)),
      viscous_(damping.viscosity > 0.0 || damping.ratio > 0.0),
      inverse_shape_(mesh.triangles.size()),
      area_(mesh.triangles.size()),
      in_situ_(mesh.triangles.size()) {
  if (viscous_) viscosity_.resize(mesh.triangles.size());
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto& v = mesh.triangles[t];
    const Vec2 d1 = mesh.vertices[at(v[1])] - mesh.vertices[at(v[0])];
    const Vec2 d2 = mesh.vertices[at(v[2])] - mesh.vertices[at(v[0])];
    const double twice = cross(d1, d2);
    inverse_shape_[t] = {d2.y / twice, -d2.x / twice, -d1.y / twice, d1.x / twice};
    area_[t] = 0.5 * twice;
    const double depth = -mesh.vertices[at(v[0])].y - (d1.y + d2.y) / 3.0;  // of the centroid
    const auto& [stiffness, density, in_situ] = materials_[number(static_cast<Index>(t))];
    in_situ_[t] = in_situ.origin + depth * in_situ.gradient;
    if (viscous_) {
      // Young's modulus from the stiffness, for the critical viscosity only.
      const double mu = stiffness.c66, lambda = stiffness.c12;
      const double young_modulus = mu * (3.0 * lambda + 2.0 * mu) / (lambda + mu);
      const double h =
          std::sqrt(4.0 / std::sqrt(3.0) * area_[t]);  // edge of the equilateral triangle of this area
      viscosity_[t] = damping.viscosity + damping.ratio * 2.0 * h * std::sqrt(young_modulus * density);
    }
  }
}

template <class Work>
void Bulk::for_each_material(Index begin, Index end, const Work& work) const {
  for (Index from = begin; from < end;) {
    Index to = layered() ? from + 1 : end;
    while (to < end && number(to) == number(from)) ++to;
    work(from, to);
    from = to;
  }
}

TriangleRun Bulk::run_of(const State& state, Index begin, Index end) const {
  const std::size_t b = at(begin);
  return {state.node_of_corner.data() + 3 * b,
          state.displacement.data(),
          state.velocity.data(),
          inverse_shape_.data() + b,
          area_.data() + b,
          in_situ_.data() + b,
          viscous_ ? viscosity_.data() + b : nullptr,
          nullptr,
          begin,
          end - begin};
}

double Bulk::corner_forces(State& state, Index begin, Index end, Vec2* forces) const {
  double power = 0.0;
  for_each_material(begin, end, [&](Index from, Index to) {
    TriangleRun run = run_of(state, from, to);
    if (viscous_) run.strain_rate = state.strain_rate.data();
    const PlaneStiffness& c = stiffness(from);
    Vec2* const first = forces + 3 * (from - begin);
    power += viscous_ ? viscous_forces(run, c, first) : elastic_forces(run, c, first);
  });
  add_weight(begin, end, forces);
  return power;
}

void Bulk::add_weight(Index begin, Index end, Vec2* forces) const {
  for (Index t = begin; t < end; ++t) {
    if (weight(t) == 0.0) continue;
    for (Index i = 0; i < 3; ++i) forces[3 * (t - begin) + i].y += corner_weight(t);
  }
}

std::array<Vec2, 3> Bulk::triangle_forces(const State& state, Index t) const {
  std::array<Vec2, 3> forces;
  const TriangleRun run = run_of(state, t, t + 1);
  if (viscous_) {
    viscous_forces(run, stiffness(t), forces.data());
  } else {
    elastic_forces(run, stiffness(t), forces.data());
  }
  add_weight(t, t + 1, forces.data());
  return forces;
}

std::array<double, 3> Bulk::rows(Index t, const PlaneStiffness& c) const {
  const auto g = shape_gradients(t);
  std::array<double, 3> rows{};
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) {
      // Columns of A g_i · C[sym(e ⊗ g_j)], and the larger singular value of the two by two block.
      const Vec2 x = c.stress({g[j].x, 0.0, 0.5 * g[j].y}) * g[i];
      const Vec2 y = c.stress({0.0, g[j].y, 0.5 * g[j].x}) * g[i];
      const double sum = dot(x, x) + dot(y, y), product = cross(x, y);
      rows[i] += area_[at(t)] *
                 std::sqrt(0.5 * (sum + std::sqrt(std::max(0.0, sum * sum - 4.0 * product * product))));
    }
  }
  return rows;
}

double Bulk::strain_energy(const State& state) const {
  return sum_over_blocks(state.mesh->triangle_count(), [&](Index begin, Index end) {
    std::array<double, block_size> energy;  // not initialised
    for_each_material(begin, end, [&](Index from, Index to) {
      energies(run_of(state, from, to), stiffness(from), weight(from), energy.data() + (from - begin));
    });
    return std::accumulate(energy.begin(), energy.begin() + (end - begin), 0.0);
  });
}

double Bulk::strain_energy(const State& state, Index t) const {
  double energy = 0.0;
  energies(run_of(state, t, t + 1), stiffness(t), 0.0, &energy);
  return energy;
}

Sym2 Bulk::stress(const State& state, Index triangle) const {
  const Index* n = &state.node_of_corner[at(3 * triangle)];
  const Gradient<double> h = gradient(inverse_shape_[at(triangle)], state.displacement[at(n[0])],
                                      state.displacement[at(n[1])], state.displacement[at(n[2])]);
  const Sym2 s = stiffness(triangle).stress(green_strain(h)) + in_situ_[at(triangle)];
  // σ = F S Fᵀ / J
  const double fxx = 1.0 + h.xx, fyy = 1.0 + h.yy, fxy = h.xy, fyx = h.yx;
  const double j = fxx * fyy - fxy * fyx;
  const double ax = fxx * s.xx + fxy * s.xy, ay = fxx * s.xy + fxy * s.yy;
  const double bx = fyx * s.xx + fyy * s.xy, by = fyx * s.xy + fyy * s.yy;
  return {(ax * fxx + ay * fxy) / j, (bx * fyx + by * fyy) / j, (ax * fyx + ay * fyy) / j};
}

Sym2 Bulk::small_stress(Index triangle, const std::array<Vec2, 3>& corners) const {
  const auto g = shape_gradients(triangle);
  Sym2 strain;
  for (std::size_t i = 0; i < 3; ++i) {
    const Vec2 u = corners[i];
    strain = strain + Sym2{u.x * g[i].x, u.y * g[i].y, 0.5 * (u.x * g[i].y + u.y * g[i].x)};
  }
  return in_situ(triangle) + stiffness(triangle).stress(strain);
}

double Bulk::area_ratio(const State& state, Index triangle) const {
  const Index* n = &state.node_of_corner[at(3 * triangle)];
  const Gradient<double> h = gradient(inverse_shape_[at(triangle)], state.displacement[at(n[0])],
                                      state.displacement[at(n[1])], state.displacement[at(n[2])]);
  return (1.0 + h.xx) * (1.0 + h.yy) - h.xy * h.yx;
}

std::array<Vec2, 3> Bulk::shape_gradients(Index triangle) const {
  const auto& b = inverse_shape_[at(triangle)];
  const Vec2 n1{b[0], b[1]}, n2{b[2], b[3]};
  return {-n1 - n2, n1, n2};
}

}  // namespace crackle
