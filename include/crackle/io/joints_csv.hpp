// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "crackle/mesh/joints.hpp"

namespace crackle {

/// Joints of a CSV file, a straight piece a row. The first line names the columns; x1_m, y1_m, x2_m and
/// y2_m [m] have to be among them, in any order, others are passed over. Empty lines and lines that begin
/// with # too. @throws CaseError naming file and line
std::vector<Joint> read_joints_csv(const std::string& path, Index set);

}  // namespace crackle
