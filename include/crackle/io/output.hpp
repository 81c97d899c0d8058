// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "crackle/core/errors.hpp"
#include "crackle/core/vec2.hpp"
#include "crackle/io/case.hpp"
#include "crackle/seismic/event.hpp"

namespace crackle {

/// What a load did since the row before.
struct LoadRow {
  Vec2 force;         ///< on the body [N/m]: mean over the time
  Vec2 displacement;  ///< [m]
};

/// One row of history.csv; the column names there are these with their units.
struct HistoryRow {
  double time = 0.0;            ///< [s]
  double time_step = 0.0;       ///< [s]
  double pressure = 0.0;        ///< in the wellbore [Pa]
  double injection_rate = 0.0;  ///< [m2/s]
  double injected = 0.0;        ///< volume at reference density [m2]
  double cavity_volume = 0.0;   ///< [m2]
  double wetted_length = 0.0;   ///< of wetted fractures, one side [m]
  std::int64_t broken_tensile = 0, broken_shear = 0, broken_mixed = 0;
  double energy_kinetic = 0.0, energy_strain = 0.0, energy_cohesive = 0.0, energy_fracture = 0.0,
         energy_friction = 0.0, energy_viscous = 0.0, energy_fluid = 0.0;  ///< [J/m]
  double work_external = 0.0;                                              ///< [J/m]
  double energy_inserted = 0.0, energy_path = 0.0;  ///< given by insertion, by the elastic branch [J/m]
  double energy_residual = 0.0;                     ///< [-]
  std::vector<LoadRow> loads;                       ///< one each
};

/// One row of history.csv of a run in field time. Volumes and rates of the plane are per metre of height
/// and of both wings together.
struct FieldTimeRow {
  double time = 0.0;                                     ///< [s]
  double time_step = 0.0;                                ///< [s]
  double pressure = 0.0;                                 ///< in the well [Pa]
  double rate = 0.0;                                     ///< pumped, of the whole height [m3/s]
  double perforation_rate = 0.0;                         ///< into the fracture [m2/s]
  double fracture_pressure = 0.0, least_pressure = 0.0;  ///< at the well, anywhere [Pa]
  double injected = 0.0, well_stored = 0.0, fracture_volume = 0.0, leaked = 0.0;  ///< [m2]
  double mass_defect = 0.0;                          ///< of the balance of these [m2]
  double broken_length = 0.0, damaged_length = 0.0;  ///< of one wing [m]
  double half_length = 0.0;  ///< of the crack without cohesion that opens as this one does [m]
  double opening = 0.0, mean_opening = 0.0;  ///< at the well, of the whole [m]
  double contact_fraction = 0.0;             ///< of the faces [-]
  double closure_stress = 0.0;               ///< total compression across the fracture [Pa]
  double work_pump = 0.0, energy_well = 0.0, energy_entry = 0.0, energy_viscous = 0.0, energy_leaked = 0.0,
         energy_fluid = 0.0, energy_strain = 0.0, energy_confinement = 0.0, energy_faces = 0.0,
         energy_fracture = 0.0, energy_friction = 0.0, energy_radiated = 0.0;  ///< [J/m]
  double energy_residual = 0.0;                                                ///< [-]
  int iterations = 0;                                                          ///< of Newton
};

/// A named value per triangle or per fracture segment; components = 1, 2 or 3 (xx, yy, xy).
struct Field {
  std::string name;  ///< with its unit, e.g. "stress_Pa"
  int components = 1;
  std::vector<float> values;  ///< seven digits, for half the memory and two thirds of the file

  void add(double value) { values.push_back(static_cast<float>(value)); }
};

/// What one frame of fields/*.vtu shows. Where rock has come apart there are several points at a place, so
/// that fractures are seen as gaps.
struct FieldFrame {
  double time = 0.0;                            ///< [s]
  std::vector<Vec2> points;                     ///< reference position + displacement [m]
  std::vector<std::array<Index, 3>> triangles;  ///< indices into points
  std::vector<Field> point_fields;              ///< e.g. displacement_m, velocity_m_s
  std::vector<Field> cell_fields;               ///< e.g. stress_Pa
};

/// What one frame of fractures/*.vtu shows: yielding and broken cohesive elements as lines.
struct FractureFrame {
  double time = 0.0;  ///< [s]
  std::vector<Vec2> points;
  std::vector<std::array<Index, 2>> lines;
  std::vector<Field> cell_fields;  ///< opening_m, slip_m, damage, mode, pressure_Pa, broken
};

/// Values of summary.json.
struct RunSummary {
  double breakdown_pressure = 0.0;    ///< largest wellbore pressure [Pa]
  double breakdown_time = 0.0;        ///< [s]
  double propagation_pressure = 0.0;  ///< mean over the last tenth of the run [Pa]
  double final_pressure = 0.0;        ///< of the wellbore in the last step [Pa]
  double broken_length = 0.0;         ///< [m]
  double extent_x = 0.0;              ///< of the broken elements [m]
  double extent_y = 0.0;              ///< [m]
  double energy_residual_max = 0.0;   ///< [-]
  double energy_inserted = std::numeric_limits<double>::quiet_NaN();  ///< as in HistoryRow; not in field time
  double energy_path = std::numeric_limits<double>::quiet_NaN();
  double mass_residual_max =
      std::numeric_limits<double>::quiet_NaN();  ///< over the injected [-]; in field time
  std::int64_t triangles = 0;
  std::int64_t steps = 0;
  double wall = 0.0;  ///< [s]
  double core_ns_per_triangle_step = 0.0;
  std::int64_t events = 0;
  double magnitude_min = 0.0;  ///< NaN without events (written as null)
  double magnitude_max = 0.0;
  std::int64_t alarms = 0;        ///< of the guards, that stop a run unless that is allowed to be unstable
  bool unstable_allowed = false;  ///< crackle run --allow-unstable
  std::string exit = "done";      ///< "done", "interrupted" or the reason of a numerical stop
};

/// What status.json says of a run while it goes on and after it.
struct RunStatus {
  /// "preparing" (mesh, geostatic stage), "running", "done", "interrupted" or "failed". A run that was
  /// killed still says "preparing" or "running": see whether its process lives.
  std::string state = "preparing";
  std::string reason;     ///< why it failed; empty otherwise
  double time = 0.0;      ///< simulated [s]
  double end_time = 0.0;  ///< simulated, at the end [s]
  std::int64_t step = 0;
  std::int64_t broken = 0;  ///< elements
  double wall = 0.0;        ///< since the start [s]
  double wall_left = 0.0;   ///< estimate [s]; NaN where there is none yet (written as null)
};

/// How far the growing files of a run folder have come; goes into a checkpoint.
struct FolderMarks {
  std::int64_t history_bytes = 0;   ///< of history.csv
  std::int64_t events_bytes = 0;    ///< of events.csv
  std::vector<double> frame_times;  ///< of the frames in fields.pvd and fractures.pvd [s]
};

/// A checkpoint of a run folder.
struct StoredCheckpoint {
  std::string path;
  std::string bytes;
  std::int64_t step = 0;  ///< of the run
  std::string program;    ///< version of crackle that wrote it
};

class AppendedFile;

/// The folder of one run: every file that crackle writes goes through here. Files are written
/// beside and renamed, or appended and flushed, so that what is there can always be read.
///
/// The constructor only makes the folder and run.log; a folder counts as holding a run once
/// anything else is written. A case that fails before its first result (in the mesher, say) so
/// leaves a folder that can be used again. Not thread-safe.
///
/// As long as it lives no other process gets the folder (run.log is locked).
class RunFolder {
 public:
  enum class Use {
    begin,   ///< a new run
    resume,  ///< one that was interrupted
  };
  /// Creates the folder (and parents), or opens that of a run to resume. @throws CaseError when it
  /// cannot be written, another process runs in it, or it already holds a run (to begin) or none (to
  /// resume); nothing there is touched then.
  explicit RunFolder(const std::string& path, Use use = Use::begin);
  ~RunFolder();
  RunFolder(const RunFolder&) = delete;
  RunFolder& operator=(const RunFolder&) = delete;

  const std::string& path() const { return path_; }
  /// resolved.toml. Like every other write here: @throws CaseError with the file and the reason
  /// (disk full, no permission).
  void write_resolved(const Case& scene);
  /// Names of the loads, which get columns: before anything is written.
  void set_loads(std::vector<std::string> names) { loads_ = std::move(names); }
  /// Appends to history.csv.
  void append_history(const HistoryRow& row);
  /// The run is one in field time: before anything of it is written.
  void set_field_time() { field_time_ = true; }
  void append_field_time(const FieldTimeRow& row);
  /// Appends to events.csv.
  void append_event(const SeismicEvent& event);
  /// Writes fields/fields_NNNNNN.vtu and fractures/fractures_NNNNNN.vtu, counted from 0, and renews
  /// fields.pvd and fractures.pvd.
  void write_frame(FieldFrame fields, const FractureFrame& fractures);
  /// events.xml, QuakeML 1.2.
  void write_quakeml(const std::vector<SeismicEvent>& events, const Case& scene);
  void write_summary(const RunSummary& summary);
  /// Renews status.json, with the wall-clock time, host and process. Does not yet make the folder hold a
  /// run.
  void write_status(const RunStatus& status);
  /// Writes checkpoint_a.h5 or checkpoint_b.h5, over the older of them.
  void write_checkpoint(const std::string& bytes);
  /// Those of its checkpoints that are whole, the newest first; `refused` gets a line for any other.
  std::vector<StoredCheckpoint> checkpoints(std::vector<std::string>& refused) const;
  /// Once the run has come to its end.
  void remove_checkpoints();
  /// Whether the run came to its end time.
  bool is_done() const;
  /// Brings the growing files to the disk; says how far they are.
  FolderMarks marks();
  /// Cuts the growing files back to where they were, and takes away what was written at an earlier end.
  /// @param used the checkpoint that the run goes on from; the next one is written over the other
  /// @throws CaseError when a file is not as long as it was then
  void go_back(const FolderMarks& marks, const std::string& used);
  /// Adds a line with the wall-clock time (UTC) to run.log.
  void log(const std::string& line);

 private:
  std::string file(const std::string& name) const;
  /// Opens history.csv and events.csv, which must not be there yet.
  void start();
  void open_tables();
  void write_headers();
  void write_pvd();

  std::string path_;
  Use use_;
  bool field_time_ = false;
  std::vector<std::string> loads_;
  std::unique_ptr<AppendedFile> history_;
  std::unique_ptr<AppendedFile> events_;
  std::unique_ptr<AppendedFile> log_;
  std::vector<double> frame_times_;  ///< [s]
  std::size_t next_checkpoint_ = 0;
};

/// Writes an unstructured grid of triangles to a .vtu file (`crackle mesh -o FILE.vtu` and frames).
/// A field with 2 components becomes a vector with z = 0, so that ParaView shows it as one.
/// @throws CaseError when the file cannot be written, std::invalid_argument when a field has not one
/// value a point or cell.
void write_vtu(const std::string& path, FieldFrame frame);
/// Writes lines to a .vtu file. Without any line it holds one of no length at the origin with every
/// value zero, because meshio cannot read a grid without cells.
void write_vtu(const std::string& path, const FractureFrame& frame);

/// Events of a finished run, from its folder or from the path of an events.csv. @throws CaseError
/// naming file and line when something there is not a row of that file
std::vector<SeismicEvent> read_events_csv(const std::string& path);
/// The catalog in a format: "csv", "quakeml" (1.2) or "zmap" (10 tab-separated columns: longitude,
/// latitude, decimal year, month, day, magnitude, depth [km], hour, minute, second).
/// @throws CaseError on another format, or on an epoch that is not a time
std::string catalog_text(const std::vector<SeismicEvent>& events, const Case& scene,
                         const std::string& format);

}  // namespace crackle
