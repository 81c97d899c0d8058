// SPDX-License-Identifier: GPL-3.0-or-later
// A run that never was: two wings and a side branch grow from a wellbore in a polar mesh. Enough like
// the real thing to try the files and the figures on.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "crackle/io/output.hpp"

namespace crackle::test {

/// A folder of its own for one test, removed when it ends.
class ScratchFolder {
 public:
  ScratchFolder();
  ~ScratchFolder();
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;
  std::string operator/(const std::string& name) const { return (path_ / name).string(); }

 private:
  std::filesystem::path path_;
};

std::string content(const std::string& path);

struct SampleSize {
  int segments = 24;  ///< edges round the wellbore
  int rings = 12;
};

Case sample_case();
FieldFrame sample_fields(double time, SampleSize size = {});
FractureFrame sample_fractures(double time, SampleSize size = {});
std::vector<SeismicEvent> sample_events(double time, SampleSize size = {});
HistoryRow sample_history(double time);

/// Writes a run of some frames up to a time; `finished` adds the catalog and the summary.
void write_sample_run(const std::string& folder, int frames, double end_time, bool finished,
                      SampleSize size = {});

}  // namespace crackle::test
