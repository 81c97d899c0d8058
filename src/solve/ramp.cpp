// SPDX-License-Identifier: GPL-3.0-or-later
#include "crackle/solve/ramp.hpp"

#include <algorithm>
#include <cmath>

#include "crackle/core/parallel.hpp"

namespace crackle {
namespace {

std::size_t at(Index i) { return static_cast<std::size_t>(i); }

constexpr int halvings = 60;  // of an interval: to the last bits
constexpr int doublings = 40;

std::vector<Sym2> stresses(State& tied, const Bulk& bulk, const std::vector<Vec2>& displacement) {
  tied.displacement = displacement;
  std::vector<Sym2> stress(tied.mesh->triangles.size());
  for_each_block(tied.mesh->triangle_count(), [&](Index begin, Index end, Index) {
    for (Index t = begin; t < end; ++t) stress[at(t)] = bulk.stress(tied, t);
  });
  return stress;
}

}  // namespace

Ramp::Ramp(Point first, Point last, const CompressibleFluid& fluid)
    : first_(std::move(first)), last_(std::move(last)), fluid_(fluid) {}

double Ramp::volume(double p) const {
  const double s = (p - first_.pressure) / (last_.pressure - first_.pressure);
  return first_.volume + s * (last_.volume - first_.volume);
}

double Ramp::capacity() const { return (mass(last_.pressure) - mass(first_.pressure)) / fluid_.density; }

double Ramp::pressure(double injected) const {
  const double wanted = mass(first_.pressure) + injected * fluid_.density;
  double low = first_.pressure, high = last_.pressure;
  for (int i = 0; i < halvings; ++i) {
    const double middle = 0.5 * (low + high);
    (mass(middle) < wanted ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

double Ramp::pressure_rate(double p, double injection_rate) const {
  const double swell = (last_.volume - first_.volume) / (last_.pressure - first_.pressure);
  const double storage = mass(p) / fluid_.density * (swell / volume(p) + 1.0 / fluid_.bulk_modulus);
  return injection_rate / storage;
}

Vec2 Ramp::compliance(Index vertex) const {
  return (1.0 / (last_.pressure - first_.pressure)) *
         (last_.displacement[at(vertex)] - first_.displacement[at(vertex)]);
}

Vec2 Ramp::displacement(Index vertex, double p) const {
  const double s = (p - first_.pressure) / (last_.pressure - first_.pressure);
  return (1.0 - s) * first_.displacement[at(vertex)] + s * last_.displacement[at(vertex)];
}

std::optional<double> onset_pressure(const State& at_rest, const Bulk& bulk,
                                     const std::function<const CohesiveMaterial&(Index)>& material,
                                     double share, const Ramp::Point& first, const Ramp::Point& second) {
  const Mesh& mesh = *at_rest.mesh;
  State tied = at_rest;
  const std::vector<Sym2> a = stresses(tied, bulk, first.displacement);
  const std::vector<Sym2> b = stresses(tied, bulk, second.displacement);
  // True if some edge passes at a pressure.
  const auto passes = [&](double pressure) {
    const double s = (pressure - first.pressure) / (second.pressure - first.pressure);
    const double worst = sum_over_blocks(mesh.edge_count(), [&](Index begin, Index end) {
      double any = 0.0;
      for (Index e = begin; e < end; ++e) {
        const Edge& edge = mesh.edges[at(e)];
        if (edge.kind != EdgeKind::interior) continue;
        const std::size_t t = at(edge.triangle[0]), o = at(edge.triangle[1]);
        const Sym2 stress = (0.5 * (1.0 - s)) * (a[t] + a[o]) + (0.5 * s) * (b[t] + b[o]);
        const Vec2 side = mesh.vertices[at(edge.vertex[1])] - mesh.vertices[at(edge.vertex[0])];
        if (Cohesive::utilisation(material(e), stress, (1.0 / norm(side)) * side) >= share) any = 1.0;
      }
      return any;
    });
    return worst > 0.0;
  };
  if (passes(first.pressure)) return {};
  double low = first.pressure, step = second.pressure - first.pressure;
  for (int i = 0; i < doublings && !passes(low + step); ++i) {
    low += step;
    step *= 2.0;
  }
  for (int i = 0; i < halvings && step > 1e-9 * std::abs(low + step); ++i) {
    step *= 0.5;
    if (!passes(low + step)) low += step;
  }
  return low;
}

}  // namespace crackle
