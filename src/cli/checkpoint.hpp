// SPDX-License-Identifier: GPL-3.0-or-later
//
// A run from and to its checkpoints.
#pragma once

#include <array>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "crackle/io/output.hpp"
#include "crackle/solve/guards.hpp"
#include "crackle/solve/quasi_static_state.hpp"
#include "crackle/solve/simulation.hpp"
#include "tally.hpp"

namespace crackle {

/// What `crackle run` keeps beside its simulation while it steps.
struct RunMemory {
  double step_length = 0.0;  ///< planned [s]
  TallyMemory tally;
  double next_history = 0.0;                     ///< number of the row that comes next
  double next_fields = 0.0;                      ///< and of the frame
  double wall = 0.0;                             ///< since the start, over all its processes [s]
  double loop_wall = 0.0;                        ///< in steps [s]
  double output_wall = 0.0;                      ///< [s]
  std::array<double, Stopwatch::parts> parts{};  ///< in each part of the step [s]
  GuardMemory guards;
  FolderMarks folder;
  std::vector<SeismicEvent> events;  ///< so far
};

/// A run as it is between two steps.
struct RunSnapshot {
  std::shared_ptr<Mesh> mesh;
  State state;
  SimulationMemory simulation;
  RunMemory run;
};

/// The bytes of a checkpoint file. @param text of the resolved case
std::string pack_run(Simulation& simulation, RunMemory& memory, const std::string& text);

/// Takes the newest checkpoint of a folder that is whole and belongs to its case, and takes the
/// folder's files back to it. A folder without any goes back to nothing: mesh is nullptr.
/// @param say is told which checkpoint it is, and why others are not
/// @throws CaseError when there are checkpoints, and none of them can be used
RunSnapshot take_up(RunFolder& folder, const std::string& text,
                    const std::function<void(const std::string&)>& say);

/// What `crackle run` keeps beside the state of a run in field time.
struct FieldTimeMemory {
  TallyMemory tally;
  double mass_residual_max = 0.0;  ///< [-]
  double next_frame = 0.0;         ///< [s]
  double wall = 0.0;               ///< over all processes of the run [s]
  FolderMarks folder;
  std::vector<SeismicEvent> events;  ///< so far
};

/// The same two for a run in field time.
std::string pack_field_time(const Mesh& mesh, quasi_static::State state, FieldTimeMemory memory,
                            const std::string& text);
/// @return false where there is no checkpoint yet
bool take_up_field_time(RunFolder& folder, const std::string& text,
                        const std::function<void(const std::string&)>& say, Mesh& mesh,
                        quasi_static::State& state, FieldTimeMemory& memory);

}  // namespace crackle
