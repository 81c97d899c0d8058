// SPDX-License-Identifier: GPL-3.0-or-later
// Functions of the C library whose last bit depends on the CPU (with or without fused multiply-add),
// made of basic operations only: meshes and networks have to be the same everywhere.
#pragma once

#include "crackle/core/vec2.hpp"

namespace crackle::meshing {

/// cos and sin of an angle in [0, pi/4].
Vec2 direction_in_first_octant(double angle);
/// cos and sin of any angle [rad].
Vec2 portable_direction(double angle);
/// Natural logarithm of a positive number.
double portable_log(double x);
/// Exponential; 0 below -700.
double portable_exp(double x);

}  // namespace crackle::meshing
