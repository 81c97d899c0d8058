// SPDX-License-Identifier: GPL-3.0-or-later
#include "checkpoint.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <iterator>
#include <sstream>
#include <vector>

#include "crackle/core/errors.hpp"
#include "crackle/core/version.hpp"
#include "crackle/io/checkpoint.hpp"
#include "crackle/solve/members.hpp"

namespace crackle {

template <class V>
void members(MomentTensor& m, V&& v) {
  v("xx", m.xx);
  v("yy", m.yy);
  v("zz", m.zz);
  v("xy", m.xy);
}

template <class V>
void members(SeismicEvent& e, V&& v) {
  v("time", e.time);
  v("duration", e.duration);
  v("place", e.place);
  v("kind", e.kind);
  v("mode", e.mode);
  v("energy", e.energy);
  v("magnitude", e.magnitude);
  v("fracture_energy", e.fracture_energy);
  v("friction_energy", e.friction_energy);
  v("length", e.length);
  v("opening", e.opening);
  v("slip", e.slip);
  v("stress_drop", e.stress_drop);
  v("moment", e.moment);
  v("moment_magnitude", e.moment_magnitude);
  v("edge", e.edge);
  v("edges", e.edges);
}

template <class V>
void members(TallyMemory& m, V&& v) {
  v("breakdown_pressure", m.breakdown_pressure);
  v("breakdown_time", m.breakdown_time);
  v("energy_residual_max", m.energy_residual_max);
  v("steps", m.steps);
  v("late_sum", m.late_sum);
  v("late_time", m.late_time);
  v("final_pressure", m.final_pressure);
}

template <class V>
void members(FolderMarks& m, V&& v) {
  v("history_bytes", m.history_bytes);
  v("events_bytes", m.events_bytes);
  v("frame_times", m.frame_times);
}

template <class V>
void members(RunMemory& m, V&& v) {
  v("step_length", m.step_length);
  v("tally", m.tally);
  v("next_history", m.next_history);
  v("next_fields", m.next_fields);
  v("wall", m.wall);
  v("loop_wall", m.loop_wall);
  v("output_wall", m.output_wall);
  v("parts", m.parts);
  v("guards", m.guards);
  v("folder", m.folder);
  v("events", m.events);
}

template <class V>
void members(FieldTimeMemory& m, V&& v) {
  v("tally", m.tally);
  v("mass_residual_max", m.mass_residual_max);
  v("next_frame", m.next_frame);
  v("wall", m.wall);
  v("folder", m.folder);
  v("events", m.events);
}

namespace {

std::vector<Column> run_columns(Mesh& mesh, State& state, SimulationMemory& simulation, RunMemory& run) {
  std::vector<Column> all;
  for (auto&& columns : {columns_of(mesh, "mesh"), columns_of(state, "state"),
                         columns_of(simulation, "simulation"), columns_of(run, "run")}) {
    all.insert(all.end(), columns.begin(), columns.end());
  }
  return all;
}

// A case as text but for its comments, which name the version of crackle.
std::string without_comments(const std::string& text) {
  std::istringstream lines(text);
  std::string kept;
  for (std::string line; std::getline(lines, line);) {
    if (!line.starts_with('#')) kept += line + '\n';
  }
  return kept;
}

std::vector<Column> field_time_columns(Mesh& mesh, quasi_static::State& state, FieldTimeMemory& memory) {
  std::vector<Column> all;
  for (auto&& columns : {columns_of(mesh, "mesh"), columns_of(state, "state"), columns_of(memory, "run")})
    all.insert(all.end(), columns.begin(), columns.end());
  return all;
}

// Reads the newest checkpoint that can be read into the columns; marks and time are among them.
bool read_newest(RunFolder& folder, const std::string& text,
                 const std::function<void(const std::string&)>& say, const std::vector<Column>& columns,
                 const FolderMarks& marks, const double& time) {
  std::vector<std::string> refused;
  for (const StoredCheckpoint& stored : folder.checkpoints(refused)) {
    try {
      const std::string its_text = unpack_checkpoint(stored.bytes, stored.path, columns);
      if (without_comments(its_text) != without_comments(text))
        throw CaseError(stored.path + ": it is of another case than resolved.toml");
      folder.go_back(marks, stored.path);
      for (const std::string& line : refused) say("note: " + line);
      say(fmt::format("resumed from {}: step {}, time {:.6g} s",
                      std::filesystem::path(stored.path).filename().string(), stored.step, time));
      if (stored.program != version) {
        say(
            fmt::format("note: crackle {} wrote it and {} goes on: the last bits may differ from those of an "
                        "uninterrupted run",
                        stored.program, version));
      }
      return true;
    } catch (const CaseError& error) {
      refused.emplace_back(error.what());
    }
  }
  if (!refused.empty())
    throw CaseError(fmt::format("no checkpoint can be used: {}", fmt::join(refused, "; ")));
  say("there is no checkpoint yet: the run begins anew");
  folder.go_back({}, "");
  return false;
}

}  // namespace

std::string pack_run(Simulation& simulation, RunMemory& memory, const std::string& text) {
  State& state = simulation.state();
  SimulationMemory kept = simulation.memory();
  // Columns can be written through, which is not done here.
  Mesh& mesh = const_cast<Mesh&>(*state.mesh);  // NOLINT(cppcoreguidelines-pro-type-const-cast)
  return pack_checkpoint({version, state.step, state.time}, run_columns(mesh, state, kept, memory), text);
}

RunSnapshot take_up(RunFolder& folder, const std::string& text,
                    const std::function<void(const std::string&)>& say) {
  RunSnapshot run;
  run.mesh = std::make_shared<Mesh>();
  const auto columns = run_columns(*run.mesh, run.state, run.simulation, run.run);
  if (!read_newest(folder, text, say, columns, run.run.folder, run.state.time)) return {};
  run.state.mesh = run.mesh;
  return run;
}

std::string pack_field_time(const Mesh& mesh, quasi_static::State state, FieldTimeMemory memory,
                            const std::string& text) {
  Mesh& read = const_cast<Mesh&>(mesh);  // NOLINT(cppcoreguidelines-pro-type-const-cast): as in pack_run()
  return pack_checkpoint({version, memory.tally.steps, state.time}, field_time_columns(read, state, memory),
                         text);
}

bool take_up_field_time(RunFolder& folder, const std::string& text,
                        const std::function<void(const std::string&)>& say, Mesh& mesh,
                        quasi_static::State& state, FieldTimeMemory& memory) {
  return read_newest(folder, text, say, field_time_columns(mesh, state, memory), memory.folder, state.time);
}

}  // namespace crackle
