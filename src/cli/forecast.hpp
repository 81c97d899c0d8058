// SPDX-License-Identifier: GPL-3.0-or-later
//
// What a run will take: memory, disk, time. Sizes of arrays are counted; what libraries allocate is
// measured once and written down beside its constant.
#pragma once

#include <cstdint>
#include <string>

#include "crackle/io/case.hpp"
#include "crackle/solve/simulation.hpp"

namespace crackle {

/// Steps that a run takes and their length. @throws CaseError when run.time_step is not stable, or when
/// they are more than anybody can wait for
struct Steps {
  std::int64_t count = 0;
  double length = 0.0;  ///< [s]
  /// Those that are left at a time [s].
  std::int64_t after(double time) const { return count - static_cast<std::int64_t>(time / length + 1e-9); }
};
/// @param allow_unstable any run.time_step
Steps steps_of_run(const Case& scene, const StableStep& stable, const Mesh& mesh,
                   bool allow_unstable = false);

/// Largest memory of a run on a mesh of that many triangles [bytes], in field time too.
struct RunMemoryUse {
  double run = 0.0;
  double checkpoint = 0.0;  ///< with checkpoints
};
RunMemoryUse memory_of_run(const Case& scene, double triangles);

/// What a run writes.
struct RunOutput {
  double bytes = 0.0;       ///< all frames and other files, but for what breaks
  std::int64_t frames = 0;  ///< of fields
};
/// Not more than one frame a step.
RunOutput output_of_run(const Case& scene, double triangles, const Steps& steps);
/// In field time, whose steps nobody knows beforehand.
RunOutput output_of_field_time(const Case& scene, double triangles);

/// "24 MB of memory, 46 MB while a checkpoint is written; 19 MB of output in 21 frames"
std::string needs_text(const Case& scene, double triangles, const RunOutput& output);

/// Memory that this process may still take [bytes], by /proc/meminfo, control group and ulimit;
/// infinity where none of them says.
double available_memory();

/// @throws CaseError when a run on the case's mesh would not fit in memory. Nothing is made: the
/// number of triangles is estimated from the recipe. A mesh file is not looked into.
void require_memory(const Case& scene);
/// The same once the number of triangles is known.
void require_memory(const Case& scene, Index triangles);

/// @throws CaseError when its output is more than output.max_bytes, or with its checkpoints would not fit on
/// the disk that a folder is on
void require_disk(const Case& scene, double triangles, const RunOutput& output, const std::string& folder);

/// Stable step of a scene at rest, without its static solve.
StableStep stable_step_of(const Scene& scene);

/// Wall time of the parts of a run.
struct WallTime {
  double core_ns = 0.0;    ///< per triangle and step of rock that is whole: a few steps of it on this machine
  bool simulated = false;  ///< with all else there is in a step, and the geostatic stage is timed too
  double ramp_end = 0.0;   ///< of what static solves do without steps [s of the run]; 0: no ramp
  std::int64_t count = 0;  ///< of the steps
  bool breaks = false;     ///< their time is that of a run with fractures
  double start = 0.0;      ///< geostatic stage [s]
  double steps = 0.0;      ///< [s]
  double output = 0.0;     ///< [s]
  double total() const { return start + steps + output; }
};
WallTime wall_time_of_run(const Case& scene, const Scene& solver_scene, const Steps& steps, int threads);

/// Largest mesh [triangles] whose static solves wall_time_of_run() does; above, it extrapolates them.
inline constexpr Index largest_solved_mesh = 150000;

/// "1.2 GB", "35 s", "2 h 05 min": for people.
std::string bytes_text(double bytes);
std::string duration_text(double seconds);

}  // namespace crackle
