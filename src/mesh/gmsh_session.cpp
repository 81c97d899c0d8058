// SPDX-License-Identifier: GPL-3.0-or-later
#include "gmsh_session.hpp"

#include <gmsh.h>

#include <exception>

namespace crackle::meshing {

GmshSession::GmshSession() {
  gmsh::initialize(0, nullptr, false);  // without the option files of the user
  gmsh::option::setNumber("General.Terminal", 0);
  gmsh::model::add("crackle");
}

GmshSession::~GmshSession() {
  try {
    gmsh::finalize();
  } catch (const std::exception&) {  // nothing is lost: the model was read out before
  }
}

std::string gmsh_complaint(const std::exception& error) {
  const std::string what = error.what();
  return what.substr(0, what.find('\n'));
}

}  // namespace crackle::meshing
