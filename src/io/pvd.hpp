// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

namespace crackle {

/// A frame in a ParaView collection.
struct PvdEntry {
  double time = 0.0;  ///< [s]
  std::string file;   ///< relative to the .pvd file
};

/// The text of a .pvd file: the frames of a run as one time series.
std::string pvd_text(const std::vector<PvdEntry>& entries);

}  // namespace crackle
