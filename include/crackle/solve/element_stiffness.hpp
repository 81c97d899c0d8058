// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "crackle/solid/stiffness.hpp"

namespace crackle {

/// Force per area [N/m over m2] on a triangle's corner with shape gradient `row` [1/m] by a unit
/// displacement d of its corner with gradient `column`: K d = A (C : sym(d ⊗ g_column)) g_row.
inline Vec2 element_force(const PlaneStiffness& c, Vec2 row, Vec2 column, Vec2 d) {
  return c.stress({d.x * column.x, d.y * column.y, 0.5 * (d.x * column.y + d.y * column.x)}) * row;
}

}  // namespace crackle
