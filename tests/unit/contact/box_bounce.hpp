// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace crackle::test {

/// A triangle thrown about in a box of fixed walls. A bounce errs by the place of first touch in a
/// step, which is of order (ωΔt)² and random; hence a small step.
void bounce_in_box(int bounces, double fraction_of_step);

}  // namespace crackle::test
