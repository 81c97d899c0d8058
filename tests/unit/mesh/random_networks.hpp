// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

namespace crackle::test {

/// No triangle of the rock is sharper than this, however the joints lie.
constexpr double least_angle_deg = 10.0;

/// Meshes random networks, the first-th to the (first + count - 1)-th, and expects of each: every joint
/// there, edges within an element size of their joint, no sliver, the same mesh twice.
void expect_sound_networks(int first, int count, const std::string& generator);

}  // namespace crackle::test
