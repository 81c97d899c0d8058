// SPDX-License-Identifier: GPL-3.0-or-later
#include "gmsh_session.hpp"

#include <gmsh.h>

namespace crackle::meshing {

GmshSession::GmshSession() {
  gmsh::initialize(0, nullptr, false);  // without the user's own option files
  gmsh::option::setNumber("General.Terminal", 0);
  gmsh::model::add("crackle");
}

GmshSession::~GmshSession() { gmsh::finalize(); }

}  // namespace crackle::meshing
