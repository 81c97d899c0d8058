// SPDX-License-Identifier: GPL-3.0-or-later
//
// QuakeML 1.2 BED (Euchner & Schorlemmer, "QuakeML - An XML Representation of Seismological Data, Basic
// Event Description", version 1.2, 2013): an event with one origin and one magnitude for each broken
// element.
//
// The magnitude is M = (log10 E - 4.8) / 1.5 with the energy E in joules (Gutenberg & Richter 1956, as
// in Lisjak et al. 2013 and AbuAisha et al. 2016), typed "Me", an energy magnitude. The Me of IASPEI,
// 2/3 (log10 E - 4.4), lies 0.267 above it. Each magnitude says so in its comment.
//
// The origin of the run is the reference point of the case; x points east, y north, and the section
// lies level at the reference depth. What no field holds exactly (x and y in metres, the mode) stands
// in a comment of the origin and of the event.
#include "quakeml.hpp"

#include <fmt/format.h>

#include <cmath>
#include <pugixml.hpp>
#include <sstream>

#include "events_csv.hpp"
#include "geographic.hpp"
#include "utc_time.hpp"

namespace crackle {

namespace {

void add_text(pugi::xml_node parent, const char* name, const std::string& text) {
  parent.append_child(name).text().set(text.c_str());
}

void add_value(pugi::xml_node parent, const char* name, double value) {
  add_text(parent.append_child(name), "value", fmt::format("{}", value));
}

void add_comment(pugi::xml_node parent, const std::string& text) {
  add_text(parent.append_child("comment"), "text", text);
}

/// XML 1.0 has no way to write control characters.
std::string printable(std::string text) {
  for (char& c : text) {
    if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) c = ' ';
  }
  return text;
}

/// A name for this very catalog (FNV-1a of its rows and place), so that the events of two runs can be
/// merged and the same run gives the same file.
std::string fingerprint(const std::vector<SeismicEvent>& events, const Case& scene) {
  std::uint64_t hash = 0xcbf29ce484222325;
  const auto add = [&hash](const std::string& text) {
    for (const char c : text) hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3;
  };
  add(fmt::format("{}\n{} {} {} {}\n", scene.title, scene.seismic.longitude, scene.seismic.latitude,
                  scene.seismic.depth, scene.seismic.epoch));
  for (const SeismicEvent& event : events) add(event_line(event));
  return fmt::format("{:016x}", hash);
}

void add_event(pugi::xml_node catalog, const std::string& id, const SeismicEvent& event,
               const Case::Seismic& reference, const UtcTime& epoch) {
  const Geographic place = to_geographic(event.place, reference);
  pugi::xml_node node = catalog.append_child("event");
  node.append_attribute("publicID") = (id + "/event").c_str();
  add_text(node, "type", "induced or triggered event");
  add_text(node, "typeCertainty", "known");
  add_text(node, "preferredOriginID", id + "/origin");

  pugi::xml_node origin = node.append_child("origin");
  origin.append_attribute("publicID") = (id + "/origin").c_str();
  add_text(origin.append_child("time"), "value", to_iso8601(later(epoch, event.time)));
  add_value(origin, "longitude", place.longitude);
  add_value(origin, "latitude", place.latitude);
  add_value(origin, "depth", reference.depth);
  add_text(origin, "depthType", "operator assigned");
  add_text(origin, "evaluationMode", "automatic");
  add_comment(origin, fmt::format("x_m={} y_m={} time_s={}", event.place.x, event.place.y, event.time));

  if (std::isfinite(event.magnitude)) {
    add_text(node, "preferredMagnitudeID", id + "/magnitude");
    pugi::xml_node magnitude = node.append_child("magnitude");
    magnitude.append_attribute("publicID") = (id + "/magnitude").c_str();
    add_value(magnitude, "mag", event.magnitude);
    add_text(magnitude, "type", "Me");
    add_text(magnitude, "originID", id + "/origin");
    add_comment(magnitude, fmt::format("(log10(E/J) - 4.8)/1.5 with E = energy_J_m={} times thickness_m={}",
                                       event.energy, reference.thickness));
  }
  add_comment(node, fmt::format("mode={} length_m={} opening_m={} slip_m={} fracture_energy_J_m={} edge={}",
                                to_string(event.mode), event.length, event.opening, event.slip,
                                event.fracture_energy, event.edge));
}

}  // namespace

std::string quakeml_text(const std::vector<SeismicEvent>& events, const Case& scene) {
  const UtcTime epoch = parse_utc(scene.seismic.epoch);
  const std::string id = "smi:local/crackle/" + fingerprint(events, scene);

  pugi::xml_document document;
  pugi::xml_node declaration = document.append_child(pugi::node_declaration);
  declaration.append_attribute("version") = "1.0";
  declaration.append_attribute("encoding") = "UTF-8";
  pugi::xml_node root = document.append_child("q:quakeml");
  root.append_attribute("xmlns:q") = "http://quakeml.org/xmlns/quakeml/1.2";
  root.append_attribute("xmlns") = "http://quakeml.org/xmlns/bed/1.2";
  pugi::xml_node catalog = root.append_child("eventParameters");
  catalog.append_attribute("publicID") = id.c_str();
  if (!scene.title.empty()) add_text(catalog, "description", printable(scene.title));
  for (std::size_t i = 0; i < events.size(); ++i) {
    add_event(catalog, fmt::format("{}/{}", id, i + 1), events[i], scene.seismic, epoch);
  }
  std::ostringstream text;
  document.save(text, "  ");
  return text.str();
}

}  // namespace crackle
