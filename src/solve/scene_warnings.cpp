// SPDX-License-Identifier: GPL-3.0-or-later
#include "crackle/solve/scene_warnings.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

namespace crackle {
namespace {

constexpr double edges_per_zone = 3.0;     // Turon et al. 2007; five are better
constexpr double modulus_wanted = 0.95;    // of the rock's, under the penalty's compliance
constexpr double water_viscosity = 1e-3;   // [Pa s]
constexpr double toughness_regime = 4.8;   // K_m from which pressure is uniform (Dontsov 2017)
constexpr double crack_of_domain = 0.1;    // half-length over distance to the boundary
constexpr int wellbore_edges_wanted = 30;  // 1 % of hoop stress, validation A2
constexpr double damped_step = 0.7;        // of the step without viscosity
constexpr double advised_damping = 0.1;    // over critical

using Lines = std::vector<std::string>;

/// A length in the unit that people use for it.
std::string length(double metres) {
  return metres < 0.1 ? fmt::format("{:.3g} mm", 1e3 * metres) : fmt::format("{:.3g} m", metres);
}
std::string megapascal(double pressure) { return fmt::format("{:.4g} MPa", 1e-6 * pressure); }
std::string gigapascal(double modulus) { return fmt::format("{:.4g} GPa", 1e-9 * modulus); }
std::string millisecond(double time) { return fmt::format("{:.3g} ms", 1e3 * time); }

void cohesive_zones(const PlaneStiffness& stiffness, const CohesiveMaterial& m, const MeshMeasure& mesh,
                    Lines& lines) {
  const double modulus = plane_strain_modulus(stiffness);
  const auto look = [&](const char* what, double energy, double strength, const char* advice) {
    const double zone = cohesive_zone(modulus, energy, strength);
    if (zone >= edges_per_zone * mesh.edge) return;
    lines.push_back(
        fmt::format("warning: {} is not resolved: its cohesive zone ({}) spans {:.1f} edges of {}, {:.0f} "
                    "are needed; take edges "
                    "of {}, or {}",
                    what, length(zone), zone / mesh.edge, length(mesh.edge), edges_per_zone,
                    length(zone / edges_per_zone), advice));
  };
  look("opening (mode I)", m.fracture_energy_mode1, m.tensile_strength,
       "expect too high a breakdown pressure");
  look("sliding (mode II)", m.fracture_energy_mode2, m.cohesion, "do not rely on how much breaks in shear");
}

// Of all rocks, each warning once; where not all have it, with those that do.
void cohesive_zones(const Scene& scene, const MeshMeasure& mesh, Lines& lines) {
  Lines all;
  std::vector<std::vector<std::size_t>> rocks;  // of each line
  for (std::size_t layer = 0; layer <= scene.layers.size(); ++layer) {
    const RockMass& rock = scene.rock(layer);
    Lines here;
    for (const CohesiveMaterial& m : extreme_planes(rock.cohesive))
      cohesive_zones(rock.stiffness, m, mesh, here);
    for (const std::string& line : here) {
      const auto known = std::ranges::find(all, line) - all.begin();
      if (known == std::ssize(all)) all.push_back(line), rocks.emplace_back();
      auto& of = rocks[static_cast<std::size_t>(known)];
      if (of.empty() || of.back() != layer) of.push_back(layer);
    }
  }
  for (std::size_t i = 0; i < all.size(); ++i) {
    std::string where;
    for (const std::size_t layer : rocks[i]) {
      where += where.empty() ? " (in " : ", ";
      where += layer == 0 ? "the rock beside the layers" : fmt::format("layers.{}", layer - 1);
    }
    lines.push_back(all[i] + (rocks[i].size() <= scene.layers.size() ? where + ")" : ""));
  }
}

double longest_edge(const Scene& scene) {
  double longest = std::numeric_limits<double>::infinity();
  for (std::size_t layer = 0; layer <= scene.layers.size(); ++layer) {
    for (const CohesiveMaterial& m : extreme_planes(scene.rock(layer).cohesive))
      longest = std::min(longest, scene.law->longest_edge(m));
  }
  return longest;
}

// The longest element that damage can follow, across a crack and along it.
std::array<double, 2> damage_limits(const Scene& scene) {
  constexpr double inf = std::numeric_limits<double>::infinity();
  std::array<double, 2> limits{inf, inf};
  for (std::size_t layer = 0; layer < scene.damage.materials.size(); ++layer) {
    const DamageMaterial& m = scene.damage.materials[layer];
    std::vector<Vec2> normals{{1.0, 0.0}};
    if (m.bedding) normals = {m.bedding.normal, {-m.bedding.normal.y, m.bedding.normal.x}};
    for (const Vec2 n : normals) {
      const auto here =
          size_limits(m, *scene.damage.law, scene.rock(std::min(layer, scene.layers.size())).stiffness, n);
      for (std::size_t i = 0; i < 2; ++i) limits[i] = std::min(limits[i], here[i]);
    }
  }
  return limits;
}

// Far from the wellbore edges may be too long for the exact calibration: they are tougher than asked.
void coarse_edges(const Scene& scene, const MeshMeasure& mesh, Lines& lines) {
  const double longest = longest_edge(scene);
  if (mesh.longest_edge <= longest) return;
  lines.push_back(
      fmt::format("warning: edges longer than {} (up to {}, far from the wellbore) dissipate more than the "
                  "fracture energy, by their "
                  "elastic branch alone; a fracture that comes there meets tougher rock",
                  length(longest), length(mesh.longest_edge)));
}

void penalty_compliance(const Scene& scene, const MeshMeasure& mesh, Lines& lines) {
  if (scene.insertion.on_demand) return;  // only where it is about to break
  if (scene.triangle_stiffness) return;   // made up for
  const double modulus = plane_strain_modulus(scene.stiffness);
  const ModulusRatio ratio = artificial_modulus_ratio(modulus, scene.stiffness.c66, scene.cohesive.penalty,
                                                      mesh.sum_length2_over_area);
  if (ratio.young >= modulus_wanted) return;
  const double enough = 0.5 * mesh.sum_length2_over_area * modulus / (1.0 / modulus_wanted - 1.0);
  lines.push_back(fmt::format(
      "warning: cohesive elements make the rock softer than given: E' = {:.0f} % ({} of {}), G = {:.0f} %; "
      "compare "
      "with theory at these moduli, or take cohesive.compliance = \"compensated\", or cohesive.penalty = {} "
      "for {:.0f} % (the step falls to {:.2f} of "
      "this one)",
      100.0 * ratio.young, gigapascal(ratio.young * modulus), gigapascal(modulus), 100.0 * ratio.shear,
      gigapascal(enough), 100.0 * modulus_wanted, std::sqrt(scene.cohesive.penalty / enough)));
}

// A triangle is at most as long across a crack as its longest height, some edge long.
void damage_sizes(const Scene& scene, const MeshMeasure& mesh, Lines& lines) {
  const auto limit = damage_limits(scene);
  const auto look = [&](const char* what, double longest, double size, const char* where) {
    if (size <= longest) return;
    lines.push_back(fmt::format(
        "warning: in {} softening can follow only triangles up to {} ({}: {}): larger ones get a lower "
        "strength with the same energy, and are counted; take smaller ones, or damage.law = \"linear\"",
        what, length(longest), where, length(size)));
  };
  look("tension", limit[0], mesh.longest_edge, "the longest edge");
  look("shear", limit[1], mesh.edge, "edges near the wellbore");
}

double largest_rate(const Pump& pump, double end_time) {
  constexpr int samples = 1000;
  double rate = 0.0;
  for (int i = 0; i < samples; ++i) rate = std::max(rate, pump.rate(end_time * (i + 0.5) / samples));
  return rate;
}

void pressure_loss(const Scene& scene, double end_time, Lines& lines) {
  const double rate = largest_rate(scene.pump, end_time);
  if (!scene.fluid || scene.flow || rate <= 0.0) return;
  const double modulus = plane_strain_modulus(scene.stiffness);
  const double tough = toughness(modulus, scene.cohesive.fracture_energy_mode1);
  const double k = dimensionless_toughness(modulus, tough, water_viscosity, rate);
  if (k >= toughness_regime) return;
  lines.push_back(
      fmt::format("warning: the model's fluid has no viscosity and one pressure throughout; water (1 mPa s) "
                  "at this rate would lose pressure along the fracture (K_m = {:.2g}; uniform pressure needs "
                  "{}): take fracture lengths as upper and pressures as lower bounds, or "
                  "fluid.flow = \"viscous\" with a fluid.viscosity",
                  k, toughness_regime));
}

void domain_size(const Scene& scene, const MeshMeasure& mesh, double end_time, Lines& lines) {
  const WaveSpeeds speed = wave_speeds(scene.stiffness, scene.density);
  const double back = 2.0 * mesh.half_width / speed.p;
  if (scene.fluid && scene.loads.empty() && !scene.absorbing_boundary && back < end_time) {
    lines.push_back(
        fmt::format("warning: waves from the wellbore are back from the fixed boundary after {}, the run "
                    "lasts {}: take a domain "
                    "of {}, or boundary.outer = \"absorbing\"",
                    millisecond(back), millisecond(end_time), length(speed.p * end_time)));
  }
  const double injected = scene.pump.volume(0.0, end_time);
  const Onset onset = expected_onset(scene, end_time);
  if (injected <= 0.0 || !scene.fluid || (onset.expected && onset.end_pressure < onset.wall_pressure)) return;
  // What the wellbore keeps at the pressure that just holds a fracture open.
  const PrincipalStress far = principal_stress(scene.stress);
  const FilledHole hole{mesh.wellbore_area, scene.stiffness.c66, far.mean(), *scene.fluid,
                        scene.initial_pressure};
  const double left = injected - std::max(0.0, hole.injected(std::max(-far.largest, scene.initial_pressure)));
  const double modulus = plane_strain_modulus(scene.stiffness);
  const double longest = toughness_half_length(
      modulus, toughness(modulus, scene.cohesive.fracture_energy_mode1), std::max(left, 0.0));
  const double held = crack_of_domain * mesh.half_width;
  if (longest <= held) return;
  lines.push_back(fmt::format(
      "warning: the injected fluid could hold open a straight fracture of {} on either side; beyond {} (a "
      "tenth of the "
      "way to the boundary) the boundary is felt: look at extent_x_m and extent_y_m in summary.json",
      length(longest), length(held)));
}

void wellbore_edges(const MeshMeasure& mesh, Lines& lines) {
  if (mesh.wellbore_edges == 0 || mesh.wellbore_edges >= wellbore_edges_wanted) return;
  lines.push_back(
      fmt::format("warning: the wellbore has {} edges, too few for the stress at its wall: take {} or more "
                  "(smaller mesh.size_fine)",
                  mesh.wellbore_edges, wellbore_edges_wanted));
}

void damping(const Scene& scene, const MeshMeasure& mesh, const StableStep& stable, Lines& lines) {
  if (stable.limit >= damped_step * stable.without_viscosity) return;
  const double mu = scene.stiffness.c66, lambda = scene.stiffness.c12;
  const double young = mu * (3.0 * lambda + 2.0 * mu) / (lambda + mu);
  const double critical = 2.0 * mesh.edge * std::sqrt(young * scene.density);
  const double ratio = scene.damping.viscosity / critical + scene.damping.ratio;
  if (ratio <= advised_damping) return;  // what is advised costs that much in some meshes
  lines.push_back(fmt::format(
      "warning: damping alone cuts the time step from {:.3g} to {:.3g} s and slows fractures: it "
      "is {:.3g} times the "
      "critical {:.3g} Pa s of edges of {}; take damping.ratio = {} unless you mean it",
      stable.without_viscosity, stable.limit, ratio, critical, length(mesh.edge), advised_damping));
}

void wall_before_pumping(const Scene& scene, const MeshMeasure& mesh, Lines& lines) {
  if (mesh.wellbore_edges == 0) return;
  const double p = scene.fluid ? scene.initial_pressure : 0.0;
  const PrincipalStress hoop = wall_hoop_stress(scene.stress, p);
  const CohesiveMaterial m = weakest_plane(scene.cohesive);
  if (hoop.largest > m.tensile_strength) {
    lines.push_back(
        fmt::format("note: the stress alone pulls the wellbore wall apart before pumping: {} along the wall "
                    "at {} in the wellbore, "
                    "its tensile strength is {}",
                    megapascal(hoop.largest), megapascal(p), megapascal(m.tensile_strength)));
  }
  // Mohr-Coulomb: −σ_θθ = 2 c √N + N p,  √N = tan φ + √(1 + tan² φ)
  const double root = m.tan_friction + std::sqrt(1.0 + m.tan_friction * m.tan_friction);
  const double bears = 2.0 * m.cohesion * root + root * root * p;
  if (-hoop.smallest > bears) {
    lines.push_back(
        fmt::format("note: the stress alone crushes the wellbore wall before pumping (breakouts): {} of "
                    "compression along the wall, "
                    "which bears {}; the geostatic stage will take long and break elements",
                    megapascal(-hoop.smallest), megapascal(bears)));
  }
}

void late_onset(const Scene& scene, double end_time, Lines& lines) {
  const Onset onset = expected_onset(scene, end_time);
  if (!onset.expected || onset.end_pressure >= onset.wall_pressure) return;
  lines.push_back(
      fmt::format("note: the pump reaches {} by the end, below the {} at which the wellbore wall breaks "
                  "(Hubbert-Willis, 3 S_h - S_H "
                  "+ f_t): expect no fracture; pump longer or faster",
                  megapascal(onset.end_pressure), megapascal(onset.wall_pressure)));
}

}  // namespace

Onset expected_onset(const Scene& scene, double end_time) {
  Onset onset;
  const MeshMeasure mesh = measure_mesh(*scene.mesh);
  const double injected = scene.pump.volume(0.0, end_time);
  if (!scene.fluid || mesh.wellbore_edges == 0 || injected <= 0.0 || !scene.breaks()) return onset;
  const FilledHole hole{mesh.wellbore_area, scene.stiffness.c66, principal_stress(scene.stress).mean(),
                        *scene.fluid, scene.initial_pressure};
  onset.expected = true;
  onset.wall_pressure = hubbert_willis_pressure(scene.stress, weakest_plane(scene.cohesive).tensile_strength);
  onset.end_pressure = hole.pressure(injected);
  onset.time = time_of_volume(scene.pump, std::max(0.0, hole.injected(onset.wall_pressure)), end_time);
  onset.wall_pressure += scene.pore_pressure;
  onset.end_pressure += scene.pore_pressure;
  return onset;
}

std::string scene_error(const Scene& scene) {
  const MeshMeasure mesh = measure_mesh(*scene.mesh);
  if (scene.damage.law) {
    const double most = damage_limits(scene)[0];
    if (mesh.edge <= most) return {};
    return fmt::format(
        "smeared damage is not possible on edges longer than {} (their elastic energy is above the fracture "
        "energy), "
        "and those near the wellbore are {} long: take smaller ones",
        length(most), length(mesh.edge));
  }
  if (!scene.law) return {};
  const double longest = longest_edge(scene);
  if (mesh.edge <= longest) return {};
  return fmt::format(
      "cohesive.calibration = \"exact\" is not possible on edges longer than {} with cohesive.penalty = {} "
      "(their "
      "elastic branch alone takes more than the fracture energy), and those near the wellbore are {} long: "
      "take a "
      "penalty of {}, smaller edges, or calibration = \"y_geo\"",
      length(longest), gigapascal(scene.cohesive.penalty), length(mesh.edge),
      gigapascal(1.01 * scene.cohesive.penalty * mesh.edge / longest));
}

std::vector<std::string> scene_warnings(const Scene& scene, double end_time, const StableStep& stable) {
  Lines lines;
  const MeshMeasure mesh = measure_mesh(*scene.mesh);
  if (scene.law && !scene.damage.law) {
    penalty_compliance(scene, mesh, lines);
    coarse_edges(scene, mesh, lines);
  }
  if (scene.damage.law) damage_sizes(scene, mesh, lines);
  if (scene.breaks()) {
    cohesive_zones(scene, mesh, lines);
    pressure_loss(scene, end_time, lines);
    wall_before_pumping(scene, mesh, lines);
  }
  wellbore_edges(mesh, lines);
  domain_size(scene, mesh, end_time, lines);
  damping(scene, mesh, stable, lines);
  late_onset(scene, end_time, lines);
  return lines;
}

}  // namespace crackle
