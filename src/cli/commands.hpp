// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace crackle {

/// What every command that reads a case takes from the command line.
struct CaseOptions {
  std::string case_file;
  std::vector<std::string> overrides;  ///< --set table.key=value
  std::optional<std::string> seed;     ///< of the mesh
};

struct RunOptions : CaseOptions {
  std::string output;  ///< run folder; empty: runs/<case name>
  std::string resume;  ///< folder of an interrupted run, instead of a case; empty: a new run
  int threads = 0;     ///< 0: all cores
  bool quiet = false;
  bool allow_unstable = false;  ///< what the guards find is said and counted, and the run goes on
};

struct CheckOptions : CaseOptions {
  int threads = 0;  ///< that the run would have; 0: all cores
};

struct MeshOptions : CaseOptions {
  std::string output;  ///< a .msh or .vtu file
};

struct LawOptions : CaseOptions {  ///< no case file: the granite of AbuAisha et al. (2016)
  std::string law;
  std::string mode = "1";        ///< "1", "2" or "mixed"
  std::string angle = "45 deg";  ///< of the motion from the edge's normal, where mixed
  std::string normal = "0";      ///< stress across the edge in mode 2
  std::string edge = "3 mm";     ///< its length
  int points = 200;              ///< rows of the table
};

struct CatalogOptions {
  std::string folder;  ///< of a run
  std::string format;  ///< "csv", "quakeml", "zmap"; empty: a summary
  std::string output;  ///< file; empty: the terminal
  bool clustered = false;
  std::string radius, window;  ///< of clusters; empty: from the edges and the shear wave
  bool figures = true;         ///< with a summary
};

struct DfitOptions {
  std::string record;                  ///< a file of a record, or the folder of a run
  std::string output;                  ///< folder; empty: RUN_DIR/dfit, or <name of the file>_dfit here
  std::string time, pressure, rate;    ///< columns: "NAME" or "NAME:UNIT"; empty: by their headers
  std::string inputs;                  ///< a TOML file with the keys of --set
  std::vector<std::string> overrides;  ///< --set key=value
};

/// Each command returns the exit code of the program, or throws an Error that carries it.
int run_command(const RunOptions& options);
int check_command(const CheckOptions& options);
int mesh_command(const MeshOptions& options);
int law_command(const LawOptions& options);
int list_command();
int describe_command(const std::string& name);
int catalog_command(const CatalogOptions& options);
int dfit_analyse_command(const DfitOptions& options);

}  // namespace crackle
