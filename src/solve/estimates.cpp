// SPDX-License-Identifier: GPL-3.0-or-later
#include "crackle/solve/estimates.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

namespace crackle {
namespace {

std::size_t at(Index i) { return static_cast<std::size_t>(i); }

constexpr int halvings = 200;  // of an interval: to the last bit

double double_area(const Mesh& mesh, const std::array<Index, 3>& corner) {
  const Vec2 p = mesh.vertices[at(corner[0])];
  return cross(mesh.vertices[at(corner[1])] - p, mesh.vertices[at(corner[2])] - p);
}

/// Median length [m] of the interior edges that begin within a radius of the origin.
double median_edge(const Mesh& mesh, double radius) {
  std::vector<double> lengths;
  for (const Edge& edge : mesh.edges) {
    const Vec2 p = mesh.vertices[at(edge.vertex[0])], q = mesh.vertices[at(edge.vertex[1])];
    if (edge.kind == EdgeKind::interior && norm(p) <= radius) lengths.push_back(norm(q - p));
  }
  if (lengths.empty()) return 0.0;
  const auto middle = lengths.begin() + static_cast<std::ptrdiff_t>(lengths.size() / 2);
  std::nth_element(lengths.begin(), middle, lengths.end());
  return *middle;
}

}  // namespace

MeshMeasure measure_mesh(const Mesh& mesh) {
  MeshMeasure m;
  m.half_width = std::numeric_limits<double>::infinity();
  double sum = 0.0, area = 0.0;
  for (const auto& corner : mesh.triangles) area += 0.5 * double_area(mesh, corner);
  for (const Edge& edge : mesh.edges) {
    const Vec2 p = mesh.vertices[at(edge.vertex[0])], q = mesh.vertices[at(edge.vertex[1])];
    const double length = norm(q - p);
    if (edge.kind == EdgeKind::interior) {
      sum += length * length;
      if (length > m.longest_edge) {
        m.longest_edge = length;
        m.longest_place = 0.5 * (p + q);
      }
    } else if (edge.kind == EdgeKind::wellbore) {
      ++m.wellbore_edges;
      m.wellbore_area -= 0.5 * cross(p, q);  // rock lies to the left: clockwise round the hole
    } else {
      m.half_width = std::min(m.half_width, std::abs(cross(p, q)) / length);  // distance to the edge's line
    }
  }
  m.sum_length2_over_area = sum / area;
  const double radius = std::sqrt(std::max(0.0, m.wellbore_area) / std::numbers::pi);
  m.edge = median_edge(mesh, radius > 0.0 ? 3.0 * radius : std::numeric_limits<double>::infinity());
  return m;
}

double plane_strain_modulus(const PlaneStiffness& stiffness) {
  return stiffness.c11 - stiffness.c12 * stiffness.c12 / stiffness.c11;
}

double cohesive_zone(double modulus, double fracture_energy, double strength) {
  return 9.0 * std::numbers::pi / 32.0 * modulus * fracture_energy / (strength * strength);
}

double toughness(double modulus, double fracture_energy_mode1) {
  return std::sqrt(modulus * fracture_energy_mode1);
}

PrincipalStress principal_stress(Sym2 s) {
  const double mean = 0.5 * (s.xx + s.yy);
  const double radius = std::hypot(0.5 * (s.xx - s.yy), s.xy);
  return {mean + radius, mean - radius};
}

PrincipalStress wall_hoop_stress(Sym2 stress, double pressure) {
  const PrincipalStress far = principal_stress(stress);
  const double mean = 2.0 * far.mean() + pressure, swing = 4.0 * far.half_difference();
  return {mean + swing, mean - swing};
}

double hubbert_willis_pressure(Sym2 stress, double tensile_strength) {
  return tensile_strength - wall_hoop_stress(stress, 0.0).largest;
}

double FilledHole::injected(double p) const {
  const auto filling = [&](double at_pressure) {
    const double volume = area * (1.0 + (mean_stress + at_pressure) / shear_modulus);
    return fluid.mass(volume, at_pressure) / fluid.density;
  };
  return filling(p) - filling(initial_pressure);
}

double FilledHole::pressure(double volume) const {
  double low = initial_pressure, high = initial_pressure + 1e-3 * fluid.bulk_modulus;
  while (injected(high) < volume) high += high - initial_pressure;
  for (int i = 0; i < halvings && low < high; ++i) {
    const double middle = 0.5 * (low + high);
    (injected(middle) < volume ? low : high) = middle;
  }
  return high;
}

double time_of_volume(const Pump& pump, double volume, double end_time) {
  if (pump.volume(0.0, end_time) < volume) return std::numeric_limits<double>::infinity();
  double low = 0.0, high = end_time;
  for (int i = 0; i < halvings && low < high; ++i) {
    const double middle = 0.5 * (low + high);
    (pump.volume(0.0, middle) < volume ? low : high) = middle;
  }
  return high;
}

double toughness_half_length(double modulus, double toughness, double volume) {
  const double k = 4.0 * std::sqrt(2.0 / std::numbers::pi) * toughness;
  return 0.9324 * std::pow(modulus * volume / k, 2.0 / 3.0);
}

double dimensionless_toughness(double modulus, double toughness, double viscosity, double rate) {
  const double k = 4.0 * std::sqrt(2.0 / std::numbers::pi) * toughness;
  return k / std::pow(modulus * modulus * modulus * 12.0 * viscosity * rate, 0.25);
}

}  // namespace crackle
