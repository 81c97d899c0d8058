// SPDX-License-Identifier: GPL-3.0-or-later
//
// What a triangle with a smeared crack has to keep, whatever its softening law: every registered one is
// tested unasked, in both presets.
#include "crackle/solid/damage.hpp"

#include <gtest/gtest.h>

#include <map>
#include <ostream>
#include <tuple>

#include "../acceptance.hpp"
#include "../granite.hpp"
#include "../result.hpp"

namespace crackle {

using SofteningPointer = std::shared_ptr<const SofteningLaw>;
void PrintTo(const SofteningPointer& law, std::ostream* out) { *out << law->name(); }

namespace {

using granite::at;

// f_t = 3, c = 6 MPa, G = 50 and 100 J/m2: the material of the references.
DamageMaterial material(DamagePreset preset) {
  DamageMaterial m{3e6, 6e6, 0.0, 0.5, 50.0, 100.0, true, true, Initiation::box, ElementLength::oliver};
  m.apply(preset);
  return m;
}

// One irregular triangle that is strained at will, with the work that its corners' forces take.
class Sample {
 public:
  Sample(SofteningPointer law, const DamageMaterial& m, const PlaneStiffness& c = granite::stiffness(),
         Sym2 in_situ = {})
      : mesh_(one_triangle()), bulk_(*mesh_, c, granite::density, in_situ, {}), damage_(std::move(law), {m}) {
    state = make_tied_state(mesh_);
    state.damage.of_triangle.assign(1, -1);
  }

  State state;
  const Bulk& bulk() const { return bulk_; }
  Damage& damage() { return damage_; }
  DamagedTriangle& crack() { return state.damage.triangles.front(); }
  void start(Vec2 normal) {
    damage_.crack(state, bulk_, 0, {true, false, normal, damage_.material(0).cohesion});
  }

  // Displacements of a gradient H = F − 1.
  void deform(double xx, double xy, double yx, double yy) {
    std::array<Vec2, 3> u;
    for (Index i = 0; i < 3; ++i) {
      const Vec2 x = state.reference(i);
      u[at(i)] = {xx * x.x + xy * x.y, yx * x.x + yy * x.y};
    }
    move(u);
  }
  // A stretch of opening and engineering shear strain in the frame (n, s).
  void strain(Vec2 n, double across, double shear) {
    const Vec2 s{-n.y, n.x};
    const double xx = across * n.x * n.x + shear * n.x * s.x, yy = across * n.y * n.y + shear * n.y * s.y;
    const double xy = across * n.x * n.y + 0.5 * shear * (n.x * s.y + n.y * s.x);
    deform(xx, xy, xy, yy);
  }
  void move(const std::array<Vec2, 3>& u) {
    const auto before = crack().force;
    std::array<Vec2, 3> step;
    for (Index i = 0; i < 3; ++i) {
      Vec2& here = state.displacement[at(state.node_of_corner[at(i)])];
      step[at(i)] = u[at(i)] - here;
      here = u[at(i)];
      state.velocity[at(state.node_of_corner[at(i)])] = step[at(i)];
    }
    state.time_step = 1.0;
    damage_.update(state, bulk_);
    for (std::size_t i = 0; i < 3; ++i) work -= 0.5 * dot(before[i] + crack().force[i], step[i]);
  }

  double work = 0.0;  // [J/m]
  double booked() const { return state.dissipation.fracture + state.dissipation.friction; }

 private:
  static std::shared_ptr<const Mesh> one_triangle() {
    Mesh mesh;
    mesh.vertices = {{0.0, 0.0}, {3.1e-3, 0.4e-3}, {1.2e-3, 2.7e-3}};
    mesh.triangles = {{0, 1, 2}};
    mesh.regions = {Region::rock};
    build_edges(mesh);
    return std::make_shared<const Mesh>(std::move(mesh));
  }
  std::shared_ptr<const Mesh> mesh_;
  Bulk bulk_;
  Damage damage_;
};

using Given = std::tuple<SofteningPointer, DamagePreset>;
class DamageLaw : public testing::TestWithParam<Given> {
 public:
  SofteningPointer law = std::get<0>(GetParam());
  DamagePreset preset = std::get<1>(GetParam());
  bool faithful() const { return preset == DamagePreset::faithful; }
};
std::string name_of(const testing::TestParamInfo<Given>& given) {
  return std::get<0>(given.param)->name() +
         (std::get<1>(given.param) == DamagePreset::faithful ? "_faithful" : "");
}
INSTANTIATE_TEST_SUITE_P(Registered, DamageLaw,
                         testing::Combine(testing::ValuesIn(registered_softening()),
                                          testing::Values(DamagePreset::recommended, DamagePreset::faithful)),
                         name_of);

const Vec2 n0{std::cos(0.3), std::sin(0.3)};

TEST_P(DamageLaw, CurveFallsFromOneAndEnclosesOne) {
  EXPECT_EQ(law->traction(0.0), 1.0);
  EXPECT_EQ(law->traction(law->end()), 0.0);
  double sum = 0.0;
  const int parts = 20000;
  for (int i = 0; i < parts; ++i) {
    const double x0 = law->end() * i / parts, x1 = law->end() * (i + 1) / parts;
    EXPECT_LE(law->traction(x1), law->traction(x0));
    sum += 0.5 * (law->traction(x0) + law->traction(x1)) * (x1 - x0);
    if (i % 1000 == 500) {
      EXPECT_NEAR(law->area(x0), sum - 0.5 * (law->traction(x0) + law->traction(x1)) * (x1 - x0), 1e-6);
      const double r = 0.9 * law->size_factor();
      EXPECT_NEAR(law->loaded(r, x0 + r * law->traction(x0)), x0, 1e-9);
      EXPECT_NEAR(law->at_damage(r, law->damage(r, x0)), x0, 1e-9);
    }
  }
  EXPECT_NEAR(sum, 1.0, 1.1e-4);  // the exponential is cut at 1e-4
}

TEST_P(DamageLaw, DissipatesItsFractureEnergies) {
  for (const bool shear : {false, true}) {
    Sample s(law, material(preset));
    s.start(n0);
    const double length = s.crack().length, area = s.bulk().area(0);
    const double energy = shear ? 100.0 : 50.0, strength = shear ? 6e6 : 3e6;
    const double end = 1.2 * law->end() * energy / (strength * length);
    const auto to = [&](double e) { shear ? s.strain(n0, 1e-12, e) : s.strain(n0, e, 0.0); };
    const int steps = 40000;
    double cycle = 0.0;
    for (int i = 1; i <= steps; ++i) {
      to(end * i / steps);
      if (i == 3 * steps / 10) {  // to zero and back
        const double before = s.work;
        for (int k = 1; k <= 200; ++k) to(end * i / steps * std::abs(1.0 - k / 100.0));
        cycle = (s.work - before) / (energy / length * area);
      }
    }
    const double error = s.work / area * length / energy - 1.0;
    const double miss = (s.booked() + s.crack().stored - s.work) / s.work;
    std::printf("%s: work over G %+.1e, cycle %.1e, ledger %.1e\n", shear ? "shear" : "tension", error, cycle,
                miss);
    const bool cut_off = law->name() == "exponential";
    accept("T1",
           "a triangle, " + law->name() + (faithful() ? ", faithful, " : ", ") +
               (shear ? "shear" : "tension") + ", unloaded on the way: work over G",
           cut_off ? "2e-3" : "1e-4", text("%.1e", std::abs(error)),
           std::abs(error) < (cut_off ? 2e-3 : 1e-4));
    EXPECT_TRUE(s.crack().failed);
    // In shear the recommended preset follows the curve too: nothing opens.
    EXPECT_LT(std::abs(error), law->name() == "exponential" ? 2e-3 : 1e-4);
    EXPECT_LT(std::abs(cycle), 1e-8);
    EXPECT_LT(std::abs(miss), 1e-4);
  }
}

TEST_P(DamageLaw, NoHealing) {
  Sample s(law, material(preset));
  s.start(n0);
  const double e = 0.4 * law->end() * 50.0 / (3e6 * s.crack().length);
  s.strain(n0, e, 0.0);
  const auto history = s.crack().history;
  const auto force = s.crack().force;
  for (const double part : {0.7, 0.0, -0.5, 0.2, 1.0}) s.strain(n0, part * e, 0.0);
  EXPECT_EQ(s.crack().history, history);
  for (std::size_t i = 0; i < 3; ++i) EXPECT_LT(norm(s.crack().force[i] - force[i]), 1e-9 * norm(force[i]));
}

TEST_P(DamageLaw, TurnsWithTheTriangle) {
  Sample s(law, material(preset), granite::stiffness(), {-5e6, -3e6, 1e6});
  s.start(n0);
  const double e = 0.3 * law->end() * 50.0 / (3e6 * s.crack().length);
  s.strain(n0, e, 0.3 * e);
  const auto force = s.crack().force;
  const double xx = s.crack().stress.xx;
  std::array<Vec2, 3> u{};
  double worst = 0.0;
  for (const double angle : {0.5 * std::numbers::pi, 2.0, 6.0}) {
    const double c = std::cos(angle), w = std::sin(angle);
    Sample turned(law, material(preset), granite::stiffness(), {-5e6, -3e6, 1e6});
    turned.start(n0);
    turned.strain(n0, e, 0.3 * e);
    for (Index i = 0; i < 3; ++i) {
      const Vec2 x = turned.state.position(i);
      u[at(i)] = Vec2{c * x.x - w * x.y, w * x.x + c * x.y} - turned.state.reference(i);
    }
    turned.move(u);
    for (std::size_t i = 0; i < 3; ++i) {
      const Vec2 f{c * force[i].x - w * force[i].y, w * force[i].x + c * force[i].y};
      worst = std::max(worst, norm(turned.crack().force[i] - f) / norm(force[i]));
    }
    EXPECT_NEAR(turned.crack().stress.xx, xx, 1e-10 * std::abs(xx));
  }
  std::printf("turned by 90 degrees and more: forces %.1e\n", worst);
  if (law->name() == "linear" && !faithful())
    accept("T2", "triangle turned by 90 degrees", "1e-10", text("%.1e", worst), worst < 1e-10);
  EXPECT_LT(worst, 1e-10);
}

// Unloaded, forces are the gradient of the stored energy, also on bedded rock, turned and strained.
TEST_P(DamageLaw, ForcesAreTheGradientOfItsEnergy) {
  const PlaneStiffness bedded = transversely_isotropic_plane_strain({40e9, 20e9, 0.2, 0.25, 9e9, 0.4});
  for (const double sign : {1.0, -1.0}) {
    DamageMaterial m = material(preset);
    m.tan_residual = 0.0;
    Sample s(law, m, bedded, {-5e6, -3e6, 1e6});
    s.start(n0);
    const double e = 0.3 * 50.0 / (3e6 * s.crack().length);
    s.strain(n0, 1.5 * e, -1.5 * e);
    const auto history = s.crack().history;
    // turned by 0.5, the strain with other axes than the crack's
    const double c = std::cos(0.5), w = std::sin(0.5);
    const double xx = 1.0 + sign * 0.8 * e, xy = 0.3 * e, yy = 1.0 + 0.2 * e;
    s.deform(c * xx - w * xy - 1.0, c * xy - w * yy, w * xx + c * xy, w * xy + c * yy - 1.0);
    ASSERT_EQ(s.crack().history, history) << "unloaded";
    const auto force = s.crack().force;
    const auto crack = s.crack();
    const double h = 1e-9;
    double worst = 0.0, size = 0.0;
    for (Index i = 0; i < 3; ++i) {
      for (const Vec2 way : {Vec2{1.0, 0.0}, Vec2{0.0, 1.0}}) {
        Vec2& here = s.state.displacement[at(s.state.node_of_corner[at(i)])];
        const Vec2 kept = here;
        std::array<double, 2> stored{};
        for (const int k : {0, 1}) {
          here = kept + (k == 0 ? h : -h) * way;
          s.crack() = crack;
          s.damage().update(s.state, s.bulk());
          stored[static_cast<std::size_t>(k)] = s.crack().stored;
        }
        here = kept;
        const double slope = -(stored[0] - stored[1]) / (2.0 * h);
        worst = std::max(worst, std::abs(slope - dot(force[at(i)], way)));
        size = std::max(size, norm(force[at(i)]));
      }
    }
    std::printf("forces against the gradient of the energy: %.1e (%s)\n", worst / size,
                crack.open ? "open" : "closed");
    EXPECT_LT(worst / size, 1e-5);
  }
}

// Random corners: what is put in is stored or booked, and nothing is won.
TEST_P(DamageLaw, LedgerClosesOnRandomPaths) {
  double worst = 0.0, won = 0.0;
  for (unsigned seed = 1; seed <= 5; ++seed) {
    Sample s(law, material(preset), granite::stiffness(), {-2e6, -1e6, 0.0});
    s.start(n0);
    const double at_start = s.crack().stored + s.booked();
    const double scale = 0.4 * law->end() * 50.0 / (3e6 * s.crack().length);
    std::uint64_t x = 0x9e3779b97f4a7c15ULL * seed;
    const auto random = [&] {
      x ^= x >> 12;
      x ^= x << 25;
      x ^= x >> 27;
      return 2.0 * static_cast<double>((x * 0x2545f4914f6cdd1dULL) >> 11) / 9007199254740992.0 - 1.0;
    };
    std::array<double, 4> from{};
    double turnover = 0.0, booked = s.booked();
    for (int stop = 0; stop < 12; ++stop) {
      std::array<double, 4> to{};
      for (double& t : to) t = scale * random();
      const int steps = 4000;
      for (int i = 1; i <= steps; ++i) {
        const double p = static_cast<double>(i) / steps;
        const double before = s.work;
        const auto part = [&](std::size_t k) { return from[k] + p * (to[k] - from[k]); };
        s.deform(part(0), part(1), part(2), part(3));
        turnover += std::abs(s.work - before);
        won = std::max(won, (booked - s.booked()) / turnover);
        booked = s.booked();
      }
      from = to;
    }
    const double miss = std::abs(s.crack().stored + s.booked() - at_start - s.work) / turnover;
    worst = std::max(worst, miss);
  }
  std::printf("random paths: ledger %.1e of the work turned over, booked falls by %.1e\n", worst, won);
  EXPECT_LT(worst, 1e-3);
  EXPECT_LT(won, 1e-6);
}

// A failed crack pressed shut rubs: to and fro it takes 4 μ σ times the slip either way, and opens and closes
// without a jump in force (T2).
TEST_P(DamageLaw, ClosedCracksRub) {
  Sample s(law, material(preset));
  s.start(n0);
  const double wide = 1.5 * law->end() * 50.0 / (3e6 * s.crack().length);
  s.strain(n0, wide, 0.0);
  ASSERT_TRUE(s.crack().failed);
  const double press = 1e-4, slip = 1e-3;
  s.strain(n0, 0.0, 0.0);
  double jump = 0.0;
  for (int i = 0; i <= 2000; ++i) {  // shut and open again, with little slip
    const auto before = s.crack().force;
    s.strain(n0, press * std::cos(2.0 * std::numbers::pi * i / 1000), 0.0);
    if (i > 0) {
      for (std::size_t k = 0; k < 3; ++k) jump = std::max(jump, norm(s.crack().force[k] - before[k]));
    }
  }
  const double stiffness = granite::stiffness().c11;
  jump /= stiffness * press * std::sqrt(s.bulk().area(0));
  s.strain(n0, 0.0, 0.0);
  for (int i = 1; i <= 100; ++i) s.strain(n0, -press * i / 100, 0.0);
  const double cap = 0.5 * stiffness * press, area = s.bulk().area(0);
  const double give = cap / granite::stiffness().c66;  // of the springs, before it slides
  const auto cycle = [&] {
    const double work = s.work, rubbed = s.state.dissipation.friction;
    double from = slip;
    for (const double to : {slip - 2.0 * give, -slip, -slip + 2.0 * give, slip}) {  // corners of the loop
      for (int i = 1; i <= 500; ++i) s.strain(n0, -press, from + (to - from) * i / 500);
      from = to;
    }
    return Vec2{s.work - work, s.state.dissipation.friction - rubbed};
  };
  for (int i = 1; i <= 500; ++i) s.strain(n0, -press, slip * i / 500);
  cycle();
  const Vec2 taken = cycle();
  const double expected = 4.0 * cap * (slip - give) * area;
  std::printf(
      "friction: work of a cycle %+.1e, booked %+.1e; largest change of force in 1/1000 of a cycle %.1e\n",
      taken.x / expected - 1.0, taken.y / expected - 1.0, jump);
  if (law->name() == "linear" && !faithful())
    accept("T2", "closed crack that rubs: work of a cycle", "1e-8",
           text("%.1e", std::abs(taken.x / expected - 1.0)), std::abs(taken.x / expected - 1.0) < 1e-8);
  EXPECT_NEAR(taken.x, expected, 1e-8 * expected);
  EXPECT_NEAR(taken.y, taken.x, 1e-8 * expected);
  EXPECT_LT(jump, 0.01);
}

DamageMaterial bedded(DamagePreset preset, double angle, double exponent) {
  DamageMaterial m = material(preset);
  m.tan_friction = 0.6;
  m.bedding = {{-std::sin(angle), std::cos(angle)}, exponent, 1e6, 2e6, 20.0, 40.0};
  return m;
}

// In bedded rock a triangle takes the fracture energy of its crack's plane.
TEST_P(DamageLaw, TakesTheEnergyOfItsPlaneInBeddedRock) {
  for (const double degrees : {0.0, 30.0, 90.0}) {
    const double angle = 0.3 - 0.5 * std::numbers::pi + degrees * std::numbers::pi / 180.0;  // from n0
    const double share = std::pow(std::cos(degrees * std::numbers::pi / 180.0), 2.0);
    Sample s(law, bedded(preset, angle, 1.0));
    s.start(n0);
    const double energy = 50.0 + share * (20.0 - 50.0), strength = 3e6 + share * (1e6 - 3e6);
    EXPECT_NEAR(s.crack().strength[0], strength, 1.0);
    const double length = s.crack().length, end = 1.2 * law->end() * energy / (strength * length);
    for (int i = 1; i <= 20000; ++i) s.strain(n0, end * i / 20000, 0.0);
    const double error = s.work / s.bulk().area(0) * length / energy - 1.0;
    std::printf("%s at %.0f degrees: work over G %+.1e\n", law->name().c_str(), degrees, error);
    EXPECT_TRUE(s.crack().failed);
    EXPECT_LT(std::abs(error), law->name() == "exponential" ? 2e-3 : 1e-4);
  }
}

// Where bedded rock cracks first as a stress grows, and on which plane: against all planes one by one.
TEST(DamageInitiation, OfBeddedRockIsOnTheWorstPlane) {
  const std::vector<Sym2> ways{{1.0, 0.0, 0.0}, {1.0, 0.5, 0.3}, {-1.0, -0.1, 0.2}, {-0.2, -1.0, 0.1}};
  double off = 0.0, turned = 0.0;
  for (const Initiation by :
       {Initiation::principal, Initiation::shear, Initiation::ellipse, Initiation::mohr_coulomb}) {
    for (const double exponent : {1.0, 4.0}) {
      for (int degrees = 0; degrees < 180; degrees += 15) {
        DamageMaterial m = bedded(DamagePreset::recommended, degrees * std::numbers::pi / 180.0, exponent);
        m.initiation = by;
        const double phi = by == Initiation::mohr_coulomb ? m.tan_friction : 0.0;
        for (const Sym2 way : ways) {
          const auto load = [&](Vec2 n) {  // over strength at a stress of 1 Pa
            const DamageMaterial here = on_plane(m, n);
            const Vec2 t = way * n;
            const double pull = dot(t, n) / here.tensile_strength;
            const double shear = (std::abs(cross(n, t)) + phi * dot(t, n)) / here.cohesion;
            return by == Initiation::principal ? pull
                   : by == Initiation::shear   ? shear
                   : by == Initiation::ellipse ? std::hypot(std::max(pull, 0.0), shear)
                                               : std::max(pull, shear);
          };
          double worst = 0.0;
          for (int i = 0; i < 18000; ++i) {
            const double a = std::numbers::pi * i / 18000;
            worst = std::max(worst, load({std::cos(a), std::sin(a)}));
          }
          if (worst <= 0.0) continue;
          double low = 0.0, high = 4.0 / worst;
          for (int i = 0; i < 60; ++i) {
            const double middle = 0.5 * (low + high);
            (crack_start(m, middle * way).reached ? high : low) = middle;
          }
          off = std::max(off, std::abs(high * worst - 1.0));
          const Vec2 n = crack_start(m, (high * (1.0 + 1e-9)) * way).normal;
          turned = std::max(turned, 1.0 - load(n) / worst);
        }
      }
    }
  }
  std::printf("bedded rock: stress at initiation off by %.1e, load on its plane below the worst by %.1e\n",
              off, turned);
  EXPECT_LT(off, 1e-5);
  EXPECT_LT(turned, 1e-6);
}

// Size limits of the paper's granite (T10).
TEST(DamageSize, LimitsOfTheGranite) {
  DamageMaterial m = material(DamagePreset::recommended);
  m = {3e6, 24e6, 0.0, 0.0, 5.0, 80.0};
  const std::map<std::string, std::array<double, 2>> expected{{"linear", {48.6e-3, 3.83e-3}},
                                                              {"exponential", {24.3e-3, 1.91e-3}},
                                                              {"cubic_step", {32.4e-3, 2.55e-3}}};
  for (const auto& [name, limit] : expected) {
    const auto found = size_limits(m, *find_softening(name), granite::stiffness(), {1.0, 0.0});
    std::printf("%s: %.2f mm in tension, %.3f mm in shear\n", name.c_str(), 1e3 * found[0], 1e3 * found[1]);
    accept("T10", "size limits of the paper's granite, " + name,
           text("%.1f mm in tension, %.2f mm in shear", 1e3 * limit[0], 1e3 * limit[1]),
           text("%.1f, %.2f mm", 1e3 * found[0], 1e3 * found[1]),
           std::abs(found[0] - limit[0]) < 0.06e-3 && std::abs(found[1] - limit[1]) < 0.006e-3);
    EXPECT_NEAR(found[0], limit[0], 0.06e-3);
    EXPECT_NEAR(found[1], limit[1], 0.006e-3);
  }
}

// A band of triangles between marked vertices and the others: Σ A/ℓ is its length across n (T4).
TEST(DamageLength, OfABandIsThatOfTheCrack) {
  double worst = 0.0, oliver = 0.0, chord = 0.0;
  for (const std::uint64_t seed : {1u, 2u, 3u}) {
    const Mesh mesh =
        jittered(structured_rectangle({0, 0}, {0.05, 0.03}, 20, 12, MeshPattern::cross), 0.28, seed);
    const Bulk bulk(mesh, granite::stiffness(), granite::density, {}, {});
    double band = 0.0, by_oliver = 0.0, by_chord = 0.0;
    for (Index t = 0; t < mesh.triangle_count(); ++t) {
      std::array<bool, 3> ahead{};
      std::array<Vec2, 3> x;
      for (std::size_t i = 0; i < 3; ++i) {
        x[i] = mesh.vertices[at(mesh.triangles[at(t)][i])];
        ahead[i] = x[i].x > 0.0261;
      }
      const int count = ahead[0] + ahead[1] + ahead[2];
      if (count == 0 || count == 3) continue;
      band += bulk.area(t) / parting_length(bulk.shape_gradients(t), ahead, {1.0, 0.0});
      by_oliver += bulk.area(t) / oliver_length(bulk.shape_gradients(t), {1.0, 0.0});
      by_chord += bulk.area(t) / chord_length(x, {1.0, 0.0});
    }
    worst = std::max(worst, std::abs(band / 0.03 - 1.0));
    oliver = std::max(oliver, std::abs(by_oliver / 0.03 - 1.0));
    chord = std::max(chord, std::abs(by_chord / 0.03 - 1.0));
  }
  std::printf(
      "sum of A/l over a band: %.1e; with each triangle parted at its centroid %.2f, by its chord %.2f off\n",
      worst, oliver, chord);
  accept("T4", "sum of area over element length along a band", "1e-12", text("%.0e", worst), worst < 1e-12);
  EXPECT_LT(worst, 1e-12);
}

// Mixed ways, faithful: at failure the energies fill ΣG_i/G_ic = 1, and what is dropped is booked (adam.md
// 3).
TEST(DamageFaithful, MixedModeFailsAtTheEnergySumAndBooksTheDrop) {
  const std::map<double, double> expected{{15.0, 84.80}, {45.0, 113.07}, {75.0, 114.68}};
  for (const auto& [degrees, work] : expected) {
    const double psi = degrees * std::numbers::pi / 180.0;
    Sample s(find_softening("linear"), material(DamagePreset::faithful));
    s.start(n0);
    const double length = s.crack().length;
    const double end = 2.0 * 50.0 / (3e6 * length);
    const int steps = 100000;
    double opened = 0.0, slid = 0.0;
    for (int i = 1; i <= steps && !s.crack().failed; ++i) {
      s.strain(n0, 3.0 * end * std::cos(psi) * i / steps, 3.0 * end * std::sin(psi) * i / steps);
      if (s.crack().failed) break;
      const SofteningLaw& law = s.damage().law();
      opened = law.dissipated(s.crack().history[0]);
      slid = law.dissipated(s.crack().history[1]);
    }
    const double area = s.bulk().area(0);
    const double total = s.work / area * length;
    const double booked = s.booked() / area * length;
    std::printf("psi %.0f: G_I/G_Ic %.4f, G_II/G_IIc %.4f, sum %.4f; work %.3f, booked %.3f J/m2\n", degrees,
                opened, slid, opened + slid, total, booked);
    accept("T1", text("faithful, mixed mode at %.0f degrees: sum of G_i/G_ic at failure", degrees), "0.1 %",
           text("%.4f", opened + slid), std::abs(opened + slid - 1.0) < 1e-3);
    accept("T1", text("faithful, mixed mode at %.0f degrees: work, %.2f J/m2", degrees, work), "0.5 %",
           text("%.2f J/m2", total), std::abs(total / work - 1.0) < 5e-3);
    EXPECT_NEAR(opened + slid, 1.0, 1e-3);
    EXPECT_NEAR(booked, total, 1e-3 * total);
    EXPECT_NEAR(total, work, 5e-3 * work);
  }
}

}  // namespace
}  // namespace crackle
