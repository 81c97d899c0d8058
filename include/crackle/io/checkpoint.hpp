// SPDX-License-Identifier: GPL-3.0-or-later
//
// A checkpoint file: the columns of a run's structs as HDF5 datasets (h5py opens it), behind a head of
// 512 bytes of text (an HDF5 user block) that says what it is and holds a checksum of all of it.
// Nothing is handed to the HDF5 library before the checksum has been found right.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "crackle/state/columns.hpp"

namespace crackle {

/// Version of the file format: what is in the file follows from the columns given; this says how.
inline constexpr int checkpoint_format = 1;

struct CheckpointHead {
  std::string program;    ///< version of crackle that wrote it
  std::int64_t step = 0;  ///< of the run
  double time = 0.0;      ///< simulated [s]
};

/// The bytes of a checkpoint. @param text goes with the columns (the resolved case)
std::string pack_checkpoint(const CheckpointHead& head, const std::vector<Column>& columns,
                            const std::string& text);

/// The head of a checkpoint, once its length and checksum have been found right.
/// @param name stands for the file in messages
/// @throws CaseError that says what is wrong: no checkpoint, another version, cut short, damaged
CheckpointHead checkpoint_head(std::string_view bytes, const std::string& name);

/// Reads the columns back, lists with the number of items they had; columns are changed only if all
/// are there. @return the text that was packed with them @throws CaseError as above, or naming the
/// first column that is not there or of another kind
std::string unpack_checkpoint(std::string_view bytes, const std::string& name,
                              const std::vector<Column>& columns);

}  // namespace crackle
