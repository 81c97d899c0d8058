// SPDX-License-Identifier: GPL-3.0-or-later
#include "crackle/fluid/pump.hpp"

#include <algorithm>

namespace crackle {

double Pump::rate(double time) const {
  for (const PumpStage& s : stages_) {
    if (time >= s.from && time < s.to) return s.rate;
  }
  return 0.0;
}

double Pump::volume(double from, double to) const {
  double sum = 0.0;
  for (const PumpStage& s : stages_) {
    sum += s.rate * std::max(0.0, std::min(to, s.to) - std::max(from, s.from));
  }
  return sum;
}

}  // namespace crackle
