// SPDX-License-Identifier: GPL-3.0-or-later
#include "crackle/fluid/pump.hpp"

#include <algorithm>
#include <limits>

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

double Pump::next_change(double time) const {
  double next = std::numeric_limits<double>::infinity();
  for (const PumpStage& s : stages_) {
    for (const double change : {s.from, s.to}) {
      if (change > time) next = std::min(next, change);
    }
  }
  return next;
}

}  // namespace crackle
