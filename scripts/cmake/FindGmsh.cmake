# SPDX-License-Identifier: GPL-3.0-or-later
# Finds the C++ interface of gmsh, for which Debian 12 ships no CMake package.
# Gives: Gmsh_FOUND, Gmsh_VERSION (of the interface) and the imported target Gmsh::Gmsh.
find_path(Gmsh_INCLUDE_DIR gmsh.h)
find_library(Gmsh_LIBRARY gmsh)
mark_as_advanced(Gmsh_INCLUDE_DIR Gmsh_LIBRARY)

if(Gmsh_INCLUDE_DIR)
  file(STRINGS "${Gmsh_INCLUDE_DIR}/gmsh.h" Gmsh_version_lines
       REGEX "^#define GMSH_API_VERSION_(MAJOR|MINOR)")
  string(REGEX REPLACE ".*MAJOR +([0-9]+).*MINOR +([0-9]+).*" "\\1.\\2"
         Gmsh_VERSION "${Gmsh_version_lines}")
endif()

include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(Gmsh
  REQUIRED_VARS Gmsh_LIBRARY Gmsh_INCLUDE_DIR
  VERSION_VAR Gmsh_VERSION
  REASON_FAILURE_MESSAGE "install libgmsh-dev")

if(Gmsh_FOUND AND NOT TARGET Gmsh::Gmsh)
  add_library(Gmsh::Gmsh UNKNOWN IMPORTED)
  set_target_properties(Gmsh::Gmsh PROPERTIES
    IMPORTED_LOCATION "${Gmsh_LIBRARY}"
    INTERFACE_INCLUDE_DIRECTORIES "${Gmsh_INCLUDE_DIR}")
endif()
