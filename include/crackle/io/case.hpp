// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "crackle/core/vec2.hpp"

namespace crackle {

/// Everything a case file says, defaults filled in, in SI units. One struct a table of the file;
/// the member names are the file's keys. Angles are in radians here, degrees or radians in the
/// file ("38 deg", "0.66 rad"; a bare number is radians, the SI unit).
struct Case {
  std::string title;
  std::string file;  ///< path the case was read from

  struct Domain {
    double width = 0.0;   ///< extent in x [m], centred on the origin
    double height = 0.0;  ///< extent in y [m]
  } domain;

  struct Wellbore {
    double diameter = 0.0;  ///< [m]; 0: no wellbore
    int segments = 0;       ///< edges round the wellbore; 0: from mesh.size_fine
  } wellbore;

  struct Mesh {
    std::string generator = "cgal";  ///< "cgal" or "gmsh"
    double size_fine = 0.0;          ///< [m]
    double fine_radius = 0.0;        ///< [m]
    double size_coarse = 0.0;        ///< [m]
    std::uint64_t seed = 1;
    std::string file;  ///< a .msh file instead of a generator; made absolute when read
  } mesh;

  /// How joints bear. "frictional": closed, without cohesion or tensile strength; slides at
  /// residual_friction_angle. "bonded": breaks like rock, by values of its own, which it then has to have.
  struct JointProperties {
    std::string law = "frictional";
    std::optional<double> residual_friction_angle;  ///< [rad]; default: contact.friction_angle
    std::optional<double> normal_penalty;           ///< [Pa]; default: cohesive.penalty
    std::optional<double> tangential_penalty;       ///< [Pa]; default: contact.tangential_penalty
    std::optional<double> tensile_strength;         ///< [Pa]; this and the following: bonded only
    std::optional<double> cohesion;                 ///< [Pa]
    std::optional<double> friction_angle;           ///< internal [rad]
    std::optional<double> fracture_energy_mode1;    ///< [J/m2]
    std::optional<double> fracture_energy_mode2;    ///< [J/m2]
  };
  struct Joint : JointProperties {
    double x1 = 0.0, y1 = 0.0;  ///< one end [m]
    double x2 = 0.0, y2 = 0.0;  ///< the other [m]
  };
  std::vector<Joint> joints;

  /// Joints that share their properties: random ones (density and what follows), those of a CSV file, or
  /// those of that name in mesh.file.
  struct JointSet : JointProperties {
    std::string name;                        ///< default: "set1", "set2" ...; with mesh.file: all others
    std::string file;                        ///< columns x1_m, y1_m, x2_m, y2_m; made absolute when read
    std::optional<double> density;           ///< middles of joints per area [1/m2]
    std::string length_distribution;         ///< "constant" (default), "normal", "lognormal", "power_law"
    std::optional<double> length_mean;       ///< [m]; but for power_law
    std::optional<double> length_deviation;  ///< standard deviation [m]; normal and lognormal
    std::optional<double> length_exponent;   ///< f(l) ~ l^-exponent; power_law
    std::optional<double> length_min;        ///< [m]
    std::optional<double> length_max;        ///< [m]
    std::string orientation;                 ///< "uniform" (default), "von_mises", "constant"
    std::optional<double> angle;             ///< from the x axis, counter-clockwise [rad]; but for uniform
    std::optional<double> concentration;     ///< kappa of von_mises [-]
    std::optional<double> region_radius;     ///< middles lie in a circle round the origin [m], or in:
    std::optional<double> region_x_min, region_x_max, region_y_min,
        region_y_max;                      ///< default: the domain [m]
    std::optional<double> clear_distance;  ///< from the wellbore's wall that no joint enters [m]
    std::optional<std::uint64_t> seed;     ///< default: 1, 2 ... by row
  };
  std::vector<JointSet> joint_sets;

  struct Rock {
    double density = 0.0;                ///< [kg/m3]
    double young_modulus = 0.0;          ///< [Pa]
    double poisson_ratio = 0.0;          ///< [-]
    double tensile_strength = 0.0;       ///< [Pa]
    double cohesion = 0.0;               ///< [Pa]
    double friction_angle = 0.0;         ///< internal friction angle [rad]
    double fracture_energy_mode1 = 0.0;  ///< [J/m2]
    double fracture_energy_mode2 = 0.0;  ///< [J/m2]
    double pore_pressure = 0.0;          ///< of the formation [Pa]; fluid pressures are on the same footing
    double permeability = 0.0;           ///< [m2]
    double porosity = 0.0;               ///< [-]
    double pore_compressibility = 0.0;   ///< of pores and what fills them [1/Pa]
    double pore_viscosity = 0.0;         ///< of the fluid in the pores [Pa s]
    // Bedded rock (transversely isotropic): the moduli above are those along the bedding.
    std::optional<double> young_modulus_normal = {};  ///< across the bedding [Pa]; none: not bedded
    std::optional<double> poisson_ratio_normal = {};  ///< strain along it under stress across it [-]
    std::optional<double> shear_modulus_normal = {};  ///< across it [Pa]
    double bedding_angle = 0.0;                       ///< from x to the bedding, anticlockwise [rad]
    // Of planes along the bedding; the values above are those of planes across it.
    std::optional<double> tensile_strength_bedding = {};       ///< [Pa]; none: the same
    std::optional<double> cohesion_bedding = {};               ///< [Pa]
    std::optional<double> fracture_energy_mode1_bedding = {};  ///< [J/m2]
    std::optional<double> fracture_energy_mode2_bedding = {};  ///< [J/m2]
    double bedding_exponent = 1.0;                             ///< m of bedding.hpp [-]
  } rock;

  /// A band of another rock between two parallel interfaces; what is in no layer is `rock`. All but the first
  /// three is the rock's where it is not given.
  struct Layer {
    std::optional<double> bottom;  ///< its lower interface: distance from the origin along its normal [m]
    std::optional<double> top;     ///< the upper one; none: it goes on to the outer boundary
    double dip = 0.0;              ///< of the interfaces, from x anticlockwise [rad]
    Rock rock;                     ///< but for what is of pores
    double penalty = 0.0;  ///< of its cohesive elements [Pa]; 0: cohesive.penalty, or 20 Young's moduli
    Sym2 stress, stress_gradient;  ///< in situ, as in [stress]
    struct Interface : JointProperties {
      Interface() { law = "perfect"; }  ///< no joint; else "bonded" or "frictional"
    } interface;
  };
  std::vector<Layer> layers;

  struct Cohesive {
    std::string preset = "accurate";        ///< defaults of the next three: "accurate" as here, or "y_geo"
    std::string law = "benzeggagh_kenane";  ///< a registered law; y_geo: "evans_marathe"
    std::string calibration = "exact";      ///< "exact" (dissipates G) or "y_geo" (softening length 3G/f)
    std::string insertion = "on_demand";  ///< "on_demand", "all" edges from the start, or "none": see damage
    double threshold = 0.7;               ///< of its strength, where an edge gets its element on demand [-]
    std::string compliance = "kept";      ///< of the elements: "kept", or "compensated" by stiffer triangles
    double mixed_mode_exponent = 4.0;     ///< of benzeggagh_kenane: how late sliding costs more [-]
    double penalty = 0.0;                 ///< stiffness times edge length [Pa]; 0: 20 Young's moduli
  } cohesive;

  /// Smeared damage, where cohesive.insertion is "none".
  struct Damage {
    std::string law = "linear";          ///< a registered softening law
    std::string preset = "recommended";  ///< or "faithful"
    std::string initiation;              ///< default: the preset's
  } damage;

  struct Contact {
    double normal_penalty = 0.0;      ///< [Pa]; 0: as the cohesive penalty
    double tangential_penalty = 0.0;  ///< [Pa]; 0: as the cohesive penalty
    double friction_angle = 0.0;      ///< residual friction of broken faces [rad]; default: the rock's
  } contact;

  struct Damping {
    std::optional<double> viscosity;  ///< viscous stress over strain rate [Pa s]
    std::optional<double> ratio;      ///< of the critical viscosity 2 h sqrt(E rho) [-]; default 0.1
  } damping;

  struct Boundary {
    std::string outer = "fixed";  ///< "fixed", "absorbing" or "free"
  } boundary;

  /// A load or support on a side of the domain, or a part of it. A component has at most one of traction,
  /// velocity and displacement; one that has none is free.
  struct Load {
    std::string name;                ///< in history.csv; default: its side
    std::string side;                ///< "left", "right", "bottom" or "top"
    std::optional<double> from, to;  ///< along the side [m]; default: its ends
    std::string support;             ///< "roller": held across the side, "fixed": in both, or none
    std::optional<double> traction_x, traction_y;          ///< [Pa]
    std::optional<double> velocity_x, velocity_y;          ///< [m/s]
    std::optional<double> displacement_x, displacement_y;  ///< [m]
    double ramp = 0.0;                                     ///< time over which it grows from nothing [s]
    std::string contact = "bonded";  ///< or "one_sided": across the side it pushes, and never pulls
  };
  std::vector<Load> loads;

  Sym2 stress;           ///< far-field effective stress [Pa], tension positive: [stress] xx, yy, xy
  Sym2 stress_gradient;  ///< its change per metre of depth (−y) [Pa/m]: [stress] gradient_xx, gradient_yy

  struct PumpStage {
    double from = 0.0;  ///< [s]
    double to = 0.0;    ///< [s]
    double rate = 0.0;  ///< injection rate per metre of thickness [m2/s]
  };
  struct Fluid {
    double bulk_modulus = 2.2e9;    ///< [Pa]
    double density = 1000.0;        ///< at initial pressure [kg/m3]
    double initial_pressure = 0.0;  ///< [Pa]
    /// Which elements and triangles the fluid enters: "broken", "damaged", in field time "tip"; "auto"
    std::string wets = "auto";
    double viscosity = 0.0;                     ///< in the quasi-static regime [Pa s]
    std::optional<double> cavitation_pressure;  ///< [Pa]
    std::string flow = "auto";          ///< in the quasi-static regime "uniform", "viscous", "turbulent"
    std::string leak_off = "auto";      ///< "none", "carter", "diffusion", or by the numbers
    double leak_off_coefficient = 0.0;  ///< Carter's [m/s^0.5]
    std::string joints = "whole";       ///< which part of a joint that it reaches: "whole" or "edge"
    std::vector<PumpStage> pump;  ///< sorted by time, not overlapping; a stage without end ends with the run
  } fluid;

  /// A well in field time; the fracture is as high as `height`.
  struct Well {
    double height = 1.0;                       ///< of the fracture [m]; rates are divided by it
    double storage = 0.0;                      ///< [m3/Pa]
    double impedance = 0.0;                    ///< acoustic, ρ c / A [Pa s/m3]
    double impedance_time = 0.0;               ///< after breakdown, 2 L / c [s]
    double perforation_friction = 0.0;         ///< [Pa s2/m6]
    double tortuosity = 0.0;                   ///< [Pa (s/m3)^0.5]
    std::optional<double> breakdown_pressure;  ///< the fracture is shut off below it [Pa]
  } well;

  /// The fracture that a run starts from, a straight line through the origin, and how the fracture of a
  /// quasi-static run goes and closes.
  struct Fracture {
    double notch = 0.0;               ///< broken half-length at first, with fluid in it [m]; 0: none
    double angle = 0.0;               ///< from x to the notch, anticlockwise [rad]
    double offset = 0.0;              ///< of its middle from the origin (the well), along it [m]
    std::string path = "auto";        ///< of a quasi-static run: "straight", "free", or "auto"
    double residual_aperture = 1e-4;  ///< of mated faces without effective stress [m]
    double closure_stress = 30e6;     ///< that leaves a tenth of it [Pa]
  } fracture;

  /// A straight slit, cut before the run; its faces touch, and bear compression and friction.
  struct Notch {
    double x1 = 0.0, y1 = 0.0;  ///< one end [m]
    double x2 = 0.0, y2 = 0.0;  ///< the other [m]
    std::string fluid;  ///< "pumped": holds the fluid, "none": dry; default: pumped where there is a pump
  };
  std::vector<Notch> notches;

  struct Run {
    std::string regime = "auto";  ///< "auto", "dynamic" or "quasi_static"
    double end_time = 0.0;        ///< [s]
    double time_step = 0.0;       ///< [s]; 0: "auto"
    bool fast_forward = true;     ///< the elastic ramp by static solves, where it holds
    bool hand_over = true;        ///< in field time, to explicit steps where a fracture snaps, and back
    double safety = 0.8;          ///< fraction of the stable time step taken by "auto" [-]
  } run;

  /// Where the local coordinates lie on Earth, for the seismic catalog. x points east. With depth_axis
  /// "out_of_plane" the section is level at `depth` and y points north; with "y" it is upright, y points
  /// up, and depth = `depth` - y.
  struct Seismic {
    double longitude = 0.0;                      ///< of the origin [degree]
    double latitude = 0.0;                       ///< of the origin [degree]
    double depth = 0.0;                          ///< of the origin [m], positive down
    std::string depth_axis = "out_of_plane";     ///< or "y"
    std::string epoch = "2000-01-01T00:00:00Z";  ///< of simulated time zero, ISO 8601 UTC
    double thickness = 1.0;                      ///< out of plane, turns J/m into J for magnitudes [m]
    double slip_rate = 0.01;                     ///< at which the slip of a joint is an event [m/s]
  } seismic;

  struct Output {
    double fields_every = 0.0;        ///< simulated time between field frames [s]; 0: end_time / 20
    std::vector<std::string> fields;  ///< names of fields written; empty: the default set
    double history_every = 0.0;       ///< [s]; 0: end_time / 1000
    double checkpoint_every = 600.0;  ///< wall-clock time between checkpoints [s]; 0: only on a signal
    double max_bytes = 0.0;           ///< a run that would write more is refused [bytes]; 0: no limit
  } output;
};

/// Names that a key takes beside its built-in ones, by "table.key": {"cohesive.law", {"my_law"}} for
/// laws that are registered elsewhere.
struct CaseNames {
  std::map<std::string, std::vector<std::string>> more;
};

/// Reads and checks a case file (with its includes). Defaults that follow from other keys are filled
/// in, so that no 0 stands for "as something else" (but wellbore.segments and run.time_step).
/// @param overrides "table.key=value" strings, as given to --set, applied over the file before
/// checking; "fluid.pump.0.rate=30 l/s" reaches into a list of tables.
/// @throws CaseError naming file, line and column, what is wrong and what to write instead.
Case read_case(const std::string& path, const std::vector<std::string>& overrides = {},
               const CaseNames& names = {});

/// The same from a text, for tests; `name` stands for the file in messages.
Case parse_case(const std::string& text, const std::string& name,
                const std::vector<std::string>& overrides = {}, const CaseNames& names = {});

/// The case as a TOML text in SI units that read_case() reads back to the same values
/// (resolved.toml), with the version of crackle as a comment on top.
std::string resolved_toml(const Case& scene);

/// One key of a case file, for `crackle describe` and the README's table.
struct CaseKey {
  std::string table;
  std::string key;
  std::string unit;           ///< SI unit, empty for text and counts
  std::string default_value;  ///< as text; empty: required
  std::string meaning;
};

/// Every key a case file may hold, in order.
std::vector<CaseKey> case_keys();

}  // namespace crackle
