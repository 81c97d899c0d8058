// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

namespace crackle::meshing {

/// libgmsh between its initialisation and finalisation: silent, with an empty model. gmsh keeps its
/// state in globals, so there is one session at a time. Its errors are exceptions of type
/// std::runtime_error.
class GmshSession {
 public:
  GmshSession();
  ~GmshSession();
  GmshSession(const GmshSession&) = delete;
  GmshSession& operator=(const GmshSession&) = delete;
};

/// The first line of what gmsh says went wrong.
std::string gmsh_complaint(const std::exception& error);

}  // namespace crackle::meshing
