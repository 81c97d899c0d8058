// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <system_error>
#include <utility>

#include "crackle/io/checkpoint.hpp"
#include "crackle/io/output.hpp"
#include "events_csv.hpp"
#include "file.hpp"
#include "history_csv.hpp"
#include "pvd.hpp"
#include "status_json.hpp"
#include "summary_json.hpp"
#include "utc_time.hpp"

namespace crackle {

namespace fs = std::filesystem;

namespace {

[[noreturn]] void refuse(const std::string& path, const std::string& why) {
  throw CaseError(path + ": " + why + "; give another folder with -o DIR");
}

void create_folder(const std::string& path) {
  std::error_code reason;
  fs::create_directories(path, reason);
  std::error_code ignored;
  if (fs::is_directory(path, ignored)) return;
  if (fs::exists(path, ignored)) refuse(path, "the output folder is a file");
  refuse(path, "cannot create the output folder: " + reason.message());
}

void refuse_other_run(const std::string& path) {
  for (const char* name : {"resolved.toml", "history.csv", "events.csv", "summary.json", "fields.pvd"}) {
    std::error_code ignored;
    if (!fs::exists(fs::path(path) / name, ignored)) continue;
    refuse(path, fmt::format("the output folder already holds a run ({} is there) and nothing is overwritten",
                             name));
  }
}

void require_run(const std::string& path) {
  std::error_code ignored;
  if (!fs::exists(fs::path(path) / "resolved.toml", ignored))
    throw CaseError(path + ": there is no run to resume (no resolved.toml)");
}

std::string frame_name(const char* kind, std::size_t frame) {
  return fmt::format("{0}/{0}_{1:06}.vtu", kind, frame);
}

// What a process that was killed was writing.
void remove_unfinished(const std::string& path) {
  std::vector<fs::path> unfinished;
  for (const char* folder : {"", "fields", "fractures"}) {
    std::error_code ignored;
    for (const fs::directory_entry& entry : fs::directory_iterator(fs::path(path) / folder, ignored)) {
      if (entry.path().extension() == ".tmp") unfinished.push_back(entry.path());
    }
  }
  for (const fs::path& file : unfinished) {
    std::error_code ignored;
    fs::remove(file, ignored);
  }
}

constexpr std::array<const char*, 2> checkpoint_names{"checkpoint_a.h5", "checkpoint_b.h5"};

}  // namespace

RunFolder::RunFolder(const std::string& path, Use use) : path_(path.empty() ? "." : path), use_(use) {
  const auto require = use == Use::resume ? require_run : refuse_other_run;
  if (use == Use::begin) create_folder(path_);
  std::error_code ignored;
  if (!fs::exists(file("run.log"), ignored)) require(path_);  // makes nothing in a folder that is refused
  // also the proof that files can be made here, before minutes are spent on a mesh
  log_ = std::make_unique<AppendedFile>(file("run.log"), AppendedFile::Mode::extend);
  if (!log_->lock()) throw CaseError(path_ + ": another crackle is running in this folder");
  require(path_);
  if (use == Use::resume) remove_unfinished(path_);
}

RunFolder::~RunFolder() = default;

std::string RunFolder::file(const std::string& name) const { return (fs::path(path_) / name).string(); }

void RunFolder::start() {
  if (events_ != nullptr) return;
  refuse_other_run(path_);
  open_tables();
}

void RunFolder::open_tables() {
  history_ = std::make_unique<AppendedFile>(file("history.csv"), AppendedFile::Mode::create);
  events_ = std::make_unique<AppendedFile>(file("events.csv"), AppendedFile::Mode::create);
  write_headers();
}

void RunFolder::write_headers() {
  history_->append(field_time_ ? field_time_header() : history_header(loads_));
  events_->append(events_header());
}

void RunFolder::write_resolved(const Case& scene) {
  const std::string text = resolved_toml(scene);
  if (events_ == nullptr) refuse_other_run(path_);
  write_whole_file(file("resolved.toml"), text);  // first: with it alone the run can be resumed
  if (events_ == nullptr) open_tables();
}

void RunFolder::append_history(const HistoryRow& row) {
  start();
  history_->append(history_line(row));
}

void RunFolder::append_field_time(const FieldTimeRow& row) {
  start();
  history_->append(field_time_line(row));
}

void RunFolder::append_event(const SeismicEvent& event) {
  start();
  events_->append(event_line(event));
}

void RunFolder::write_frame(FieldFrame fields, const FractureFrame& fractures) {
  start();
  for (const char* kind : {"fields", "fractures"}) {
    std::error_code reason;
    fs::create_directory(file(kind), reason);  // not the run folder: it must not come back unnoticed
    if (!fs::is_directory(file(kind))) throw_file_error(file(kind), "create the folder", reason.value());
  }
  const std::size_t frame = frame_times_.size();
  const double time = fields.time;
  write_vtu(file(frame_name("fields", frame)), std::move(fields));
  write_vtu(file(frame_name("fractures", frame)), fractures);
  frame_times_.push_back(time);
  write_pvd();
}

void RunFolder::write_pvd() {
  for (const char* kind : {"fields", "fractures"}) {
    std::vector<PvdEntry> entries;
    for (std::size_t i = 0; i < frame_times_.size(); ++i)
      entries.push_back({frame_times_[i], frame_name(kind, i)});
    write_whole_file(file(std::string(kind) + ".pvd"), pvd_text(entries));
  }
}

void RunFolder::write_quakeml(const std::vector<SeismicEvent>& events, const Case& scene) {
  const std::string text = catalog_text(events, scene, "quakeml");
  start();
  write_whole_file(file("events.xml"), text);
}

void RunFolder::write_summary(const RunSummary& summary) {
  start();
  write_whole_file(file("summary.json"), summary_json(summary));
}

void RunFolder::write_status(const RunStatus& status) {
  if (events_ == nullptr && use_ == Use::begin) refuse_other_run(path_);
  write_whole_file(file("status.json"), status_json(status));
}

void RunFolder::write_checkpoint(const std::string& bytes) {
  write_durable_file(file(checkpoint_names[next_checkpoint_]), bytes);
  next_checkpoint_ = 1 - next_checkpoint_;
}

std::vector<StoredCheckpoint> RunFolder::checkpoints(std::vector<std::string>& refused) const {
  std::vector<StoredCheckpoint> found;
  for (const char* name : checkpoint_names) {
    std::error_code ignored;
    if (!fs::exists(file(name), ignored)) continue;
    try {
      StoredCheckpoint checkpoint{file(name), read_whole_file(file(name)), 0, ""};
      const CheckpointHead head = checkpoint_head(checkpoint.bytes, checkpoint.path);
      checkpoint.step = head.step;
      checkpoint.program = head.program;
      found.push_back(std::move(checkpoint));
    } catch (const CaseError& error) {
      refused.emplace_back(error.what());
    }
  }
  std::sort(found.begin(), found.end(),
            [](const StoredCheckpoint& a, const StoredCheckpoint& b) { return a.step > b.step; });
  return found;
}

void RunFolder::remove_checkpoints() {
  for (const char* name : checkpoint_names) {
    std::error_code ignored;
    fs::remove(file(name), ignored);
  }
}

bool RunFolder::is_done() const {
  std::error_code ignored;
  const std::string summary = file("summary.json");
  return fs::exists(summary, ignored) &&
         read_whole_file(summary).find("\"exit\": \"done\"") != std::string::npos;
}

FolderMarks RunFolder::marks() {
  start();
  history_->sync();
  events_->sync();
  return {history_->size(), events_->size(), frame_times_};
}

void RunFolder::go_back(const FolderMarks& marks, const std::string& used) {
  using Mode = AppendedFile::Mode;
  auto history = std::make_unique<AppendedFile>(file("history.csv"), Mode::extend);
  auto events = std::make_unique<AppendedFile>(file("events.csv"), Mode::extend);
  if (history->size() < marks.history_bytes || events->size() < marks.events_bytes) {
    throw CaseError(fmt::format("{}: history.csv or events.csv is shorter than when {} was written", path_,
                                fs::path(used).filename().string()));
  }
  history->cut(marks.history_bytes);
  events->cut(marks.events_bytes);
  history_ = std::move(history);
  events_ = std::move(events);
  if (marks.history_bytes == 0) write_headers();
  frame_times_ = marks.frame_times;
  write_pvd();
  next_checkpoint_ = fs::path(used).filename() == checkpoint_names[0] ? 1 : 0;
  for (const char* name : {"summary.json", "events.xml"}) {
    std::error_code ignored;
    fs::remove(file(name), ignored);
  }
}

void RunFolder::log(const std::string& line) { log_->append(wall_clock() + " " + line + "\n"); }

}  // namespace crackle
