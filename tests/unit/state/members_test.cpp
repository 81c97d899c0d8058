// SPDX-License-Identifier: GPL-3.0-or-later
//
// Nothing that a checkpoint has to save is forgotten in members.hpp.
#include "crackle/state/members.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <stdexcept>

#include "crackle/solve/members.hpp"

namespace crackle {
namespace {

static_assert(columns_detail::member_count<Vec2>() == 2 && columns_detail::member_count<Edge>() == 5);

template <class T>
class Members : public testing::Test {};
using Saved = testing::Types<Edge, Mesh, CohesivePoint, CohesiveHistory, EndForces, CohesiveElements, Cavity,
                             FluidState, Dissipation, ContactPoint, ContactState, State, Energies, StableStep,
                             DamagedTriangle, DamageState, BoundaryNode, SimulationMemory,
                             quasi_static::State, quasi_static::Cell, quasi_static::Energies>;
TYPED_TEST_SUITE(Members, Saved);

TYPED_TEST(Members, AllAreNamed) {
  TypeParam item{};
  EXPECT_NO_THROW(columns_of(item, "item"));
}

TYPED_TEST(Members, NoneTwice) {
  TypeParam item{};
  std::vector<const void*> seen;
  members(item, [&](const char* name, auto& member) {
    EXPECT_EQ(std::count(seen.begin(), seen.end(), &member), 0) << name;
    seen.push_back(&member);
  });
}

struct Forgetful {
  double kept = 0.0;
  std::int8_t forgotten = 0;
};
template <class V>
void members(Forgetful& f, V&& v) {
  v("kept", f.kept);
}

TEST(Columns, FindOutWhatIsForgotten) {
  Forgetful item;
  EXPECT_THROW(columns_of(item, "item"), std::logic_error);
}

const Column& column_named(const std::vector<Column>& columns, const std::string& name) {
  const auto found = std::ranges::find(columns, name, &Column::name);
  if (found == columns.end()) throw std::out_of_range(name);
  return *found;
}

TEST(Columns, ReachEveryNumberOfAList) {
  ContactState state;
  state.points.resize(3);
  state.points[2].depth = 7.0;
  const std::vector<Column> columns = columns_of(state, "contact");
  const Column& depth = column_named(columns, "contact/points/depth");
  EXPECT_EQ(depth.count, 3u);
  std::array<double, 3> read{1.0, 1.0, 1.0};
  depth.gather(reinterpret_cast<std::byte*>(read.data()));
  EXPECT_EQ(read, (std::array<double, 3>{0.0, 0.0, 7.0}));
  const std::array<double, 5> other{1.0, 2.0, 3.0, 4.0, 5.0};
  depth.scatter(reinterpret_cast<const std::byte*>(other.data()), 5);
  ASSERT_EQ(state.points.size(), 5u);
  EXPECT_EQ(state.points[4].depth, 5.0);
}

TEST(Columns, OfNames) {
  Mesh mesh, other;
  mesh.joint_sets = {"bedding", "", "cross joints"};
  const std::vector<Column> columns = columns_of(mesh, "mesh"), others = columns_of(other, "mesh");
  const Column& names = column_named(columns, "mesh/joint_sets");
  std::vector<std::byte> bytes(names.count);
  names.gather(bytes.data());
  column_named(others, "mesh/joint_sets").scatter(bytes.data(), bytes.size());
  EXPECT_EQ(other.joint_sets, mesh.joint_sets);
}

}  // namespace
}  // namespace crackle
