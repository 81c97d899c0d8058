// SPDX-License-Identifier: GPL-3.0-or-later
//
// `crackle law`: the traction-separation curve of a cohesive law, by driving one point of an edge.
#include "crackle/cohesive/law.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "commands.hpp"
#include "crackle/core/errors.hpp"
#include "load.hpp"
#include "scene.hpp"

namespace crackle {
namespace {

// Granite of AbuAisha et al. (2016), Table 1, under which laws are shown unless told otherwise.
constexpr const char* granite = R"(
[domain]
width = "1 m"
height = "1 m"
[mesh]
size_fine = "3 mm"
fine_radius = "0 m"
size_coarse = "3 mm"
[rock]
density = "2500 kg/m3"
young_modulus = "35 GPa"
poisson_ratio = 0.27
tensile_strength = "3 MPa"
cohesion = "24 MPa"
friction_angle = "38 deg"
fracture_energy_mode1 = "5 J/m2"
fracture_energy_mode2 = "80 J/m2"
[cohesive]
calibration = "y_geo"
penalty = "120 GPa"
[run]
end_time = "1 ms"
)";

/// A straight way from a start: opening = opening0 + distance cos, slip = distance sin.
struct Way {
  double opening0 = 0.0;  ///< [m]
  double along_opening = 1.0, along_slip = 0.0;
};

/// One point of an edge that moves along a way, with the work done on it.
class Drive {
 public:
  Drive(const CohesiveLaw& law, const CohesiveMaterial& material, double length, const Way& way)
      : law_(law), material_(material), length_(length), way_(way) {
    law_.move(material_, length_, way_.opening0, 0.0, point_);
    stored_at_start_ = point_.stored;
  }
  void to(double distance) {
    const CohesivePoint before = point_;
    law_.move(material_, length_, way_.opening0 + distance * way_.along_opening, distance * way_.along_slip,
              point_);
    work_ +=
        0.5 * (before.normal + point_.normal) * (point_.opening - before.opening) +
        0.5 * (before.shear + before.friction + point_.shear + point_.friction) * (point_.slip - before.slip);
  }
  const CohesivePoint& point() const { return point_; }
  double dissipated() const { return work_ + stored_at_start_ - point_.stored; }

 private:
  const CohesiveLaw& law_;
  const CohesiveMaterial& material_;
  double length_;
  Way way_;
  CohesivePoint point_;
  double work_ = 0.0, stored_at_start_ = 0.0;  // [J/m2]
};

/// Distance [m] at which the edge is broken.
double breaking_distance(const CohesiveLaw& law, const CohesiveMaterial& material, double length,
                         const Way& way) {
  const auto broken = [&](double distance) {
    Drive drive(law, material, length, way);
    drive.to(distance);
    return drive.point().damage >= 1.0;
  };
  double low = 0.0, high = 1e-9;
  while (!broken(high)) {
    low = high;
    high *= 2.0;
    if (high > 1e3) throw CaseError("--mode: this edge does not break, however far it is moved");
  }
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (low + high);
    (broken(middle) ? high : low) = middle;
  }
  return high;
}

Way way_of(const LawOptions& options, const CohesiveLaw& law, const CohesiveMaterial& material,
           double length) {
  const double normal = quantity("--normal", options.normal, "Pa");
  if (options.mode != "2" && normal != 0.0)
    throw CaseError("--normal: a stress across the edge is for --mode 2 only");
  if (options.mode == "1") return {};
  if (options.mode == "2") {
    if (normal > 0.0)
      throw CaseError(
          fmt::format("--normal: {} pulls the edge open; compression is negative", options.normal));
    return {law.elastic_opening(material, length, normal), 0.0, 1.0};
  }
  const double angle = quantity("--angle", options.angle, "rad");
  constexpr double right_angle = 0.5 * std::numbers::pi;
  if (angle < 0.0 || angle > right_angle * (1.0 + 1e-9)) {  // "90 deg" is converted, and rounded

    throw CaseError(fmt::format("--angle: {} is not from 0 (opening) to 90 deg (sliding)", options.angle));
  }
  return {0.0, std::max(0.0, std::cos(angle)), std::sin(angle)};
}

}  // namespace

int law_command(const LawOptions& options) {
  const auto law = find_law(options.law);
  if (!law) throw unknown_name("cohesive law", options.law, registered_names().more["cohesive.law"]);
  std::vector<std::string> overrides = options.overrides;
  overrides.push_back("cohesive.law=" + options.law);
  const Case scene = options.case_file.empty() ? parse_case(granite, "granite", overrides, registered_names())
                                               : load_case(options.case_file, overrides, {});
  const CohesiveMaterial material = make_scene(scene, nullptr).cohesive;
  const double length = quantity("--edge", options.edge, "m");
  if (length <= 0.0) throw CaseError(fmt::format("--edge: {} is no length of an edge", options.edge));
  if (length > law->longest_edge(material)) {
    throw CaseError(
        fmt::format("--edge: {} is above {:.3g} m, the longest edge that calibration \"exact\" can serve at "
                    "this penalty; write a shorter one, or --set cohesive.calibration=y_geo",
                    options.edge, law->longest_edge(material)));
  }
  const Way way = way_of(options, *law, material, length);
  const double end = breaking_distance(*law, material, length, way);

  // Rows to just beyond breaking, with enough steps between them that work is summed to 1e-6.
  constexpr int steps_between = 200;
  const double last = 1.05 * end;
  Drive drive(*law, material, length, way);
  double peak_normal = 0.0, peak_shear = 0.0;
  fmt::print("opening_m,slip_m,normal_Pa,shear_Pa,damage,dissipated_J_m2\n");
  for (int row = 0; row < options.points; ++row) {
    if (row > 0) {
      for (int i = 1; i <= steps_between; ++i) {
        drive.to(last * (row - 1 + static_cast<double>(i) / steps_between) / (options.points - 1));
        peak_normal = std::max(peak_normal, drive.point().normal);
        peak_shear = std::max(peak_shear, drive.point().shear + drive.point().friction);
      }
    }
    const CohesivePoint& p = drive.point();
    const double damage = p.damage < 1e-300 ? 0.0 : p.damage;  // the law marks a point at its peak so
    fmt::print("{:.9g},{:.9g},{:.9g},{:.9g},{:.9g},{:.9g}\n", p.opening, p.slip, p.normal,
               p.shear + p.friction, damage, std::max(0.0, drive.dissipated()));
  }
  const bool exact = material.calibration == Calibration::exact;
  fmt::print(stderr, "{}, calibration {}, edge {:.4g} m: ", law->name(), exact ? "exact" : "y_geo", length);
  if (options.mode != "2") fmt::print(stderr, "tensile peak {:.4g} MPa, ", 1e-6 * peak_normal);
  if (options.mode != "1") fmt::print(stderr, "shear peak {:.4g} MPa, ", 1e-6 * peak_shear);
  fmt::print(stderr, "broken after {:.4g} um, {:.5g} J/m2 dissipated{}\n", 1e6 * end, drive.dissipated(),
             options.mode == "2" && way.opening0 < 0.0 ? " (with friction)" : "");
  return 0;
}

}  // namespace crackle
