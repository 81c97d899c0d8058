// SPDX-License-Identifier: GPL-3.0-or-later
//
// Two holes in a plate: each keeps its own mass and pressure until a fracture joins them; then mass
// is conserved and energy is lost, never won.
#include <gtest/gtest.h>

#include "fractures.hpp"

namespace crackle {
namespace {

using granite::at;

constexpr double h = 0.01;                               // cell [m]
constexpr Vec2 left{0.035, 0.045}, right{0.085, 0.045};  // middles of the cells that are holes

struct Plate {
  std::shared_ptr<const Mesh> mesh;
  State state;
  Cohesive cohesive{find_law("linear"), granite::cohesive()};
  Fluid fluid;

  static std::shared_ptr<const Mesh> make_mesh() {
    const Mesh whole = structured_rectangle({0, 0}, {12 * h, 9 * h}, 12, 9, MeshPattern::right);
    const auto in_hole = [](Vec2 x) {
      const auto within = [&](Vec2 m) {
        return std::max(std::abs(x.x - m.x), std::abs(x.y - m.y)) < 0.501 * h;
      };
      return within(left) || within(right);
    };
    Mesh mesh;
    mesh.vertices = whole.vertices;
    for (Index t = 0; t < whole.triangle_count(); ++t) {
      if (!in_hole(granite::centroid(whole, t))) mesh.triangles.push_back(whole.triangles[at(t)]);
    }
    mesh.regions.assign(mesh.triangles.size(), Region::rock);
    build_edges(mesh);
    return granite::with_free_sides(std::move(mesh), in_hole);
  }

  std::vector<Index> wall(Vec2 middle) const {
    std::vector<Index> edges;
    for (const Index e : granite::edges_of_kind(*mesh, EdgeKind::wellbore)) {
      if (norm(mesh->vertices[at(mesh->edges[at(e)].vertex[0])] - middle) < h) edges.push_back(e);
    }
    return edges;
  }

  Plate(double p_left, double p_right)
      : mesh(make_mesh()),
        state(make_split_state(mesh)),
        fluid((insert_all(state), set_mass(state, granite::density), state), {2.2e9, 1000.0, 0.0},
              Pump({{0.0, 1.0, 1e-3}})) {
    fix_nodes(state, EdgeKind::outer);
    fluid.fill(state, wall(left), p_left);
    fluid.fill(state, wall(right), p_right);
  }
  double mass() const { return state.fluid.cavities[0].mass + state.fluid.cavities[1].mass; }
  /// A fracture of two edges from the left hole on, whose upper face is lifted. @return its elements
  std::vector<Index> fracture(double lift) {
    const auto path = cut_ray(state, cohesive, {0.04, 0.04}, {1, 0}, 2);
    for (Index c = 0; c < 3 * mesh->triangle_count(); ++c) {
      const Vec2 x = state.reference(c);
      const Vec2 middle = granite::centroid(*mesh, c / 3);
      if (middle.y > 0.04 && x.y < 0.0401 && x.x > 0.0399 && x.x < 0.0601) state.displacement[at(c)].y = lift;
    }
    return path;
  }
};

TEST(Cavities, KeepTheirOwnMassAndPressure) {
  Plate plate(4e6, 1e6);
  const double first = plate.state.fluid.cavities[0].mass, second = plate.state.fluid.cavities[1].mass;
  EXPECT_NEAR(first, 1000.0 * h * h * std::exp(4e6 / 2.2e9), 1e-12);
  const double dt = 1e-9;
  for (int i = 0; i < 100; ++i) {
    plate.fluid.advance(plate.state, dt);
    plate.state.time += dt;
  }
  EXPECT_NEAR(plate.state.fluid.cavities[0].mass - first, 1000.0 * 1e-3 * 100 * dt, 1e-15)
      << "the pump feeds the first";
  EXPECT_EQ(plate.state.fluid.cavities[1].mass, second);
  EXPECT_GT(plate.state.fluid.cavities[0].pressure, 3e6);
  EXPECT_LT(plate.state.fluid.cavities[1].pressure, 1.1e6);
}

TEST(Cavities, MergeConservesMassAndLosesEnergy) {
  Plate plate(4e6, 1e6);
  const double mass = plate.mass(), energy = plate.fluid.energy(plate.state);
  const Vec2 corner{0.04, 0.04}, middle{0.05, 0.04};  // from the left hole to the right, 4 edges
  // The two middle elements first: they touch no fluid and stay dry.
  plate.fluid.connect(plate.state, cut_ray(plate.state, plate.cohesive, middle, {1, 0}, 2));
  EXPECT_EQ(plate.fluid.wetted_length(plate.state), 0.0);
  // The one at the left hole: the fluid goes through it into the two that wait, not farther.
  plate.fluid.connect(plate.state, cut_ray(plate.state, plate.cohesive, corner, {1, 0}, 1));
  EXPECT_NEAR(plate.fluid.wetted_length(plate.state), 3 * h, 1e-12);
  EXPECT_EQ(plate.fluid.loops().size(), 2u);
  EXPECT_NEAR(plate.state.fluid.cavities[1].pressure, 1e6, 1e-3);
  const double expanded = plate.state.dissipation.viscous;
  EXPECT_NEAR(expanded, 0.0, 1e-12 * energy + 1e-9) << "closed fractures take no fluid";
  // And the last one.
  plate.fluid.connect(plate.state, cut_ray(plate.state, plate.cohesive, {0.07, 0.04}, {1, 0}, 1));
  EXPECT_EQ(plate.fluid.loops().size(), 1u);
  EXPECT_NEAR(plate.fluid.wetted_length(plate.state), 4 * h, 1e-12);
  EXPECT_EQ(plate.state.fluid.cavities[1].mass, 0.0);
  const double pressure = plate.state.fluid.cavities[0].pressure;
  const double exact = 2.2e9 * std::log(0.5 * (std::exp(4e6 / 2.2e9) + std::exp(1e6 / 2.2e9)));
  const double lost = energy - plate.fluid.energy(plate.state);
  std::printf("merge: mass %.0e, pressure %.0e off; energy lost %.4e, booked %.4e J/m\n",
              plate.mass() / mass - 1.0, pressure / exact - 1.0, lost, plate.state.dissipation.viscous);
  EXPECT_NEAR(plate.mass() / mass, 1.0, 1e-14);
  EXPECT_NEAR(pressure / exact, 1.0, 1e-8);
  EXPECT_GT(lost, 0.0);
  EXPECT_NEAR(plate.state.dissipation.viscous / lost, 1.0, 1e-6);
  // The end state goes on.
  plate.fluid.advance(plate.state, 1e-9);
  EXPECT_NEAR((plate.state.fluid.cavities[0].mass - 1000.0 * 1e-3 * 1e-9) / mass, 1.0, 1e-14);
}

// A fracture that stands open is empty: the fluid expands into it, loses energy and books it.
TEST(Cavities, FreeExpansionLosesEnergy) {
  Plate plate(4e6, 1e6);
  const auto path = plate.fracture(1e-5);
  plate.fluid.refill(plate.state, 4e6);
  const double energy = plate.fluid.energy(plate.state), mass = plate.state.fluid.cavities[0].mass;
  plate.fluid.connect(plate.state, path);
  const double lost = energy - plate.fluid.energy(plate.state);
  std::printf("free expansion: pressure 4 to %.3f MPa, lost %.3e, booked %.3e J/m\n",
              plate.state.fluid.cavities[0].pressure / 1e6, lost, plate.state.dissipation.viscous);
  EXPECT_EQ(plate.state.fluid.cavities[0].mass, mass);
  EXPECT_LT(plate.state.fluid.cavities[0].pressure, 4e6);
  EXPECT_GT(lost, 0.0);
  EXPECT_NEAR(plate.state.dissipation.viscous / lost, 1.0, 1e-9);
}

// Faces that overlap take room from the fluid that comes to them: what it gains the method gave.
TEST(Cavities, ClosedFacesThatOverlapGiveEnergy) {
  Plate plate(4e6, 1e6);
  const auto path = plate.fracture(-1e-7);
  plate.fluid.refill(plate.state, 4e6);
  const double energy = plate.fluid.energy(plate.state);
  plate.fluid.connect(plate.state, path);
  const double won = plate.fluid.energy(plate.state) - energy;
  EXPECT_GT(won, 0.0);
  EXPECT_EQ(plate.state.dissipation.viscous, 0.0);
  EXPECT_NEAR(plate.state.dissipation.inserted / won, 1.0, 1e-9);
}

}  // namespace
}  // namespace crackle
