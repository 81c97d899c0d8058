// SPDX-License-Identifier: GPL-3.0-or-later
#include "session.hpp"

#include <fmt/format.h>
#include <gmsh.h>

#include "crackle/core/errors.hpp"

namespace crackle::meshing::by_gmsh {
namespace {

class Session {
 public:
  Session() {
    gmsh::initialize(0, nullptr, false);  // without the option files of the user
    gmsh::option::setNumber("General.Terminal", 0);
    gmsh::model::add("crackle");
  }
  ~Session() { gmsh::finalize(); }
  Session(const Session&) = delete;
  Session& operator=(const Session&) = delete;
};

std::string last_complaint() {
  std::string complaint;
  gmsh::logger::getLastError(complaint);
  if (complaint.empty()) complaint = "gmsh gave up without saying why";
  return complaint.substr(0, complaint.find('\n'));
}

}  // namespace

void with_gmsh(const std::string& what, const std::function<void()>& action) {
  const Session session;
  std::string complaint;
  try {
    action();
    return;
  } catch (const std::exception& error) {
    complaint = error.what();
  } catch (...) {  // gmsh throws strings and numbers, and keeps the message
    complaint = last_complaint();
  }
  throw MeshError(fmt::format("{}: {}", what, complaint));
}

}  // namespace crackle::meshing::by_gmsh
