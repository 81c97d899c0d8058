// SPDX-License-Identifier: GPL-3.0-or-later
// What keys of a case say of one another, and the defaults that follow from other keys.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <numeric>
#include <vector>

#include "case_read.hpp"

namespace crackle {
namespace {

namespace fs = std::filesystem;

void check_wellbore(const Case& scene, const GivenKeys& given) {
  const double diameter = scene.wellbore.diameter;
  const bool in_domain = scene.domain.width > 0.0 && scene.domain.height > 0.0;
  if (in_domain && diameter >= std::min(scene.domain.width, scene.domain.height)) {
    fail(given.latest({"wellbore.diameter", "domain.width", "domain.height"}),
         fmt::format("wellbore.diameter = {} m does not fit the domain of {} m x {} m", diameter,
                     scene.domain.width, scene.domain.height));
  }
  const bool pumped_notch =
      std::ranges::any_of(scene.notches, [](const Case::Notch& n) { return n.fluid != "none"; });
  if (diameter <= 0.0 && !scene.fluid.pump.empty() && scene.mesh.file.empty() &&
      scene.fracture.notch <= 0.0 && !pumped_notch) {
    fail(given.place("wellbore.diameter"),
         "wellbore.diameter = 0 leaves the pump without a wellbore or notch to inject into");
  }
  if (scene.wellbore.segments > 0 && scene.wellbore.segments < 3) {
    fail(given.place("wellbore.segments"),
         fmt::format("wellbore.segments = {} make no polygon: write 3 or more, or 0",
                     scene.wellbore.segments));
  }
}

void check_mesh(const Case& scene, const GivenKeys& given) {
  const Case::Mesh& mesh = scene.mesh;
  const double radius = scene.wellbore.diameter / 2.0;
  if (!mesh.file.empty()) {
    std::error_code error;
    if (!fs::is_regular_file(mesh.file, error)) {
      fail(given.place("mesh.file"), fmt::format("mesh.file: there is no file {}", mesh.file));
    }
    return;
  }
  if (mesh.size_fine > mesh.size_coarse) {
    fail(given.latest({"mesh.size_fine", "mesh.size_coarse"}),
         fmt::format("mesh.size_fine = {} m is above mesh.size_coarse = {} m", mesh.size_fine,
                     mesh.size_coarse));
  }
  if (mesh.size_fine > std::max(scene.domain.width, scene.domain.height)) {
    fail(given.latest({"mesh.size_fine", "domain.width", "domain.height"}),
         fmt::format("mesh.size_fine = {} m is above the size of the domain", mesh.size_fine));
  }
  if (radius > 0.0 && scene.wellbore.segments == 0 && mesh.size_fine > radius) {
    fail(given.latest({"mesh.size_fine", "wellbore.diameter"}),
         fmt::format("mesh.size_fine = {} m is above the wellbore's radius of "
                     "{} m: the wellbore would have fewer than "
                     "six edges",
                     mesh.size_fine, radius));
  }
  if (mesh.fine_radius > 0.0 && mesh.fine_radius < radius) {
    fail(given.latest({"mesh.fine_radius", "wellbore.diameter"}),
         fmt::format("mesh.fine_radius = {} m lies inside the wellbore, whose radius is {} m",
                     mesh.fine_radius, radius));
  }
}

void check_notch(const Case& scene, const GivenKeys& given) {
  const double notch = scene.fracture.notch;
  if (notch <= 0.0) return;
  if (!scene.mesh.file.empty()) return;  // a curve of it
  const double reach = notch + std::abs(scene.fracture.offset);
  const double x = std::abs(std::cos(scene.fracture.angle)) * reach;
  const double y = std::abs(std::sin(scene.fracture.angle)) * reach;
  if (x >= 0.5 * scene.domain.width || y >= 0.5 * scene.domain.height) {
    fail(given.latest({"fracture.notch", "fracture.offset", "domain.width", "domain.height"}),
         fmt::format("fracture.notch = {} m ends outside the domain of {} m x {} m", notch,
                     scene.domain.width, scene.domain.height));
  }
}

void finish_notches(Case& scene, const GivenKeys& given) {
  for (std::size_t row = 0; row < scene.notches.size(); ++row) {
    Case::Notch& notch = scene.notches[row];
    const auto stop = [&](const std::string& why) {
      fail(given.place(fmt::format("notches.{}.x1", row)), fmt::format("notch {} {}", row + 1, why));
    };
    const double a = 0.5 * scene.domain.width, b = 0.5 * scene.domain.height;
    const double near = 1e-9 * std::max(a, b);
    if (notch.fluid.empty()) notch.fluid = scene.fluid.pump.empty() ? "none" : "pumped";
    if (!scene.mesh.file.empty()) stop("cannot be cut into mesh.file: give a mesh.generator");
    if (std::hypot(notch.x2 - notch.x1, notch.y2 - notch.y1) <= near) stop("has no length");
    if (notch.fluid == "pumped" && scene.fluid.pump.empty())
      stop("has fluid = \"pumped\", but there is no [[fluid.pump]]");
    for (const auto& [x, y] : {std::pair{notch.x1, notch.y1}, std::pair{notch.x2, notch.y2}}) {
      if (std::abs(x) > a + near || std::abs(y) > b + near)
        stop(fmt::format("ends at ({} m, {} m), outside the domain", x, y));
      if (notch.fluid == "pumped" && (std::abs(x) > a - near || std::abs(y) > b - near))
        stop("reaches the boundary, where its fluid would run out: write fluid = \"none\", or end it inside");
    }
  }
}

bool across_is_x(const Case::Load& load) { return load.side == "left" || load.side == "right"; }

/// What is said of one component of a load.
struct LoadComponent {
  std::string_view axis;
  const std::optional<double>&traction, &velocity, &displacement;
  bool held;
};

void finish_load(Case::Load& load, const std::string& path, const GivenKeys& given) {
  const auto stop = [&](const std::string& why) {
    fail(given.place(path), fmt::format("load \"{}\": {}", load.name, why));
  };
  if (load.side.empty()) stop("give its side: \"left\", \"right\", \"bottom\" or \"top\"");
  if (load.from && load.to && *load.from > *load.to)
    stop(fmt::format("from = {} m is above to = {} m", *load.from, *load.to));
  const bool fixed = load.support == "fixed", roller = load.support == "roller";
  const std::array<LoadComponent, 2> components{
      {{"x", load.traction_x, load.velocity_x, load.displacement_x, fixed || (roller && across_is_x(load))},
       {"y", load.traction_y, load.velocity_y, load.displacement_y,
        fixed || (roller && !across_is_x(load))}}};
  int said = 0;
  for (const LoadComponent& c : components) {
    const int here = int{c.traction.has_value()} + int{c.velocity.has_value()} +
                     int{c.displacement.has_value()} + int{c.held};
    if (here > 1)
      stop(fmt::format("{} has more than one of traction, velocity, displacement and support", c.axis));
    if (c.displacement && load.ramp <= 0.0) stop("a displacement needs a ramp, the time that it takes");
    said += here;
  }
  if (said == 0) stop("it does nothing: give a traction, a velocity, a displacement or a support");
}

void finish_loads(Case& scene, const GivenKeys& given) {
  for (std::size_t row = 0; row < scene.loads.size(); ++row) {
    Case::Load& load = scene.loads[row];
    const std::string path = fmt::format("loads.{}", row);
    if (load.name.empty()) load.name = load.side;
    finish_load(load, path, given);
    for (std::size_t other = 0; other < row; ++other) {
      if (scene.loads[other].name == load.name)
        fail(given.place(path), fmt::format("two loads are called \"{}\": give them a name", load.name));
    }
  }
  if (scene.loads.empty()) return;
  if (scene.boundary.outer == "absorbing")
    fail(given.place("boundary.outer"), "boundary.outer = \"absorbing\" takes no [[loads]]");
  if (scene.run.regime == "quasi_static")
    fail(given.place("run.regime"),
         "run.regime = \"quasi_static\": [[loads]] are not yet taken: give the in-situ stress in [stress]");
}

void resolve_mesh_file(Case& scene, const GivenKeys& given) {
  if (!scene.mesh.file.empty()) scene.mesh.file = resolved_path(scene.mesh.file, given.place("mesh.file"));
}

void finish_pump(Case& scene, const GivenKeys& given) {
  std::vector<Case::PumpStage>& pump = scene.fluid.pump;
  const auto key = [](std::size_t row, std::string_view name) {
    return fmt::format("fluid.pump.{}.{}", row, name);
  };
  for (std::size_t row = 0; row < pump.size(); ++row) {
    const bool open = !given.has(key(row, "to"));
    if (open) pump[row].to = scene.run.end_time;
    if (pump[row].to <= pump[row].from) {
      fail(given.place(key(row, open ? "from" : "to")),
           fmt::format("the pump stage ends at {} s{}, not after its start at {} s", pump[row].to,
                       open ? " (run.end_time)" : "", pump[row].from));
    }
  }
  std::vector<std::size_t> order(pump.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::stable_sort(order, {}, [&](std::size_t row) { return pump[row].from; });
  for (std::size_t i = 1; i < order.size(); ++i) {
    const Case::PumpStage& before = pump[order[i - 1]];
    const Case::PumpStage& after = pump[order[i]];
    if (after.from < before.to) {
      fail(given.place(key(std::max(order[i], order[i - 1]), "from")),
           fmt::format("pump stages overlap: one lasts from {} to {} s{}, another from {} s", before.from,
                       before.to, given.has(key(order[i - 1], "to")) ? "" : " (run.end_time)", after.from));
    }
  }
  std::ranges::stable_sort(pump, {}, &Case::PumpStage::from);
}

bool has_bedding_strength(const Case::Rock& rock) {
  return rock.tensile_strength_bedding || rock.cohesion_bedding || rock.fracture_energy_mode1_bedding ||
         rock.fracture_energy_mode2_bedding;
}

void finish_bedding(Case::Rock& rock, const GivenKeys& given, const std::string& table) {
  const auto key = [&](const char* name) { return table + "." + name; };
  if (rock.bedding_exponent != 1.0 && !has_bedding_strength(rock)) {
    fail(given.place(key("bedding_exponent")),
         "bedding_exponent has nothing to interpolate: give tensile_strength_bedding or another "
         "value "
         "along the bedding");
  }
  if (!rock.young_modulus_normal && !rock.poisson_ratio_normal && !rock.shear_modulus_normal) {
    if (rock.bedding_angle != 0.0 && !has_bedding_strength(rock)) {
      fail(given.place(key("bedding_angle")),
           "bedding_angle turns nothing: the rock is the same in all directions until it has a "
           "young_modulus_normal or another modulus across the bedding, or a strength along it");
    }
    return;
  }
  const double along = rock.young_modulus;
  if (!rock.young_modulus_normal) rock.young_modulus_normal = along;
  if (!rock.poisson_ratio_normal) rock.poisson_ratio_normal = rock.poisson_ratio;
  const double across = *rock.young_modulus_normal, nu = *rock.poisson_ratio_normal;
  if (!rock.shear_modulus_normal) rock.shear_modulus_normal = 1.0 / (1.0 / along + (1.0 + 2.0 * nu) / across);
  const double left = 1.0 - rock.poisson_ratio - 2.0 * nu * nu * along / across;
  if (left <= 0.0) {
    fail(given.latest({key("poisson_ratio_normal"), key("young_modulus_normal"), key("poisson_ratio"),
                       key("young_modulus")}),
         fmt::format("straining such bedded rock would release energy: 1 - poisson_ratio - 2 "
                     "poisson_ratio_normal^2 young_modulus/young_modulus_normal = {:g} has to be above 0",
                     left));
  }
}

void finish_preset(Case::Cohesive& cohesive, const GivenKeys& given) {
  if (cohesive.preset != "y_geo") return;
  if (!given.has("cohesive.law")) cohesive.law = "evans_marathe";
  if (!given.has("cohesive.calibration")) cohesive.calibration = "y_geo";
  if (!given.has("cohesive.insertion")) cohesive.insertion = "all";
}

void check_compliance(const Case& scene, const GivenKeys& given) {
  if (scene.cohesive.compliance != "compensated" || scene.cohesive.insertion == "all") return;
  fail(given.latest({"cohesive.compliance", "cohesive.insertion"}),
       fmt::format("cohesive.compliance = \"compensated\" is for insertion = \"all\": with \"{}\" the edges "
                   "have no compliance to make up for",
                   scene.cohesive.insertion));
}

void finish_damage(Case& scene, const GivenKeys& given) {
  if (scene.cohesive.insertion != "none") {
    // What resolved.toml writes out, the values that hold anyway, is let pass.
    const Case::Damage usual;
    for (const auto& [key, differs] : {std::pair{"damage.law", scene.damage.law != usual.law},
                                       {"damage.preset", scene.damage.preset != usual.preset},
                                       {"damage.initiation", scene.damage.initiation != usual.initiation}}) {
      if (given.has(key) && differs) {
        fail(given.latest({key, "cohesive.insertion"}),
             fmt::format(
                 "{} is of smeared damage, which cohesive.insertion = \"none\" asks for; here it is \"{}\"",
                 key, scene.cohesive.insertion));
      }
    }
    return;
  }
  if (scene.run.regime == "quasi_static")
    fail(given.place("run.regime"),
         "run.regime = \"quasi_static\" needs cohesive elements, not insertion = \"none\"");
  if (scene.damage.initiation.empty())
    scene.damage.initiation = scene.damage.preset == "faithful" ? "box" : "mohr_coulomb";
}

/// Two ways to say one thing: the later layer (including file over included file) wins.
void finish_damping(Case::Damping& damping, const GivenKeys& given) {
  if (damping.viscosity && damping.ratio) {
    const Place viscosity = given.place("damping.viscosity");
    const Place ratio = given.place("damping.ratio");
    if (viscosity.layer == ratio.layer) {
      fail(viscosity.line > ratio.line ? viscosity : ratio, "[damping] takes viscosity or ratio, not both");
    }
    (viscosity.layer > ratio.layer ? damping.ratio : damping.viscosity).reset();
  }
  if (!damping.viscosity && !damping.ratio) damping.ratio = 0.1;
}

void check_leak_off(const Case& scene, const GivenKeys& given) {
  if (scene.fluid.leak_off == "carter" && scene.fluid.leak_off_coefficient <= 0.0)
    fail(given.place("fluid.leak_off"),
         "fluid.leak_off = \"carter\" needs a fluid.leak_off_coefficient above 0");
  const Case::Rock& rock = scene.rock;
  if (scene.fluid.leak_off == "diffusion" &&
      (rock.permeability <= 0.0 || rock.porosity <= 0.0 || rock.pore_compressibility <= 0.0 ||
       rock.pore_viscosity <= 0.0)) {
    fail(given.place("fluid.leak_off"),
         "fluid.leak_off = \"diffusion\" needs rock.permeability, porosity, pore_compressibility and "
         "pore_viscosity above 0");
  }
}

void finish_run(Case& scene, const GivenKeys& given) {
  if (scene.run.time_step > scene.run.end_time) {
    fail(given.latest({"run.time_step", "run.end_time"}),
         fmt::format("run.time_step = {} s is above run.end_time = {} s", scene.run.time_step,
                     scene.run.end_time));
  }
  if (scene.output.fields_every == 0.0) scene.output.fields_every = scene.run.end_time / 20.0;
  if (scene.output.history_every == 0.0) scene.output.history_every = scene.run.end_time / 1000.0;
}

}  // namespace

std::string resolved_path(const std::string& path, const Place& place) {
  const fs::path folder = place.line > 0 ? fs::path(place.file).parent_path() : fs::path();
  std::error_code error;
  const fs::path absolute = fs::absolute(folder / path, error);
  return error ? path : absolute.lexically_normal().string();
}

void finish_case(ReadCase& read) {
  Case& scene = read.scene;
  const GivenKeys& given = read.given;
  check_wellbore(scene, given);
  resolve_mesh_file(scene, given);
  check_mesh(scene, given);
  check_notch(scene, given);
  finish_notches(scene, given);
  finish_loads(scene, given);
  finish_run(scene, given);
  finish_pump(scene, given);
  finish_damping(scene.damping, given);
  inherit_rock(read);
  finish_bedding(scene.rock, given, "rock");
  for (std::size_t i = 0; i < scene.layers.size(); ++i)
    finish_bedding(scene.layers[i].rock, given, fmt::format("layers.{}", i));
  finish_preset(scene.cohesive, given);
  check_compliance(scene, given);
  finish_damage(scene, given);
  check_leak_off(scene, given);
  for (Case::Layer& layer : scene.layers) {
    if (layer.penalty == 0.0)
      layer.penalty = scene.cohesive.penalty > 0.0 ? scene.cohesive.penalty : 20.0 * layer.rock.young_modulus;
  }
  if (scene.cohesive.penalty == 0.0) scene.cohesive.penalty = 20.0 * scene.rock.young_modulus;
  if (scene.contact.normal_penalty == 0.0) scene.contact.normal_penalty = scene.cohesive.penalty;
  if (scene.contact.tangential_penalty == 0.0) scene.contact.tangential_penalty = scene.cohesive.penalty;
  if (!given.has("contact.friction_angle")) scene.contact.friction_angle = scene.rock.friction_angle;
  if (!given.has("fluid.initial_pressure")) scene.fluid.initial_pressure = scene.rock.pore_pressure;
  finish_joints(read);
  finish_layers(read);
}

}  // namespace crackle
