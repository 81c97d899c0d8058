// SPDX-License-Identifier: GPL-3.0-or-later
//
// `crackle run`: a case from its file to its run folder.
#include <filesystem>

#include "commands.hpp"
#include "crackle/core/errors.hpp"
#include "crackle/io/case.hpp"
#include "crackle/io/output.hpp"
#include "forecast.hpp"
#include "load.hpp"
#include "progress.hpp"
#include "regime.hpp"
#include "run_dynamic.hpp"
#include "run_quasi_static.hpp"
#include "signals.hpp"
#include "status.hpp"

namespace crackle {
namespace {

int run_in_folder(const RunOptions& options, const Case& scene, RunFolder& folder) {
  Status status(folder, scene.run.end_time);
  const RegimeChoice regime = choose_regime(scene);
  for (const std::string& reason : regime.reasons) {
    folder.log(reason);
    if (!options.quiet) print_line(reason);
  }
  try {
    const int code = regime.quasi_static ? run_quasi_static(options, regime.scene, folder, status)
                                         : run_dynamic(options, regime.scene, folder, status);
    status.finish(code == 0 ? "done" : "interrupted");
    return code;
  } catch (const std::exception& error) {
    try {
      status.finish("failed", error.what());
    } catch (const CaseError&) {  // what went wrong first is what the user has to know
    }
    throw;
  }
}

int resume_command(const RunOptions& options) {
  RunFolder folder(options.resume, RunFolder::Use::resume);
  if (folder.is_done()) {
    if (!options.quiet) print_line(options.resume + ": the run is done, there is nothing to resume");
    return 0;
  }
  const Case scene = load_case((std::filesystem::path(options.resume) / "resolved.toml").string(), {}, {});
  return run_in_folder(options, scene, folder);
}

}  // namespace

int run_command(const RunOptions& options) {
  heed_signals();
  if (!options.resume.empty()) return resume_command(options);
  const Case scene = load_case(options.case_file, options.overrides, options.seed);
  require_memory(choose_regime(scene).scene);
  const std::string path =
      options.output.empty()
          ? (std::filesystem::path("runs") / std::filesystem::path(options.case_file).stem()).string()
          : options.output;
  RunFolder folder(path);
  return run_in_folder(options, scene, folder);
}

}  // namespace crackle
