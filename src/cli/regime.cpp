// SPDX-License-Identifier: GPL-3.0-or-later
#include "regime.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "crackle/core/errors.hpp"
#include "crackle/solve/estimates.hpp"
#include "layers.hpp"
#include "scene.hpp"

namespace crackle {
namespace {

constexpr double long_run = 1000.0;       // shear wave times from which inertia is past
constexpr double fast_growth = 0.1;       // of the Rayleigh speed, from which it counts
constexpr double uniform_pressure = 4.8;  // K_m
constexpr double little_leak_off = 0.01;  // of the injected volume

// What hinders a straight path along x, mirrored at both axes; empty: nothing.
std::string asymmetry(const Case& scene) {
  if (scene.fracture.angle != 0.0) return "fracture.angle is not 0";
  if (scene.fracture.offset != 0.0) return "fracture.offset is not 0";
  if (!scene.joints.empty() || !scene.joint_sets.empty()) return "there are joints";
  if (scene.stress.xy != 0.0) return "stress.xy is not 0";
  if (scene.stress_gradient != Sym2{}) return "the stress changes with depth";
  if (!scene.layers.empty()) return "there are layers";
  if (!scene.notches.empty()) return "there are [[notches]]";
  if (!scene.mesh.file.empty()) return "it has a grid of its own, not mesh.file";
  return {};
}

// Of the domain [m]; 0: that of a mesh file that does not say, where it does not matter.
double extent(const Case& scene) {
  const double given = std::max(scene.domain.width, scene.domain.height);
  if (given > 0.0 || scene.run.regime != "auto") return given;
  const Mesh mesh = read_gmsh(scene.mesh.file);
  const auto span = [&](double Vec2::*axis) {
    const auto [low, high] = std::ranges::minmax(mesh.vertices, {}, axis);
    return high.*axis - low.*axis;
  };
  return std::max(span(&Vec2::x), span(&Vec2::y));
}

struct Numbers {
  double modulus = 0.0, toughness = 0.0;  // E' [Pa], K [Pa m^0.5]
  double rate = 0.0, volume = 0.0;        // largest [m2/s], and all [m2], both wings
  double pump_time = 0.0;                 // until which it pumps [s]
  double wave_times = 0.0, speed = 0.0, snap = 0.0, k_m = 0.0;
};

Numbers numbers_of(const Case& scene) {
  Numbers n;
  const Case::Rock& rock = rock_at_well(scene);
  const PlaneStiffness stiffness = rock_stiffness(rock);
  const WaveSpeeds waves = wave_speeds(stiffness, rock.density);
  n.modulus = plane_strain_modulus(stiffness);
  n.toughness = toughness(n.modulus, rock.fracture_energy_mode1);
  for (const Case::PumpStage& p : scene.fluid.pump) {
    n.rate = std::max(n.rate, p.rate / scene.well.height);
    n.volume += p.rate / scene.well.height * (std::min(p.to, scene.run.end_time) - p.from);
    if (p.rate > 0.0) n.pump_time = std::min(p.to, scene.run.end_time);
  }
  if (const double across = extent(scene); across > 0.0) n.wave_times = scene.run.end_time * waves.s / across;
  if (const double start = first_half_length(scene); start > 0.0) {
    const double rayleigh = 0.92 * waves.s;
    n.speed =
        n.modulus * n.rate / (3.0 * std::sqrt(std::numbers::pi) * n.toughness * std::sqrt(start) * rayleigh);
    const double bore = 0.25 * std::numbers::pi * scene.wellbore.diameter * scene.wellbore.diameter;
    const double storage = scene.well.storage / scene.well.height + bore / scene.fluid.bulk_modulus;
    n.snap = std::sqrt(storage * n.modulus / (6.0 * std::numbers::pi)) / start;
  }
  if (scene.fluid.viscosity > 0.0 && n.rate > 0.0)
    n.k_m = dimensionless_toughness(n.modulus, n.toughness, scene.fluid.viscosity, n.rate);
  return n;
}

void check(const Case& scene) {
  const auto require = [&](bool holds, const std::string& what) { require_quasi_static(holds, scene, what); };
  require(scene.fracture.notch > 0.0 || is_bored(scene),
          "it starts from a fracture or the wall of a wellbore: give fracture.notch or wellbore.diameter");
  require(scene.fracture.notch == 0.0 || 2.0 * scene.fracture.notch > scene.wellbore.diameter,
          "fracture.notch counts from the origin: it has to end outside of the wellbore");
  require(
      std::ranges::none_of(scene.notches, [](const Case::Notch& n) { return n.fluid == "pumped"; }),
      "the well pumps into fracture.notch or its own wall alone: give fracture.notch, or [[notches]] with "
      "fluid = \"none\"");
  require(scene.loads.empty(), "[[loads]] are not yet taken: give the in-situ stress in [stress]");
  require(scene.boundary.outer != "absorbing",
          "nothing moves that boundary.outer = \"absorbing\" could take: write \"fixed\" or \"free\"");
  require(!scene.rock.tensile_strength_bedding && !scene.rock.cohesion_bedding &&
              !scene.rock.fracture_energy_mode1_bedding && !scene.rock.fracture_energy_mode2_bedding,
          "strengths along the bedding are not yet taken");
  require(scene.cohesive.insertion != "none",
          "it needs cohesive elements: cohesive.insertion = \"none\" has none");
  require(scene.fluid.viscosity > 0.0 || scene.fluid.flow == "auto" || scene.fluid.flow == "uniform",
          "fluid.flow = \"" + scene.fluid.flow + "\" needs a fluid.viscosity above 0");
  require(!scene.fluid.pump.empty(), "give a [[fluid.pump]]");
  require(
      confinement(scene) >= 0.0,
      fmt::format("an effective tension of {:.3g} MPa across the fracture would drive it on without fluid",
                  -1e-6 * confinement(scene)));
  if (is_straight(scene)) {
    require(asymmetry(scene).empty(), "fracture.path = \"straight\" cannot be: " + asymmetry(scene));
    require(
        scene.mesh.fine_radius > first_half_length(scene) + scene.mesh.size_fine,
        "mesh.fine_radius is where the path of the fracture ends: it has to be above fracture.notch and the "
        "wellbore's radius");
  }
}

std::string choose_flow(Case& scene, const Numbers& n) {
  const bool forced = scene.fluid.flow != "auto";
  // Where K_m says that pressure is uniform, viscous flow makes it so at no more cost.
  if (!forced) scene.fluid.flow = scene.fluid.viscosity > 0.0 ? "viscous" : "uniform";
  const std::string number = n.k_m > 0.0 ? fmt::format("K_m = {:.3g}", n.k_m) : "no viscosity";
  const char* meaning = n.k_m <= 0.0 || n.k_m >= uniform_pressure ? "toughness rules, pressure is uniform"
                        : n.k_m < 0.70                            ? "viscosity rules, pressure falls"
                                       : "toughness and viscosity both count, pressure falls";
  return fmt::format("flow: {}{} ({}: {} along the fracture)", scene.fluid.flow,
                     forced ? ", as fluid.flow says" : "", number, meaning);
}

std::string choose_leak_off(Case& scene, const Numbers& n) {
  if (scene.fluid.leak_off != "auto")
    return fmt::format("leak-off: {}, as fluid.leak_off says", scene.fluid.leak_off);
  const Case::Rock& rock = scene.rock;
  const bool porous = rock.permeability > 0.0 && rock.porosity > 0.0 && rock.pore_compressibility > 0.0 &&
                      rock.pore_viscosity > 0.0;
  double coefficient = scene.fluid.leak_off_coefficient;
  if (coefficient <= 0.0 && porous) {
    coefficient = std::max(0.0, confinement(scene)) *
                  std::sqrt(rock.permeability * rock.porosity * rock.pore_compressibility /
                            (std::numbers::pi * rock.pore_viscosity));
  }
  if (coefficient <= 0.0) {
    scene.fluid.leak_off = "none";
    return "leak-off: none (the rock has no permeability, and there is no fluid.leak_off_coefficient)";
  }
  const double length = toughness_half_length(n.modulus, n.toughness, n.volume);
  const double share = std::min(1.0, 8.0 * coefficient * length * std::sqrt(scene.run.end_time) / n.volume);
  const bool falls_off = scene.run.end_time > 1.5 * n.pump_time;
  scene.fluid.leak_off = share < little_leak_off ? "none" : porous && falls_off ? "diffusion" : "carter";
  if (scene.fluid.leak_off == "carter") scene.fluid.leak_off_coefficient = coefficient;
  return fmt::format(
      "leak-off: {} ({:.2g} of the injected volume would leak off, with {:.3g} m/s^0.5; the run "
      "is {:.3g} times as long as it pumps)",
      scene.fluid.leak_off, share, coefficient, scene.run.end_time / n.pump_time);
}

}  // namespace

bool is_straight(const Case& scene) {
  return scene.fracture.path == "straight" || (scene.fracture.path == "auto" && asymmetry(scene).empty());
}

double first_half_length(const Case& scene) {
  return std::max(scene.fracture.notch, 0.5 * scene.wellbore.diameter);
}

double confinement(const Case& scene) {
  const Sym2& s = stress_at_well(scene);
  if (is_straight(scene)) return -s.yy;
  return -(0.5 * (s.xx + s.yy) + std::hypot(0.5 * (s.xx - s.yy), s.xy));
}

void require_quasi_static(bool holds, const Case& scene, const std::string& what) {
  if (!holds) throw CaseError(scene.file, 0, 0, fmt::format("run.regime = \"quasi_static\": {}", what));
}

RegimeChoice choose_regime(const Case& scene) {
  RegimeChoice choice;
  choice.scene = scene;
  const Numbers n = numbers_of(scene);
  const bool forced = scene.run.regime != "auto";
  choice.quasi_static = forced ? scene.run.regime == "quasi_static"
                               : n.wave_times > long_run && n.speed > 0.0 && n.speed < fast_growth;
  std::string numbers = fmt::format("the run lasts {:.2g} shear wave times across the domain", n.wave_times);
  if (n.speed > 0.0)
    numbers += fmt::format("; the {} grows at {:.2g} of the Rayleigh speed at first",
                           scene.fracture.notch > 0.0 ? "notch" : "fracture", n.speed);
  choice.reasons.push_back(
      fmt::format("regime: {}{} ({}; quasi-static from {:.0f} on, below {}, with a notch or a wellbore)",
                  choice.quasi_static ? "quasi-static" : "dynamic", forced ? ", as run.regime says" : "",
                  numbers, long_run, fast_growth));
  if (!choice.quasi_static) {
    if (scene.fluid.wets == "tip")
      throw CaseError(scene.file, 0, 0,
                      "fluid.wets = \"tip\" is of field time: in steps it is \"damaged\" or \"broken\"");
    return choice;
  }
  check(scene);
  choice.scene.run.regime = "quasi_static";
  choice.scene.fracture.path = is_straight(scene) ? "straight" : "free";
  if (scene.fluid.wets == "auto") choice.scene.fluid.wets = "tip";
  if (n.snap > 1.0) {
    choice.reasons.push_back(fmt::format(
        "snap: the fluid stored in the well drives a fracture of less than {:.3g} m on by itself; only "
        "its viscosity and well.impedance hold it, {}",
        n.snap * first_half_length(scene),
        scene.run.hand_over ? "else explicit steps carry it through"
                            : "else the run ends there (run.hand_over)"));
  }
  choice.reasons.push_back(choose_leak_off(choice.scene, n));
  choice.reasons.push_back(choose_flow(choice.scene, n));
  return choice;
}

}  // namespace crackle
