// SPDX-License-Identifier: GPL-3.0-or-later
#include <fcntl.h>
#include <fmt/format.h>
#include <malloc.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <new>

#include "commands.hpp"
#include "crackle/core/errors.hpp"
#include "crackle/core/version.hpp"
#include "crackle/io/dfit.hpp"
#include "load.hpp"
#include "progress.hpp"

namespace {

using crackle::CaseOptions;

/// --set takes one value each time, so that a case file may follow it.
void add_overrides(CLI::App& command, std::vector<std::string>& overrides) {
  command.add_option("--set", overrides, "Override a value of the case: --set table.key=value")
      ->allow_extra_args(false)
      ->type_name("KEY=VALUE");
}

void add_case_options(CLI::App& command, CaseOptions& options) {
  command.add_option("case", options.case_file, "Case file (.toml)")->required()->type_name("FILE");
  add_overrides(command, options.overrides);
  command.add_option("--seed", options.seed, "Seed of the mesh")->type_name("N");
}

void add_threads(CLI::App& command, int& threads) {
  command.add_option("-j,--threads", threads, "Threads (default: all cores)")
      ->check(CLI::Range(1, 1024))
      ->type_name("N");
}

/// The command line as CLI11 sees it. Every command's options live as long as this.
class CommandLine {
 public:
  CommandLine() : app_("crackle: hydraulic fracturing of rock in 2D by finite-discrete elements", "crackle") {
    app_.set_version_flag("--version", std::string("crackle ") + crackle::version);
    app_.require_subcommand(1);
    add_run();
    add_check();
    add_mesh();
    add_law();
    add_names();
    add_catalog();
    add_dfit_analyse();
  }

  int run(int argc, char** argv) {
    if (argc < 2) {
      throw crackle::CaseError(
          "say what to do: run, check, mesh, law, list, describe, catalog or dfit-analyse; see crackle "
          "--help");
    }
    try {
      app_.parse(argc, argv);
    } catch (const CLI::Success& wish) {  // --help, --version
      return app_.exit(wish);
    } catch (const CLI::ParseError& error) {
      if (argc > 1 && argv[1][0] != '-') require_command(argv[1]);
      throw crackle::CaseError(one_line(error.what()) + "; see crackle --help");
    }
    return code_;
  }

 private:
  void add_run() {
    auto* command = app_.add_subcommand("run", "Run a case");
    add_case_options(*command, run_);
    command->add_option("-o,--output", run_.output, "Run folder (default: runs/<case name>)")
        ->type_name("DIR");
    auto* resume =
        command
            ->add_option("--resume", run_.resume, "Go on with the interrupted run in DIR, instead of a case")
            ->type_name("DIR");
    command->get_option("case")->required(false);
    for (const char* other : {"case", "--set", "--seed", "--output"})
      resume->excludes(command->get_option(other));
    add_threads(*command, run_.threads);
    command->add_flag("-q,--quiet", run_.quiet, "Print errors only");
    command->add_flag("--allow-unstable", run_.allow_unstable,
                      "Take run.time_step as it is and go on past what the guards find, to study it");
    command->callback([this] {
      if (run_.case_file.empty() && run_.resume.empty()) throw CLI::RequiredError("case");
      code_ = crackle::run_command(run_);
    });
  }
  void add_check() {
    auto* command =
        app_.add_subcommand("check", "Say what a run would be: parameters, mesh, time step, cost, warnings");
    add_case_options(*command, check_);
    add_threads(*command, check_.threads);
    command->callback([this] { code_ = crackle::check_command(check_); });
  }
  void add_mesh() {
    auto* command = app_.add_subcommand("mesh", "Write the mesh of a case");
    add_case_options(*command, mesh_);
    command->add_option("-o,--output", mesh_.output, "FILE.msh (gmsh) or FILE.vtu (ParaView)")
        ->required()
        ->type_name("FILE");
    command->callback([this] { code_ = crackle::mesh_command(mesh_); });
  }
  void add_law() {
    auto* command = app_.add_subcommand("law", "Traction-separation curve of a cohesive law, as CSV");
    command->add_option("name", law_.law, "Cohesive law (see crackle list)")->required()->type_name("LAW");
    command
        ->add_option("--case", law_.case_file,
                     "Case with the rock (default: granite of AbuAisha et al. 2016)")
        ->type_name("FILE");
    add_overrides(*command, law_.overrides);
    command->add_option("--mode", law_.mode, "1 (opening), 2 (sliding) or mixed (default: 1)")
        ->check(CLI::IsMember({"1", "2", "mixed"}))
        ->type_name("MODE");
    command
        ->add_option("--angle", law_.angle,
                     "Direction of mixed motion: 0 opening, 90 deg sliding (default: 45 deg)")
        ->type_name("ANGLE");
    command
        ->add_option("--normal", law_.normal,
                     "Stress across the edge in mode 2, compression negative (default: 0)")
        ->type_name("STRESS");
    command->add_option("--edge", law_.edge, "Length of the edge (default: 3 mm)")->type_name("LENGTH");
    command->add_option("--points", law_.points, "Rows (default: 200)")
        ->check(CLI::Range(2, 1000000))
        ->type_name("N");
    command->callback([this] { code_ = crackle::law_command(law_); });
  }
  void add_names() {
    app_.add_subcommand("list", "Laws, models, generators, fields and formats to choose from")
        ->callback([this] { code_ = crackle::list_command(); });
    auto* command =
        app_.add_subcommand("describe", "A law with formula and parameters; keys of a case or of one table");
    command->add_option("name", name_, "A name of crackle list, a table, a key, or \"case\"")
        ->required()
        ->type_name("NAME");
    command->callback([this] { code_ = crackle::describe_command(name_); });
  }
  void add_catalog() {
    auto* command = app_.add_subcommand("catalog", "Seismic events of a finished run");
    command->add_option("folder", catalog_.folder, "Run folder")->required()->type_name("DIR");
    command->add_option("--to", catalog_.format, "csv, quakeml or zmap (default: a summary)")
        ->type_name("FORMAT");
    command->add_option("-o,--output", catalog_.output, "File (default: the terminal)")->type_name("FILE");
    command->add_flag("--clustered", catalog_.clustered, "Events near in space and time taken as one");
    command
        ->add_option("--radius", catalog_.radius,
                     "Reach of an event to another of its cluster (default: 4 edges)")
        ->type_name("LENGTH");
    command
        ->add_option("--window", catalog_.window, "The same in time (default: radius over shear wave speed)")
        ->type_name("TIME");
    command->add_flag("!--no-figures", catalog_.figures, "Do not draw beside the summary");
    command->callback([this] { code_ = crackle::catalog_command(catalog_); });
  }

  void add_dfit_analyse() {
    auto* command =
        app_.add_subcommand("dfit-analyse", "Picks of a fall-off: ISIP, closure, leak-off, reservoir");
    command->add_option("record", dfit_.record, "Record (a table with a header), or a run folder")
        ->required()
        ->type_name("FILE|RUN_DIR");
    command->add_option("-o,--output", dfit_.output, "Folder (default: RUN_DIR/dfit, or <FILE>_dfit)")
        ->type_name("DIR");
    command->add_option("--time", dfit_.time, "Column of the time (default: time_<unit>)")
        ->type_name("COLUMN[:UNIT]");
    command->add_option("--pressure", dfit_.pressure, "Column of the pressure (default: pressure_<unit>)")
        ->type_name("COLUMN[:UNIT]");
    command
        ->add_option("--rate", dfit_.rate, "Column of the rate (default: rate_<unit>, injection_rate_<unit>)")
        ->type_name("COLUMN[:UNIT]");
    command->add_option("--inputs", dfit_.inputs, "TOML file with keys of --set")->type_name("FILE");
    command->add_option("--set", dfit_.overrides, "What the record does not hold: --set key=value")
        ->allow_extra_args(false)
        ->type_name("KEY=VALUE");
    command->footer("Keys of --set and --inputs:\n" + crackle::dfit_keys_text());
    command->callback([this] { code_ = crackle::dfit_analyse_command(dfit_); });
  }

  void require_command(const std::string& word) const {
    std::vector<std::string> names;
    for (const CLI::App* command : app_.get_subcommands({})) names.push_back(command->get_name());
    if (std::find(names.begin(), names.end(), word) == names.end())
      throw crackle::unknown_name("command", word, names);
  }
  static std::string one_line(std::string text) {
    std::replace(text.begin(), text.end(), '\n', ' ');
    return text;
  }

  CLI::App app_;
  crackle::RunOptions run_;
  crackle::CheckOptions check_;
  crackle::MeshOptions mesh_;
  crackle::LawOptions law_;
  crackle::CatalogOptions catalog_;
  crackle::DfitOptions dfit_;
  std::string name_;
  int code_ = 0;
};

}  // namespace

namespace {

// Threads that wait for one another spin for milliseconds by default, which on a machine that has
// other work to do costs a run with two threads a factor of five. The OpenMP library reads its
// settings before main(), so the program starts itself anew with a short spin; a user's own setting
// is left alone.
void shorten_spinning(char** argv) {
  if (std::getenv("OMP_WAIT_POLICY") != nullptr || std::getenv("GOMP_SPINCOUNT") != nullptr) return;
  setenv("GOMP_SPINCOUNT", "2000", 1);
  execv("/proc/self/exe", argv);  // returns only where it cannot: then as it is
}

// Where standard input, output or error is closed, the next file opened would take its place, and what is
// meant for the terminal would go into that file.
void open_standard_streams() {
  for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) {
    if (fcntl(stream, F_GETFD) < 0) open("/dev/null", O_RDWR);  // NOLINT(cppcoreguidelines-pro-type-vararg)
  }
}

// Large arrays go back to the system when they are done with. By default the C library keeps up to 32 MB of
// each, in holes that what comes later does not fit into: a fifth of the peak of a run with checkpoints.
void return_large_arrays() { mallopt(M_MMAP_THRESHOLD, 1 << 20); }

}  // namespace

int main(int argc, char** argv) {
  open_standard_streams();
  setenv("VTK_SMP_MAX_THREADS", "1", 0);  // else VTK starts threads of its own, one a core, whatever -j says
  shorten_spinning(argv);
  return_large_arrays();
  try {
    const int code = CommandLine().run(argc, argv);
    if (std::fflush(stdout) != 0)
      throw crackle::CaseError(fmt::format("standard output: cannot write: {}", std::strerror(errno)));
    return code;
  } catch (const crackle::Error& error) {
    crackle::print_line(fmt::format("crackle: {}", error.what()));
    return static_cast<int>(error.code());
  } catch (const std::bad_alloc&) {
    crackle::print_line("crackle: out of memory: the mesh or a file is too large for this machine");
    return static_cast<int>(crackle::ExitCode::bad_case);
  } catch (const std::exception& error) {
    crackle::print_line(fmt::format("crackle: {}", error.what()));
    return 1;
  }
}
