// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include <filesystem>
#include <system_error>

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

}  // namespace

RunFolder::RunFolder(const std::string& path) : path_(path.empty() ? "." : path) {
  create_folder(path_);
  refuse_other_run(path_);
  // also the proof that files can be made here, before minutes are spent on a mesh
  log_ = std::make_unique<AppendedFile>(file("run.log"), AppendedFile::Mode::extend);
}

RunFolder::~RunFolder() = default;

std::string RunFolder::file(const std::string& name) const { return (fs::path(path_) / name).string(); }

void RunFolder::start() {
  if (events_ != nullptr) return;
  refuse_other_run(path_);
  history_ = std::make_unique<AppendedFile>(file("history.csv"), AppendedFile::Mode::create);
  history_->append(history_header());
  events_ = std::make_unique<AppendedFile>(file("events.csv"), AppendedFile::Mode::create);
  events_->append(events_header());
}

void RunFolder::write_resolved(const Case& scene) {
  const std::string text = resolved_toml(scene);
  start();
  write_whole_file(file("resolved.toml"), text);
}

void RunFolder::append_history(const HistoryRow& row) {
  start();
  history_->append(history_line(row));
}

void RunFolder::append_event(const SeismicEvent& event) {
  start();
  events_->append(event_line(event));
}

void RunFolder::write_frame(const FieldFrame& fields, const FractureFrame& fractures) {
  start();
  create_folder(file("fields"));
  create_folder(file("fractures"));
  const std::size_t frame = frame_times_.size();
  const auto name = [](const char* kind, std::size_t i) {
    return fmt::format("{0}/{0}_{1:06}.vtu", kind, i);
  };
  write_vtu(file(name("fields", frame)), fields);
  write_vtu(file(name("fractures", frame)), fractures);
  frame_times_.push_back(fields.time);

  for (const char* kind : {"fields", "fractures"}) {
    std::vector<PvdEntry> entries;
    for (std::size_t i = 0; i < frame_times_.size(); ++i) entries.push_back({frame_times_[i], name(kind, i)});
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
  if (events_ == nullptr) refuse_other_run(path_);
  write_whole_file(file("status.json"), status_json(status));
}

void RunFolder::log(const std::string& line) { log_->append(wall_clock() + " " + line + "\n"); }

}  // namespace crackle
