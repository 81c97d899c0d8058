// SPDX-License-Identifier: GPL-3.0-or-later
//
// A fracture that snaps in field time: over to explicit steps, and back.
#include "hand_over.hpp"

#include <gtest/gtest.h>

namespace crackle {
namespace {

TEST(HandOver, GriffithSnap) {
  const hand_over::Snap snap = hand_over::griffith(6e-3);
  EXPECT_LT(std::abs(snap.pressure), 0.02);
  EXPECT_LT(std::abs(snap.length), 0.05);
  EXPECT_GT(snap.lost, 1.0);
  EXPECT_NEAR(snap.torn, 1.0, 0.03);
  EXPECT_LT(snap.mass, 1e-8);
  EXPECT_LT(snap.energy, 1e-3);

  // As an event: of a crack that opens by a volume V, M = λ V + 2 μ V along its normal, λ V across.
  const SeismicEvent& e = snap.event;
  const PlaneStiffness rock = granite::stiffness();
  std::printf("event: M0 %.4g N m/m, volume by its moment %.4f of the fluid's; %.3f m, %.2f J/m in waves\n",
              scalar_moment(e.moment), e.moment.zz / (rock.c12 * snap.volume), e.length, e.energy);
  EXPECT_EQ(e.mode, FailureMode::tensile);
  EXPECT_NEAR(e.moment.zz, rock.c12 * snap.volume, 0.005 * rock.c12 * snap.volume);
  EXPECT_NEAR(e.moment.yy - e.moment.zz, 2.0 * rock.c66 * snap.volume, 0.01 * rock.c66 * snap.volume);
  EXPECT_NEAR(e.moment.xx, e.moment.zz, 1e-9 * e.moment.zz);
  EXPECT_NEAR(e.energy, snap.radiated, 1e-12);
  EXPECT_NEAR(e.length, snap.damaged, 1e-12);
  EXPECT_NEAR(e.place.x, snap.from + 0.5 * e.length, 1e-9);
  EXPECT_NEAR(e.place.y, 0.0, 1e-12);
}

}  // namespace
}  // namespace crackle
