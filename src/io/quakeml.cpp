// SPDX-License-Identifier: GPL-3.0-or-later
//
// QuakeML 1.2 BED (Euchner & Schorlemmer, "QuakeML - An XML Representation of Seismological Data, Basic
// Event Description", version 1.2, 2013): an event with one origin, two magnitudes and a moment tensor for
// each broken element and each slip of a joint.
//
// The magnitude is M = (log10 E - 4.8) / 1.5 with the energy E in joules (Gutenberg & Richter 1956, as
// in Lisjak et al. 2013 and AbuAisha et al. 2016), typed "Me", an energy magnitude. The Me of IASPEI,
// 2/3 (log10 E - 4.4), lies 0.267 above it. Each magnitude says so in its comment.
//
// The moment magnitude, typed "Mw", is that of the moment tensor, whose axes are up (r), south (t) and east
// (p): with x east, y north and z up in a level section M_tt = M_yy, M_pp = M_xx, M_rr = M_zz, M_tp = -M_xy;
// with x east, y up and z south in an upright one M_rr = M_yy, M_tt = M_zz, M_pp = M_xx, M_rp = M_xy. The
// shares iso, clvd and doubleCouple are those of Vavryčuk (2015).
//
// The origin of the run is the reference point of the case. What no field holds exactly (x and y in metres,
// the mode) stands in a comment of the origin and of the event.
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
  add(fmt::format("{}\n{} {} {} {} {} {}\n", scene.title, scene.seismic.longitude, scene.seismic.latitude,
                  scene.seismic.depth, scene.seismic.depth_axis, scene.seismic.epoch,
                  scene.seismic.thickness));
  for (const SeismicEvent& event : events) add(event_line(event));
  return fmt::format("{:016x}", hash);
}

void add_magnitude(pugi::xml_node event, const std::string& id, const char* type, double value,
                   const std::string& origin, const std::string& comment) {
  pugi::xml_node magnitude = event.append_child("magnitude");
  magnitude.append_attribute("publicID") = id.c_str();
  add_value(magnitude, "mag", value);
  add_text(magnitude, "type", type);
  add_text(magnitude, "originID", origin);
  add_comment(magnitude, comment);
}

/// In joules (newton metres): moments per metre times the thickness.
void add_tensor(pugi::xml_node parent, const MomentTensor& m, const Case::Seismic& reference) {
  const bool upright = reference.depth_axis == "y";
  const double d = reference.thickness;
  pugi::xml_node tensor = parent.append_child("tensor");
  add_value(tensor, "Mrr", d * (upright ? m.yy : m.zz));
  add_value(tensor, "Mtt", d * (upright ? m.zz : m.yy));
  add_value(tensor, "Mpp", d * m.xx);
  add_value(tensor, "Mrt", 0.0);
  add_value(tensor, "Mrp", upright ? d * m.xy : 0.0);
  add_value(tensor, "Mtp", upright ? 0.0 : -d * m.xy);
}

void add_moment_tensor(pugi::xml_node node, const std::string& id, const SeismicEvent& event,
                       const Case::Seismic& reference) {
  add_text(node, "preferredFocalMechanismID", id + "/focal_mechanism");
  add_magnitude(node, id + "/moment_magnitude", "Mw", event.moment_magnitude, id + "/origin",
                "2/3 (log10(M0/Nm) - 9.1)");
  pugi::xml_node mechanism = node.append_child("focalMechanism");
  mechanism.append_attribute("publicID") = (id + "/focal_mechanism").c_str();
  pugi::xml_node moment = mechanism.append_child("momentTensor");
  moment.append_attribute("publicID") = (id + "/moment_tensor").c_str();
  add_text(moment, "derivedOriginID", id + "/origin");
  add_text(moment, "momentMagnitudeID", id + "/moment_magnitude");
  add_value(moment, "scalarMoment", reference.thickness * scalar_moment(event.moment));
  add_tensor(moment, event.moment, reference);
  const MomentShares shares = moment_shares(event.moment);
  add_text(moment, "doubleCouple", fmt::format("{}", shares.dc));
  add_text(moment, "clvd", fmt::format("{}", shares.clvd));
  add_text(moment, "iso", fmt::format("{}", shares.iso));
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
  add_value(origin, "depth", place.depth);
  add_text(origin, "depthType", "operator assigned");
  add_text(origin, "evaluationMode", "automatic");
  add_comment(origin, fmt::format("x_m={} y_m={} time_s={}", event.place.x, event.place.y, event.time));

  if (std::isfinite(event.magnitude)) {
    add_text(node, "preferredMagnitudeID", id + "/magnitude");
    add_magnitude(node, id + "/magnitude", "Me", event.magnitude, id + "/origin",
                  fmt::format("(log10(E/J) - 4.8)/1.5 with E = energy_J_m={} times thickness_m={}",
                              event.energy, reference.thickness));
  }
  if (scalar_moment(event.moment) > 0.0) add_moment_tensor(node, id, event, reference);
  add_comment(node,
              fmt::format("kind={} mode={} edges={} edge={} length_m={} opening_m={} slip_m={} duration_s={} "
                          "fracture_energy_J_m={} friction_energy_J_m={} stress_drop_Pa={}",
                          to_string(event.kind), to_string(event.mode), event.edges, event.edge, event.length,
                          event.opening, event.slip, event.duration, event.fracture_energy,
                          event.friction_energy, event.stress_drop));
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
