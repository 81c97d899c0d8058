// SPDX-License-Identifier: GPL-3.0-or-later
//
// What an element between two triangles has to keep under every registered law: exchange of its faces,
// rotation, energy booked.
#include <array>

#include "cohesive_laws.hpp"

namespace crackle {
namespace {

class CohesiveElementOf : public testing::TestWithParam<LawPointer> {};
INSTANTIATE_TEST_SUITE_P(Registered, CohesiveElementOf, testing::ValuesIn(registered_laws()), name_of);

// Two triangles on one edge along x; `exchanged`: the lower one comes first and has face a.
class Pair {
 public:
  Pair(const LawPointer& law, const CohesiveMaterial& material, bool exchanged)
      : upper_(exchanged ? 1 : 0), cohesive_(law, material) {
    const double h = edge_length;
    Mesh mesh;
    mesh.vertices = {{0, 0}, {h, 0}, {0.5 * h, 0.9 * h}, {0.5 * h, -0.9 * h}};
    mesh.triangles = {{0, 1, 2}, {1, 0, 3}};
    if (exchanged) std::swap(mesh.triangles[0], mesh.triangles[1]);
    mesh.regions = {Region::rock, Region::rock};
    build_edges(mesh);
    state = make_split_state(std::make_shared<const Mesh>(mesh));
    insert_all(state);
  }

  State state;

  /// Both ends of the upper triangle's side move by these, the whole is turned by an angle [rad].
  /// @return forces on the upper triangle at x = 0 and x = h, turned back [N/m]
  std::array<Vec2, 2> move(Vec2 at_left, Vec2 at_right, double angle) {
    const double c = std::cos(angle), s = std::sin(angle);
    for (Index corner = 0; corner < 6; ++corner) {
      const Vec2 x = state.reference(corner);
      Vec2 y = x;
      if (corner / 3 == upper_) {
        const double part = x.x / edge_length;
        y += (1.0 - part) * at_left + part * at_right;
      }
      state.displacement[granite::at(corner)] = Vec2{c * y.x - s * y.y, s * y.x + c * y.y} - x;
    }
    cohesive_.add_tractions(state);
    const EndForces& f = state.cohesive.force[0];
    const Vec2 first = upper_ == 0 ? f.end0 : -f.end1, second = upper_ == 0 ? f.end1 : -f.end0;
    const auto back = [&](Vec2 v) { return Vec2{c * v.x + s * v.y, -s * v.x + c * v.y}; };
    return {back(first), back(second)};
  }
  double stored() const { return cohesive_.stored_energy(state); }

 private:
  Index upper_;
  Cohesive cohesive_;
};

// A way of opening, turning and sliding to and fro until the element is broken: displacement of the two
// ends at step i.
std::array<Vec2, 2> way(int i) {
  const double t = 1e-3 * i;
  const Vec2 middle{4e-6 * std::sin(3.0 * t) * t, 1.5e-6 * (0.5 * t * t - 0.3 * std::sin(5.0 * t))};
  const Vec2 tilt{0.0, 3e-7 * std::sin(7.0 * t)};
  return {middle - tilt, middle + tilt};
}
constexpr int way_steps = 6000;

TEST_P(CohesiveElementOf, FacesCanBeExchanged) {
  Pair one(GetParam(), weaker_friction(), false), other(GetParam(), weaker_friction(), true);
  double worst = 0.0;
  for (int i = 0; i <= way_steps; ++i) {
    const auto [left, right] = way(i);
    const auto f = one.move(left, right, 0.0), g = other.move(left, right, 0.0);
    worst = std::max({worst, norm(f[0] - g[0]), norm(f[1] - g[1])});
  }
  const double scale = granite::cohesive().cohesion * edge_length;
  std::printf("%s: exchanged faces differ by %.1e of the shear strength\n", GetParam()->name().c_str(),
              worst / scale);
  EXPECT_EQ(one.state.cohesive.status[0], CohesiveStatus::broken);
  EXPECT_LT(worst, 1e-9 * scale);
  EXPECT_NEAR(one.state.dissipation.fracture / other.state.dissipation.fracture, 1.0, 1e-9);
}

TEST_P(CohesiveElementOf, TurnsWithTheRock) {
  Pair still(GetParam(), weaker_friction(), false), turning(GetParam(), weaker_friction(), false);
  double worst = 0.0;
  for (int i = 0; i <= way_steps; ++i) {
    const auto [left, right] = way(i);
    const double angle = 2.0 * std::numbers::pi * i / way_steps;
    const auto f = still.move(left, right, 0.0), g = turning.move(left, right, angle);
    worst = std::max({worst, norm(f[0] - g[0]), norm(f[1] - g[1])});
  }
  const double scale = granite::cohesive().cohesion * edge_length;
  std::printf("%s: turned by 360 degrees on the way, forces differ by %.1e of the shear strength\n",
              GetParam()->name().c_str(), worst / scale);
  EXPECT_LT(worst, 1e-8 * scale);
  EXPECT_NEAR(still.state.dissipation.fracture / turning.state.dissipation.fracture, 1.0, 1e-6);
}

TEST_P(CohesiveElementOf, BooksWhatItDissipates) {
  Pair pair(GetParam(), granite::cohesive(), false);
  double work = 0.0, fracture = 0.0, friction = 0.0;
  std::array<Vec2, 2> at{}, force{};
  for (int i = 0; i <= 10 * way_steps; ++i) {
    // slid and pulled apart: a third of the shear separation is opening
    const double d = 4e-5 * i / (10 * way_steps);
    const std::array<Vec2, 2> now{Vec2{d, d / 3.0}, Vec2{d, d / 3.0}};
    const auto f = pair.move(now[0], now[1], 0.0);
    for (std::size_t e = 0; e < 2; ++e) work -= 0.5 * dot(f[e] + force[e], now[e] - at[e]);
    force = f, at = now;
    EXPECT_GE(pair.state.dissipation.fracture, fracture);
    EXPECT_GE(pair.state.dissipation.friction, friction);
    fracture = pair.state.dissipation.fracture, friction = pair.state.dissipation.friction;
  }
  const double booked = fracture + friction;
  std::printf("%s: %.5f J/m2 done, %.5f booked (error %.1e), %.1e stored\n", GetParam()->name().c_str(),
              work / edge_length, booked / edge_length, booked / work - 1.0, pair.stored() / edge_length);
  EXPECT_EQ(pair.state.cohesive.status[0], CohesiveStatus::broken);
  EXPECT_EQ(pair.stored(), 0.0);
  EXPECT_NEAR(booked / work, 1.0, 1e-4);
}

// Bedded rock: an element along x takes the fracture energy of its own plane, whatever the angle of the
// bedding.
TEST_P(CohesiveElementOf, TakesTheEnergyOfItsPlaneInBeddedRock) {
  for (const double exponent : {1.0, 4.0}) {
    for (const double degrees : {0.0, 20.0, 50.0, 90.0}) {
      const double angle = degrees * std::numbers::pi / 180.0;
      CohesiveMaterial rock = granite::cohesive();
      rock.tan_residual = 0.0;
      rock.bedding = {{-std::sin(angle), std::cos(angle)}, exponent, 1e6, 10e6, 2.0, 20.0};
      const double share = std::pow(std::cos(angle), 2.0 * exponent);
      for (const bool shear : {false, true}) {
        Pair pair(GetParam(), rock, false);
        const double energy = shear ? 80.0 + share * (20.0 - 80.0) : 5.0 + share * (2.0 - 5.0);
        const double strength = shear ? 24e6 + share * (10e6 - 24e6) : 3e6 + share * (1e6 - 3e6);
        const int steps = 40000;
        const double end = 8.0 * energy / strength;
        double most = 0.0;
        for (int i = 0; i <= steps; ++i) {
          const double d = end * i / steps;
          const Vec2 u = shear ? Vec2{d, 0.0} : Vec2{0.0, d};
          const auto f = pair.move(u, u, 0.0);
          most = std::max(most, norm(f[0] + f[1]) / edge_length);
        }
        const double taken = pair.state.dissipation.fracture / edge_length;
        std::printf("%s, m %.0f, %.0f degrees, %s: energy %+.1e, strength %+.1e\n",
                    GetParam()->name().c_str(), exponent, degrees, shear ? "shear" : "tension",
                    taken / energy - 1.0, most / strength - 1.0);
        EXPECT_EQ(pair.state.cohesive.status[0], CohesiveStatus::broken);
        EXPECT_NEAR(taken / energy, 1.0, 1e-3);
        EXPECT_NEAR(most / strength, 1.0, 1e-3);
      }
    }
  }
}

}  // namespace
}  // namespace crackle
