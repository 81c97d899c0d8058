// SPDX-License-Identifier: GPL-3.0-or-later
#include "case_schema.hpp"

#include <algorithm>
#include <cctype>
#include <deque>
#include <numbers>

#include "case_slot.hpp"
#include "crackle/core/errors.hpp"
#include "utc_time.hpp"

namespace crackle {
namespace {

const Quantity plain{"a plain number", {"1"}, "0.25"};
const Quantity length{"a length", {"m"}, "\"3 mm\""};
const Quantity speed{"a speed", {"m/s"}, "\"1 cm/s\""};
const Quantity duration{"a time", {"s"}, "\"1.2e-3 s\""};
const Quantity density{"a density", {"kg/m3"}, "\"2700 kg/m3\""};
const Quantity pressure{"a pressure", {"Pa"}, "\"35 MPa\""};
const Quantity pressure_gradient{"a pressure per length", {"Pa/m"}, "\"-15 kPa/m\""};
const Quantity angle{"an angle", {"rad"}, "\"38 deg\""};
const Quantity energy_per_area{"an energy per area", {"J/m2"}, "\"5 J/m2\""};
const Quantity viscosity{"a viscosity", {"Pa s"}, "\"1e4 Pa s\""};
/// In the plane a rate is per metre of thickness: "65 l/s" stands for 65 l/s a metre, as papers write it.
const Quantity rate{
    "an injection rate per metre of thickness", {"m2/s", "m3/s"}, "\"65 l/s\" or \"0.065 m2/s\""};
const Quantity per_area{"a number per area", {"1/m2"}, "\"320 1/m2\""};
const Quantity permeability{"a permeability", {"m2"}, "\"1e-19 m2\""};
const Quantity compressibility{"a compressibility", {"Pa-1"}, "\"1.5e-8 Pa-1\""};
const Quantity storage{"a volume per pressure", {"m3/Pa"}, "\"1.35e-8 m3/Pa\""};
const Quantity impedance{"a pressure per rate", {"Pa s/m3"}, "\"2e8 Pa s/m3\""};
const Quantity friction_of_rate{"a pressure per rate squared", {"Pa s2/m6"}, "\"1e10 Pa s2/m6\""};
const Quantity degrees{"an angle on Earth in degrees", {"degree"}, "8.5"};

constexpr double inf = std::numeric_limits<double>::infinity();
constexpr double right_angle = std::numbers::pi / 2.0;

const Range any{.text = "finite"};
const Range positive{.low = 0.0, .low_allowed = false, .text = "above 0"};
const Range not_negative{.low = 0.0, .text = "0 or more"};
const Range stiffness{
    .low = 0.0, .low_allowed = false, .text = "above 0: a modulus of 0 or less is not stable"};
const Range strength{.low = 0.0, .low_allowed = false, .text = "above 0: strengths are given without a sign"};
const Range breaking{.low = 0.0, .low_allowed = false, .text = "above 0: breaking takes energy"};
const Range poisson{-1.0, 0.5, false, false,
                    "above -1 and below 0.5: beyond, straining would release energy"};
const Range friction{0.0, right_angle, true, false, "from 0 to below 90 degrees"};
const Range fraction{0.0, 1.0, false, true, "above 0 and at most 1"};
const Range concentrated{0.0, 1e6, true, true, "from 0 (any direction) to 1e6"};
const Range east{-180.0, 180.0, true, true, "from -180 to 180 degrees"};
const Range north{-90.0, 90.0, true, true, "from -90 to 90 degrees"};
const Range any_count{0.0, inf, true, true, "0 or more"};

KeySpec number(std::string_view key, Slot slot, const Quantity& quantity, const Range& range, Need need,
               std::string_view meaning, std::string_view fallback = {}, std::string_view zero_word = {}) {
  return {.key = key,
          .slot = slot,
          .need = need,
          .meaning = meaning,
          .fallback = fallback,
          .quantity = &quantity,
          .range = range,
          .zero_word = zero_word};
}

KeySpec count(std::string_view key, Slot slot, std::string_view meaning, std::string_view fallback = {}) {
  return {.key = key, .slot = slot, .meaning = meaning, .fallback = fallback, .range = any_count};
}

KeySpec text(std::string_view key, Slot slot, std::string_view meaning, std::string_view fallback = {}) {
  return {.key = key, .slot = slot, .meaning = meaning, .fallback = fallback};
}

KeySpec choice(std::string_view key, Slot slot, std::vector<std::string_view> choices,
               std::string_view meaning, std::string_view fallback = {}) {
  return {.key = key, .slot = slot, .meaning = meaning, .fallback = fallback, .choices = std::move(choices)};
}

/// A text that is also part of names in other files.
KeySpec named(std::string_view key, Slot slot, std::string_view meaning, std::string_view fallback) {
  return {.key = key,
          .slot = slot,
          .meaning = meaning,
          .fallback = fallback,
          .check = [](const std::string& name) {
            const auto allowed = [](unsigned char c) {
              return c < 128 && (std::isalnum(c) != 0 || c == '_' || c == '-');
            };
            if (name.empty() || name.size() > 64 || !std::ranges::all_of(name, allowed)) {
              throw CaseError("write 1 to 64 letters, digits, _ or -");
            }
          }};
}

KeySpec moment(std::string_view key, Slot slot, std::string_view meaning) {
  return {.key = key, .slot = slot, .meaning = meaning, .check = [](const std::string& iso) {
            // the bound keeps a long text out of the recursion of std::regex
            parse_utc(iso.size() < 48 ? iso : iso.substr(0, 48) + "...");
          }};
}

using C = Case;
using JP = C::JointProperties;
using JS = C::JointSet;

template <auto member>
Slot of_set() {
  return slot<&C::joint_sets, member>();
}

/// What joints, sets of them and interfaces of layers have.
template <auto... path>
std::vector<KeySpec> joint_properties() {
  // clang-format off
  return {
      choice("law", slot<path..., &JP::law>(), {"frictional", "bonded"}, "\"frictional\": closed, slides by friction; \"bonded\": breaks like rock"),
      number("residual_friction_angle", slot<path..., &JP::residual_friction_angle>(), angle, friction, Need::never, "friction angle of sliding faces", "contact.friction_angle"),
      number("normal_penalty", slot<path..., &JP::normal_penalty>(), pressure, positive, Need::never, "stiffness times edge length of closed joints", "cohesive.penalty"),
      number("tangential_penalty", slot<path..., &JP::tangential_penalty>(), pressure, positive, Need::never, "of faces that stick", "contact.tangential_penalty"),
      number("tensile_strength", slot<path..., &JP::tensile_strength>(), pressure, strength, Need::never, "of a bonded joint, which needs it", "none"),
      number("cohesion", slot<path..., &JP::cohesion>(), pressure, strength, Need::never, "of a bonded joint, which needs it", "none"),
      number("friction_angle", slot<path..., &JP::friction_angle>(), angle, friction, Need::never, "internal, of a bonded joint, which needs it", "none"),
      number("fracture_energy_mode1", slot<path..., &JP::fracture_energy_mode1>(), energy_per_area, breaking, Need::never, "of a bonded joint, which needs it", "none"),
      number("fracture_energy_mode2", slot<path..., &JP::fracture_energy_mode2>(), energy_per_area, breaking, Need::never, "of a bonded joint, which needs it", "none"),
  };
  // clang-format on
}

std::vector<KeySpec> with(std::vector<KeySpec> keys, const std::vector<KeySpec>& more) {
  keys.insert(keys.end(), more.begin(), more.end());
  return keys;
}

/// What the rock and each layer has.
template <auto... path>
std::vector<KeySpec> rock_properties(Need need) {
  using R = C::Rock;
  // clang-format off
  return {
      number("density", slot<path..., &R::density>(), density, positive, need, "mass density of the rock"),
      number("young_modulus", slot<path..., &R::young_modulus>(), pressure, stiffness, need, "Young's modulus"),
      number("poisson_ratio", slot<path..., &R::poisson_ratio>(), plain, poisson, need, "Poisson's ratio"),
      number("tensile_strength", slot<path..., &R::tensile_strength>(), pressure, strength, need, "tensile strength"),
      number("cohesion", slot<path..., &R::cohesion>(), pressure, strength, need, "shear strength without normal stress"),
      number("friction_angle", slot<path..., &R::friction_angle>(), angle, friction, need, "internal friction angle"),
      number("fracture_energy_mode1", slot<path..., &R::fracture_energy_mode1>(), energy_per_area, breaking, need, "fracture energy in opening"),
      number("fracture_energy_mode2", slot<path..., &R::fracture_energy_mode2>(), energy_per_area, breaking, need, "fracture energy in sliding"),
      number("young_modulus_normal", slot<path..., &R::young_modulus_normal>(), pressure, stiffness, Need::never, "across the bedding of bedded rock; young_modulus is along it", "none: not bedded"),
      number("poisson_ratio_normal", slot<path..., &R::poisson_ratio_normal>(), plain, poisson, Need::never, "strain along the bedding under stress across it", "rock.poisson_ratio, in bedded rock"),
      number("shear_modulus_normal", slot<path..., &R::shear_modulus_normal>(), pressure, stiffness, Need::never, "shear modulus across the bedding", "that of Saint-Venant, in bedded rock"),
      number("bedding_angle", slot<path..., &R::bedding_angle>(), angle, any, Need::never, "from x to the bedding, anticlockwise"),
      number("tensile_strength_bedding", slot<path..., &R::tensile_strength_bedding>(), pressure, strength, Need::never, "of planes along the bedding; between, v(a) = v + (v_bedding - v) cos^2m(a), a from the bedding's normal to the plane's", "rock.tensile_strength"),
      number("cohesion_bedding", slot<path..., &R::cohesion_bedding>(), pressure, strength, Need::never, "of planes along the bedding", "rock.cohesion"),
      number("fracture_energy_mode1_bedding", slot<path..., &R::fracture_energy_mode1_bedding>(), energy_per_area, breaking, Need::never, "of planes along the bedding", "rock.fracture_energy_mode1"),
      number("fracture_energy_mode2_bedding", slot<path..., &R::fracture_energy_mode2_bedding>(), energy_per_area, breaking, Need::never, "of planes along the bedding", "rock.fracture_energy_mode2"),
      number("bedding_exponent", slot<path..., &R::bedding_exponent>(), plain, positive, Need::never, "m: with 1 strength is linear in cos^2 of the angle (Pietruszczak and Mroz 2001), with more the rock is weak only nearer to the bedding"),
  };
  // clang-format on
}

/// A layer: where it lies, its rock, its stress, its interfaces.
std::vector<KeySpec> layer_keys() {
  using L = C::Layer;
  // clang-format off
  std::vector<KeySpec> keys{
      number("bottom", slot<&C::layers, &L::bottom>(), length, any, Need::never, "its lower interface: distance from the origin along the layer's normal, y where it is level", "down to the boundary"),
      number("top", slot<&C::layers, &L::top>(), length, any, Need::never, "its upper interface", "up to the boundary"),
      number("dip", slot<&C::layers, &L::dip>(), angle, any, Need::never, "of both interfaces, from x anticlockwise; 90 deg: an upright layer"),
      number("stress_xx", slot<&C::layers, &L::stress, &Sym2::xx>(), pressure, any, Need::never, "far-field effective stress in the layer", "stress.xx"),
      number("stress_yy", slot<&C::layers, &L::stress, &Sym2::yy>(), pressure, any, Need::never, "in the layer", "stress.yy"),
      number("stress_xy", slot<&C::layers, &L::stress, &Sym2::xy>(), pressure, any, Need::never, "in the layer", "stress.xy"),
      number("stress_gradient_xx", slot<&C::layers, &L::stress_gradient, &Sym2::xx>(), pressure_gradient, any, Need::never, "in the layer", "stress.gradient_xx"),
      number("stress_gradient_yy", slot<&C::layers, &L::stress_gradient, &Sym2::yy>(), pressure_gradient, any, Need::never, "in the layer", "stress.gradient_yy"),
      number("penalty", slot<&C::layers, &L::penalty>(), pressure, not_negative, Need::never, "of its cohesive elements", "cohesive.penalty if given, else 20 young_modulus"),
  };
  // clang-format on
  for (KeySpec key : rock_properties<&C::layers, &L::rock>(Need::never)) {
    key.fallback = "that of [rock]";
    keys.push_back(key);
  }
  static std::deque<std::string> names;  // that keys point to
  for (KeySpec key : joint_properties<&C::layers, &L::interface>()) {
    const bool law = key.key == "law";
    key.key = names.emplace_back(law ? "interface" : "interface_" + std::string(key.key));
    if (law) {
      key.choices = {"perfect", "bonded", "frictional"};
      key.meaning =
          "how its interfaces bear: \"perfect\": as one, \"bonded\": with a strength, \"frictional\"; the "
          "following keys are of the last two";
    }
    keys.push_back(key);
  }
  return keys;
}

std::vector<TableSpec> make_tables() {
  // clang-format off
  return {
    {"", {
      text("title", slot<&C::title>(), "what the case is", "none"),
      text("include", {}, "a case file, or a list of them, whose keys hold unless given here", "none"),
    }},
    {"domain", {
      number("width", slot<&C::domain, &C::Domain::width>(), length, positive, Need::without_mesh_file, "extent in x, centred on the origin"),
      number("height", slot<&C::domain, &C::Domain::height>(), length, positive, Need::without_mesh_file, "extent in y, centred on the origin"),
    }},
    {"wellbore", {
      number("diameter", slot<&C::wellbore, &C::Wellbore::diameter>(), length, not_negative, Need::with_pump, "of the wellbore at the origin; 0: no wellbore", "0, without a pump"),
      count("segments", slot<&C::wellbore, &C::Wellbore::segments>(), "edges round the wellbore; 0: as many as mesh.size_fine asks for"),
    }},
    {"mesh", {
      choice("generator", slot<&C::mesh, &C::Mesh::generator>(), {"cgal", "gmsh"}, "program that makes the triangles"),
      number("size_fine", slot<&C::mesh, &C::Mesh::size_fine>(), length, positive, Need::without_mesh_file, "edge length within fine_radius"),
      number("fine_radius", slot<&C::mesh, &C::Mesh::fine_radius>(), length, not_negative, Need::without_mesh_file, "radius of the fine part round the origin"),
      number("size_coarse", slot<&C::mesh, &C::Mesh::size_coarse>(), length, positive, Need::without_mesh_file, "edge length at the outer boundary"),
      count("seed", slot<&C::mesh, &C::Mesh::seed>(), "of the random numbers of the mesh"),
      text("file", slot<&C::mesh, &C::Mesh::file>(), "a .msh file instead of a generator, relative to the file that names it", "none"),
    }},
    {"rock", with(rock_properties<&C::rock>(Need::always), {
      number("pore_pressure", slot<&C::rock, &C::Rock::pore_pressure>(), pressure, any, Need::never, "of the formation; given, all pressures of the fluid are total ones, else above it"),
      number("permeability", slot<&C::rock, &C::Rock::permeability>(), permeability, not_negative, Need::never, "for fluid.leak_off = \"diffusion\""),
      number("porosity", slot<&C::rock, &C::Rock::porosity>(), plain, Range{0.0, 1.0, true, false, "from 0 to below 1"}, Need::never, "for fluid.leak_off = \"diffusion\""),
      number("pore_compressibility", slot<&C::rock, &C::Rock::pore_compressibility>(), compressibility, not_negative, Need::never, "of pores and what fills them, for diffusion"),
      number("pore_viscosity", slot<&C::rock, &C::Rock::pore_viscosity>(), viscosity, not_negative, Need::never, "of the fluid in the pores, for diffusion"),
    })},
    rows_of<&C::layers>("layers", layer_keys()),
    {"cohesive", {
      choice("preset", slot<&C::cohesive, &C::Cohesive::preset>(), {"accurate", "y_geo"}, "defaults of law, calibration and insertion; \"y_geo\": evans_marathe, y_geo, all edges, as in Y-Geo"),
      choice("law", slot<&C::cohesive, &C::Cohesive::law>(), {"evans_marathe", "linear", "benzeggagh_kenane"}, "softening law of the cohesive elements"),
      choice("calibration", slot<&C::cohesive, &C::Cohesive::calibration>(), {"y_geo", "exact"}, "of the softening length: 3G/f, or so that G is dissipated"),
      choice("insertion", slot<&C::cohesive, &C::Cohesive::insertion>(), {"all", "on_demand", "none"}, "which edges carry a cohesive element; none: the rock breaks by smeared damage"),
      number("threshold", slot<&C::cohesive, &C::Cohesive::threshold>(), plain, fraction, Need::never, "share of its strength at which an edge gets its element on demand"),
      choice("compliance", slot<&C::cohesive, &C::Cohesive::compliance>(), {"kept", "compensated"}, "of the elements on all edges: kept, or made up for by stiffer triangles"),
      number("mixed_mode_exponent", slot<&C::cohesive, &C::Cohesive::mixed_mode_exponent>(), plain, positive, Need::never, "of benzeggagh_kenane: fracture energy rises from mode 1 to mode 2 by the share of sliding to this power; with 4 a path that zigzags through the mesh dissipates 5 % more per area than a straight one, with 2 some 30 %"),
      number("penalty", slot<&C::cohesive, &C::Cohesive::penalty>(), pressure, not_negative, Need::never, "stiffness times edge length before softening", "20 rock.young_modulus"),
    }},
    {"damage", {
      choice("law", slot<&C::damage, &C::Damage::law>(), {"linear", "exponential", "cubic_step"}, "softening law of damaged triangles"),
      choice("preset", slot<&C::damage, &C::Damage::preset>(), {"recommended", "faithful"}, "one damage and no stress in open failed triangles; or ADaM as published, which locks where cracks cannot run straight"),
      choice("initiation", slot<&C::damage, &C::Damage::initiation>(), {"mohr_coulomb", "principal", "shear", "box", "ellipse"}, "where triangles crack", "mohr_coulomb; of \"faithful\": box"),
    }},
    {"contact", {
      number("normal_penalty", slot<&C::contact, &C::Contact::normal_penalty>(), pressure, not_negative, Need::never, "against overlap of broken faces", "cohesive.penalty"),
      number("tangential_penalty", slot<&C::contact, &C::Contact::tangential_penalty>(), pressure, not_negative, Need::never, "of broken faces that stick", "cohesive.penalty"),
      number("friction_angle", slot<&C::contact, &C::Contact::friction_angle>(), angle, friction, Need::never, "residual friction angle of broken faces", "rock.friction_angle"),
    }},
    rows_of<&C::joints>("joints", with({
      number("x1", slot<&C::joints, &C::Joint::x1>(), length, any, Need::always, "one end of the joint"),
      number("y1", slot<&C::joints, &C::Joint::y1>(), length, any, Need::always, "one end of the joint"),
      number("x2", slot<&C::joints, &C::Joint::x2>(), length, any, Need::always, "the other end"),
      number("y2", slot<&C::joints, &C::Joint::y2>(), length, any, Need::always, "the other end"),
    }, joint_properties<&C::joints>())),
    rows_of<&C::joint_sets>("joint_sets", with({
      named("name", of_set<&JS::name>(), "of the set; with mesh.file the name of its joints there", "set1, set2, ...; with mesh.file: all others"),
      text("file", of_set<&JS::file>(), "a CSV file of joints (columns x1_m, y1_m, x2_m, y2_m), relative to the file that names it, instead of density", "none"),
      number("density", of_set<&JS::density>(), per_area, positive, Need::never, "joints per area, of a random set", "none"),
      choice("length_distribution", of_set<&JS::length_distribution>(), {"constant", "normal", "lognormal", "power_law"}, "of the lengths", "constant"),
      number("length_mean", of_set<&JS::length_mean>(), length, positive, Need::never, "mean length; but for power_law", "none"),
      number("length_deviation", of_set<&JS::length_deviation>(), length, positive, Need::never, "standard deviation; normal and lognormal", "none"),
      number("length_exponent", of_set<&JS::length_exponent>(), plain, not_negative, Need::never, "a of power_law: lengths l are as frequent as l^-a", "none"),
      number("length_min", of_set<&JS::length_min>(), length, positive, Need::never, "shorter ones are drawn again", "none; power_law needs it"),
      number("length_max", of_set<&JS::length_max>(), length, positive, Need::never, "longer ones are drawn again", "none; power_law needs it"),
      choice("orientation", of_set<&JS::orientation>(), {"uniform", "von_mises", "constant"}, "distribution of directions", "uniform"),
      number("angle", of_set<&JS::angle>(), angle, any, Need::never, "mean direction, from the x axis; constant and von_mises", "none"),
      number("concentration", of_set<&JS::concentration>(), plain, concentrated, Need::never, "kappa of von_mises, about the doubled angle", "none"),
      number("region_radius", of_set<&JS::region_radius>(), length, positive, Need::never, "middles lie within it of the origin, instead of a rectangle", "none"),
      number("region_x_min", of_set<&JS::region_x_min>(), length, any, Need::never, "left side of the rectangle in which middles lie", "the domain's"),
      number("region_x_max", of_set<&JS::region_x_max>(), length, any, Need::never, "right side", "the domain's"),
      number("region_y_min", of_set<&JS::region_y_min>(), length, any, Need::never, "lower side", "the domain's"),
      number("region_y_max", of_set<&JS::region_y_max>(), length, any, Need::never, "upper side", "the domain's"),
      number("clear_distance", of_set<&JS::clear_distance>(), length, not_negative, Need::never, "joints that come nearer to the wellbore's wall are left out", "none"),
      count("seed", of_set<&JS::seed>(), "of the random numbers of the set", "1, 2, ... by row"),
    }, joint_properties<&C::joint_sets>())),
    {"damping", {
      number("viscosity", slot<&C::damping, &C::Damping::viscosity>(), viscosity, not_negative, Need::never, "viscous stress over strain rate, instead of ratio", "none"),
      number("ratio", slot<&C::damping, &C::Damping::ratio>(), plain, not_negative, Need::never, "of the critical viscosity 2 h sqrt(E rho), instead of viscosity", "0.1"),
    }},
    {"boundary", {
      choice("outer", slot<&C::boundary, &C::Boundary::outer>(), {"fixed", "absorbing", "free"}, "what the outer boundary does where it has no load; free: it moves, under the in-situ stress as a constant load"),
    }},
    rows_of<&C::loads>("loads", {
      named("name", slot<&C::loads, &C::Load::name>(), "in the columns of history.csv", "its side"),
      choice("side", slot<&C::loads, &C::Load::side>(), {"left", "right", "bottom", "top"}, "of the domain, on which it acts", "needed"),
      number("from", slot<&C::loads, &C::Load::from>(), length, any, Need::never, "where it begins along the side (x, or y on left and right); the same as to: one point", "the side's end"),
      number("to", slot<&C::loads, &C::Load::to>(), length, any, Need::never, "where it ends", "the side's end"),
      choice("support", slot<&C::loads, &C::Load::support>(), {"roller", "fixed"}, "roller: held across the side, free along it; fixed: held in x and y", "none"),
      number("traction_x", slot<&C::loads, &C::Load::traction_x>(), pressure, any, Need::never, "force per area in x, that does not turn with the side", "none"),
      number("traction_y", slot<&C::loads, &C::Load::traction_y>(), pressure, any, Need::never, "force per area in y", "none"),
      number("velocity_x", slot<&C::loads, &C::Load::velocity_x>(), speed, any, Need::never, "given velocity in x; 0 holds it", "none"),
      number("velocity_y", slot<&C::loads, &C::Load::velocity_y>(), speed, any, Need::never, "given velocity in y; 0 holds it", "none"),
      number("displacement_x", slot<&C::loads, &C::Load::displacement_x>(), length, any, Need::never, "displacement in x at the end of the ramp, held from then on", "none"),
      number("displacement_y", slot<&C::loads, &C::Load::displacement_y>(), length, any, Need::never, "displacement in y at the end of the ramp", "none"),
      choice("contact", slot<&C::loads, &C::Load::contact>(), {"bonded", "one_sided"}, "one_sided: a support or given motion across the side pushes the body and never pulls it, as a striker does"),
      number("ramp", slot<&C::loads, &C::Load::ramp>(), duration, not_negative, Need::never, "time over which it grows smoothly from nothing; 0: at once"),
    }),
    {"stress", {
      number("xx", slot<&C::stress, &Sym2::xx>(), pressure, any, Need::never, "far-field effective stress, tension positive"),
      number("yy", slot<&C::stress, &Sym2::yy>(), pressure, any, Need::never, "far-field effective stress, tension positive"),
      number("xy", slot<&C::stress, &Sym2::xy>(), pressure, any, Need::never, "far-field shear stress"),
      number("gradient_xx", slot<&C::stress_gradient, &Sym2::xx>(), pressure_gradient, any, Need::never, "change of xx per metre of depth (-y); negative: compression grows downwards"),
      number("gradient_yy", slot<&C::stress_gradient, &Sym2::yy>(), pressure_gradient, any, Need::never, "change of yy per metre of depth; the rock gets the weight per volume that bears it"),
    }},
    {"fluid", {
      number("bulk_modulus", slot<&C::fluid, &C::Fluid::bulk_modulus>(), pressure, stiffness, Need::never, "bulk modulus of the fluid"),
      number("density", slot<&C::fluid, &C::Fluid::density>(), density, positive, Need::never, "mass density of the fluid at the initial pressure"),
      number("initial_pressure", slot<&C::fluid, &C::Fluid::initial_pressure>(), pressure, any, Need::never, "of the fluid before pumping", "rock.pore_pressure"),
      choice("wets", slot<&C::fluid, &C::Fluid::wets>(), {"auto", "broken", "damaged", "tip"}, "which cohesive elements and damaged triangles the fluid enters, next to where it is: broken ones, or already those that have begun to open, or (in field time) those and with its pressure alone the edge ahead of them; \"auto\": broken in steps, tip in field time"),
      number("viscosity", slot<&C::fluid, &C::Fluid::viscosity>(), viscosity, not_negative, Need::never, "along the fracture, for fluid.flow"),
      number("cavitation_pressure", slot<&C::fluid, &C::Fluid::cavitation_pressure>(), pressure, any, Need::never, "below it the fluid boils; in steps, the pressure of what is not full", "0, or 5 MPa below rock.pore_pressure where that is small; in steps rock.pore_pressure"),
      choice("flow", slot<&C::fluid, &C::Fluid::flow>(), {"auto", "uniform", "viscous", "turbulent"}, "one pressure all along the fracture, or falling by the fluid's viscosity, laminar or with turbulent friction; \"auto\": uniform in steps, and without a viscosity"),
      choice("leak_off", slot<&C::fluid, &C::Fluid::leak_off>(), {"auto", "none", "carter", "diffusion"}, "into the rock, in the quasi-static regime; \"auto\": by the volume that would leak off"),
      number("leak_off_coefficient", slot<&C::fluid, &C::Fluid::leak_off_coefficient>(), plain, not_negative, Need::never, "C_L in m/s^0.5, for fluid.leak_off = \"carter\""),
      choice("joints", slot<&C::fluid, &C::Fluid::joints>(), {"whole", "edge"}, "a joint without cohesion that is reached is entered as a whole at once, or edge by edge as it opens"),
    }},
    rows_of<&C::fluid, &C::Fluid::pump>("fluid.pump", {
      number("from", slot<&C::fluid, &C::Fluid::pump, &C::PumpStage::from>(), duration, not_negative, Need::never, "start of the stage"),
      number("to", slot<&C::fluid, &C::Fluid::pump, &C::PumpStage::to>(), duration, positive, Need::never, "end of the stage", "run.end_time"),
      number("rate", slot<&C::fluid, &C::Fluid::pump, &C::PumpStage::rate>(), rate, not_negative, Need::always, "injection rate per metre of thickness"),
    }),
    {"well", {
      number("height", slot<&C::well, &C::Well::height>(), length, positive, Need::never, "of the fracture: rates, storage and friction are shared by it, in the quasi-static regime"),
      number("storage", slot<&C::well, &C::Well::storage>(), storage, not_negative, Need::never, "volume of the well times compressibility, without that of a wellbore in the mesh"),
      number("impedance", slot<&C::well, &C::Well::impedance>(), impedance, not_negative, Need::never, "density times sound speed over cross section: bounds the rate at breakdown"),
      number("impedance_time", slot<&C::well, &C::Well::impedance_time>(), duration, not_negative, Need::never, "for which it acts after breakdown, 2 L/c"),
      number("perforation_friction", slot<&C::well, &C::Well::perforation_friction>(), friction_of_rate, not_negative, Need::never, "pressure lost per rate squared"),
      number("tortuosity", slot<&C::well, &C::Well::tortuosity>(), plain, not_negative, Need::never, "pressure lost per root of the rate, in Pa (s/m3)^0.5"),
      number("breakdown_pressure", slot<&C::well, &C::Well::breakdown_pressure>(), pressure, any, Need::never, "the fracture is shut off from the well until it is reached", "none: open from the start"),
    }},
    {"fracture", {
      number("notch", slot<&C::fracture, &C::Fracture::notch>(), length, not_negative, Need::never, "half-length broken at first, with fluid in it, from the origin; 0: none; with mesh.file the length of its curve \"joint_notch\""),
      number("angle", slot<&C::fracture, &C::Fracture::angle>(), angle, any, Need::never, "from x to the notch, anticlockwise"),
      number("offset", slot<&C::fracture, &C::Fracture::offset>(), length, any, Need::never, "of the notch's middle from the origin, along it: the well is in the origin, so that wings differ"),
      choice("path", slot<&C::fracture, &C::Fracture::path>(), {"auto", "straight", "free"}, "in the quasi-static regime: \"straight\", along x, on half of the domain without a wellbore; \"free\", edges chosen by the stress at the tips, joints met; \"auto\": straight where the case is symmetric to both axes"),
      number("residual_aperture", slot<&C::fracture, &C::Fracture::residual_aperture>(), length, positive, Need::never, "opening of closed faces without effective stress"),
      number("closure_stress", slot<&C::fracture, &C::Fracture::closure_stress>(), pressure, positive, Need::never, "effective stress that closes it to a tenth"),
    }},
    rows_of<&C::notches>("notches", {
      number("x1", slot<&C::notches, &C::Notch::x1>(), length, any, Need::always, "one end of the slit, cut before the run; on the boundary for an edge notch"),
      number("y1", slot<&C::notches, &C::Notch::y1>(), length, any, Need::always, "one end"),
      number("x2", slot<&C::notches, &C::Notch::x2>(), length, any, Need::always, "the other end"),
      number("y2", slot<&C::notches, &C::Notch::y2>(), length, any, Need::always, "the other end"),
      choice("fluid", slot<&C::notches, &C::Notch::fluid>(), {"pumped", "none"}, "whether the pumped fluid is in it", "pumped where there is a pump"),
    }),
    {"run", {
      choice("regime", slot<&C::run, &C::Run::regime>(), {"auto", "dynamic", "quasi_static"}, "milliseconds by explicit steps, field time by implicit ones, or chosen by the numbers"),
      number("end_time", slot<&C::run, &C::Run::end_time>(), duration, positive, Need::always, "simulated time at the end"),
      number("time_step", slot<&C::run, &C::Run::time_step>(), duration, positive, Need::never, "\"auto\": the stable one times safety", {}, "auto"),
      text("fast_forward", slot<&C::run, &C::Run::fast_forward>(), "true: the elastic ramp before the first edge nears its strength by static solves, where that holds"),
      text("hand_over", slot<&C::run, &C::Run::hand_over>(), "true: in field time, where a fracture snaps and no equilibrium is near, to explicit steps with inertia, and back once it has stopped; false: the run ends there"),
      number("safety", slot<&C::run, &C::Run::safety>(), plain, fraction, Need::never, "share of the stable time step that \"auto\" takes"),
    }},
    {"seismic", {
      number("thickness", slot<&C::seismic, &C::Seismic::thickness>(), length, positive, Need::never, "out of plane, for the energy of events"),
      number("slip_rate", slot<&C::seismic, &C::Seismic::slip_rate>(), speed, positive, Need::never, "at which the slip of a joint is an event"),
    }},
    {"seismic.reference", {
      number("longitude", slot<&C::seismic, &C::Seismic::longitude>(), degrees, east, Need::never, "of the origin, east positive"),
      number("latitude", slot<&C::seismic, &C::Seismic::latitude>(), degrees, north, Need::never, "of the origin, north positive"),
      number("depth", slot<&C::seismic, &C::Seismic::depth>(), length, any, Need::never, "of the origin, down positive"),
      choice("depth_axis", slot<&C::seismic, &C::Seismic::depth_axis>(), {"out_of_plane", "y"}, "along which depth changes: the section is level (y north), or upright (y up)"),
      moment("epoch", slot<&C::seismic, &C::Seismic::epoch>(), "of simulated time zero, ISO 8601 in UTC"),
    }},
    {"output", {
      number("fields_every", slot<&C::output, &C::Output::fields_every>(), duration, not_negative, Need::never, "simulated time between frames; in field time there is one more at every shut-in", "run.end_time / 20"),
      text("fields", slot<&C::output, &C::Output::fields>(), "names of the fields to write; none: the default set", "none"),
      number("history_every", slot<&C::output, &C::Output::history_every>(), duration, not_negative, Need::never, "simulated time between rows of history.csv", "run.end_time / 1000"),
      number("checkpoint_every", slot<&C::output, &C::Output::checkpoint_every>(), duration, not_negative, Need::never, "wall-clock time between checkpoints; 0: only on a signal"),
      number("max_bytes", slot<&C::output, &C::Output::max_bytes>(), plain, not_negative, Need::never, "a run that would write more is refused; 0: no limit"),
    }},
  };
  // clang-format on
}

}  // namespace

const std::vector<TableSpec>& case_tables() {
  static const std::vector<TableSpec> tables = make_tables();
  return tables;
}

const TableSpec* find_table(std::string_view name) {
  const auto at = std::ranges::find(case_tables(), name, &TableSpec::name);
  return at == case_tables().end() ? nullptr : &*at;
}

const KeySpec* find_key(const TableSpec& table, std::string_view key) {
  const auto at = std::ranges::find(table.keys, key, &KeySpec::key);
  return at == table.keys.end() ? nullptr : &*at;
}

std::string join_path(std::string_view table, std::string_view key) {
  return table.empty() ? std::string(key) : std::string(table) + "." + std::string(key);
}

bool is_needed(const KeySpec& key, const Case& scene) {
  switch (key.need) {
    case Need::never:
      return false;
    case Need::always:
      return true;
    case Need::without_mesh_file:
      return scene.mesh.file.empty();
    case Need::with_pump:
      return scene.mesh.file.empty() && !scene.fluid.pump.empty() && scene.fracture.notch <= 0.0 &&
             scene.notches.empty();
  }
  return false;
}

}  // namespace crackle
