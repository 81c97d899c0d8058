// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace crackle {

/// Share z of the strength left at damage D in [0, 1]; formula in evans_marathe.cpp.
double evans_marathe_softening(double damage);
/// Its integral over D from 0 to 1.
inline constexpr double evans_marathe_integral = 0.38630729474394;

}  // namespace crackle
