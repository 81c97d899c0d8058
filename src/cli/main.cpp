// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <exception>

#include "commands.hpp"
#include "crackle/core/errors.hpp"
#include "crackle/core/version.hpp"

int main(int argc, char** argv) {
  CLI::App app{"crackle: hydraulic fracturing of rock in 2D by finite-discrete elements", "crackle"};
  app.set_version_flag("--version", std::string("crackle ") + crackle::version);
  app.require_subcommand(1);
  int code = 0;

  crackle::RunOptions run;
  auto* run_app = app.add_subcommand("run", "Run a case");
  run_app->add_option("case", run.case_file, "Case file (.toml)")->required();
  run_app->add_option("-o,--output", run.output, "Run folder (default runs/<case name>)");
  run_app->add_option("--set", run.overrides, "Override a value of the case: table.key=value");
  run_app->add_option("-j,--threads", run.threads, "Threads (default: all cores)")->check(CLI::PositiveNumber);
  run_app->add_option("--seed", run.seed, "Seed of the mesh");
  run_app->add_flag("-q,--quiet", run.quiet, "Print errors only");
  run_app->callback([&] { code = crackle::run_command(run); });

  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    const int status = app.exit(error);
    return status == 0 ? 0 : static_cast<int>(crackle::ExitCode::bad_case);
  } catch (const crackle::Error& error) {
    fmt::print(stderr, "crackle: {}\n", error.what());
    return static_cast<int>(error.code());
  } catch (const std::exception& error) {
    fmt::print(stderr, "crackle: {}\n", error.what());
    return 1;
  }
  return code;
}
