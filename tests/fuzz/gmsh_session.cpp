// SPDX-License-Identifier: GPL-3.0-or-later
//
// In place of src/mesh/gmsh/session.cpp: gmsh is initialised once and cleared between inputs, which is a
// hundred times faster.
#include <gmsh.h>

#include "crackle/core/errors.hpp"
#include "gmsh/session.hpp"

namespace crackle::meshing::by_gmsh {

void with_gmsh(const std::string& what, const std::function<void()>& action) {
  static const bool once = [] {
    gmsh::initialize(0, nullptr, false);
    gmsh::option::setNumber("General.Terminal", 0);
    return true;
  }();
  static_cast<void>(once);
  gmsh::clear();
  try {
    action();
  } catch (const std::exception& error) {
    throw MeshError(what + ": " + error.what());
  } catch (...) {  // gmsh throws strings and numbers
    throw MeshError(what + ": gmsh gave up");
  }
}

}  // namespace crackle::meshing::by_gmsh
