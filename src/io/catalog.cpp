// SPDX-License-Identifier: GPL-3.0-or-later
#include "crackle/io/output.hpp"
#include "events_csv.hpp"
#include "quakeml.hpp"
#include "zmap.hpp"

namespace crackle {

std::string catalog_text(const std::vector<SeismicEvent>& events, const Case& scene,
                         const std::string& format) {
  if (format == "quakeml") return quakeml_text(events, scene);
  if (format == "zmap") return zmap_text(events, scene);
  if (format != "csv") {
    throw CaseError("\"" + format + "\" is not a catalog format; use csv, quakeml or zmap");
  }
  std::string text = events_header();
  for (const SeismicEvent& event : events) text += event_line(event);
  return text;
}

}  // namespace crackle
