// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "crackle/io/case.hpp"
#include "crackle/seismic/b_value.hpp"
#include "crackle/seismic/clusters.hpp"

namespace crackle {

/// The b-value of a catalog's magnitudes (of energy), complete from the maximum curvature on.
BValue b_value_of(const std::vector<SeismicEvent>& events);

/// The summary that `crackle catalog` prints.
std::string catalog_summary(const std::string& folder, const std::vector<SeismicEvent>& events,
                            const Case& scene, const ClusterRule& rule);

}  // namespace crackle
