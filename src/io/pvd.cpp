// SPDX-License-Identifier: GPL-3.0-or-later
#include "pvd.hpp"

#include <fmt/format.h>

#include <pugixml.hpp>
#include <sstream>

namespace crackle {

std::string pvd_text(const std::vector<PvdEntry>& entries) {
  pugi::xml_document document;
  pugi::xml_node root = document.append_child("VTKFile");
  root.append_attribute("type") = "Collection";
  root.append_attribute("version") = "0.1";
  pugi::xml_node collection = root.append_child("Collection");
  for (const PvdEntry& entry : entries) {
    pugi::xml_node frame = collection.append_child("DataSet");
    frame.append_attribute("timestep") = fmt::format("{}", entry.time).c_str();
    frame.append_attribute("part") = "0";
    frame.append_attribute("file") = entry.file.c_str();
  }
  std::ostringstream text;
  document.save(text, "  ");
  return text.str();
}

}  // namespace crackle
