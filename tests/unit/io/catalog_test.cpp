// SPDX-License-Identifier: GPL-3.0-or-later
// The rules of QuakeML-BED-1.2.xsd that matter here, by hand: names, types, mandatory children, the
// pattern of identifiers and what they refer to.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <limits>
#include <pugixml.hpp>
#include <set>
#include <sstream>

#include "crackle/io/output.hpp"
#include "sample_run.hpp"

namespace crackle::test {
namespace {

using testing::HasSubstr;
using testing::MatchesRegex;
using testing::ThrowsMessage;

std::string text_of(const pugi::xml_node& node, const char* path) {
  return node.first_element_by_path(path).text().get();
}

void expect_number(const pugi::xml_node& node, const char* path, double value) {
  const std::string text = text_of(node, path);
  char* end = nullptr;
  const double number = std::strtod(text.c_str(), &end);
  EXPECT_TRUE(!text.empty() && *end == '\0') << path << ": " << text;
  EXPECT_EQ(number, value) << path;
}

void expect_children(const pugi::xml_node& node, const std::set<std::string>& allowed) {
  for (const pugi::xml_node& child : node.children())
    EXPECT_EQ(allowed.count(child.name()), 1U) << child.name();
}

pugi::xml_node event_parameters(pugi::xml_document& document, const std::string& text) {
  EXPECT_TRUE(document.load_string(text.c_str()));
  const pugi::xml_node root = document.child("q:quakeml");
  EXPECT_STREQ(root.attribute("xmlns:q").value(), "http://quakeml.org/xmlns/quakeml/1.2");
  EXPECT_STREQ(root.attribute("xmlns").value(), "http://quakeml.org/xmlns/bed/1.2");
  return root.child("eventParameters");
}

TEST(QuakeMl, HoldsWhatTheSchemaAsksFor) {
  const Case scene = sample_case();
  std::vector<SeismicEvent> events = sample_events(3e-3);
  events[1].magnitude = -std::numeric_limits<double>::infinity();
  pugi::xml_document document;
  const pugi::xml_node catalog = event_parameters(document, catalog_text(events, scene, "quakeml"));
  EXPECT_EQ(text_of(catalog, "description"), scene.title);

  const auto identifier = MatchesRegex(
      "(smi|quakeml):[A-Za-z0-9_][-A-Za-z0-9_.*()~']{2,}/[-A-Za-z0-9_.*()~'][-A-Za-z0-9_.*()+?~'=,;#/&]*");
  const auto date_time = MatchesRegex("[0-9]{4}-[0-9]{2}-[0-9]{2}T[0-9]{2}:[0-9]{2}:[0-9]{2}[.][0-9]{6,}Z");
  std::set<std::string> ids;
  for (const pugi::xpath_node& found : document.select_nodes("//@publicID")) {
    EXPECT_THAT(found.attribute().value(), identifier);
    EXPECT_TRUE(ids.insert(found.attribute().value()).second) << found.attribute().value();
  }
  std::size_t count = 0;
  for (const pugi::xml_node& event : catalog.children("event")) {
    const SeismicEvent& expected = events[count++];
    expect_children(event, {"type", "typeCertainty", "preferredOriginID", "preferredMagnitudeID",
                            "preferredFocalMechanismID", "origin", "magnitude", "focalMechanism", "comment"});
    EXPECT_EQ(text_of(event, "type"), "induced or triggered event");
    EXPECT_EQ(text_of(event, "typeCertainty"), "known");
    EXPECT_EQ(ids.count(text_of(event, "preferredOriginID")), 1U);
    EXPECT_THAT(text_of(event, "comment/text"), HasSubstr("mode=" + to_string(expected.mode)));

    const pugi::xml_node origin = event.child("origin");
    expect_children(origin,
                    {"time", "longitude", "latitude", "depth", "depthType", "evaluationMode", "comment"});
    EXPECT_EQ(text_of(event, "preferredOriginID"), origin.attribute("publicID").value());
    EXPECT_THAT(text_of(origin, "time/value"), date_time);
    expect_number(origin, "depth/value", scene.seismic.depth);
    EXPECT_THAT(text_of(origin, "comment/text"), HasSubstr("x_m="));

    const pugi::xml_node mechanism = event.child("focalMechanism");
    EXPECT_EQ(text_of(event, "preferredFocalMechanismID"), mechanism.attribute("publicID").value());
    const pugi::xml_node moment = mechanism.child("momentTensor");
    EXPECT_EQ(text_of(moment, "derivedOriginID"), origin.attribute("publicID").value());
    expect_number(moment, "scalarMoment/value", scene.seismic.thickness * scalar_moment(expected.moment));
    expect_number(moment, "tensor/Mtt/value", scene.seismic.thickness * expected.moment.yy);
    const pugi::xml_node mw =
        event.find_child_by_attribute("magnitude", "publicID", text_of(moment, "momentMagnitudeID").c_str());
    EXPECT_EQ(text_of(mw, "type"), "Mw");
    expect_number(mw, "mag/value", expected.moment_magnitude);

    const pugi::xml_node magnitude = event.find_child_by_attribute(
        "magnitude", "publicID", text_of(event, "preferredMagnitudeID").c_str());
    EXPECT_EQ(!magnitude.empty(), std::isfinite(expected.magnitude));
    if (magnitude.empty()) {
      EXPECT_TRUE(event.child("preferredMagnitudeID").empty());
      continue;
    }
    expect_children(magnitude, {"mag", "type", "originID", "comment"});
    expect_number(magnitude, "mag/value", expected.magnitude);
    EXPECT_EQ(text_of(magnitude, "type"), "Me");
    EXPECT_EQ(text_of(magnitude, "originID"), origin.attribute("publicID").value());
    EXPECT_EQ(text_of(event, "preferredMagnitudeID"), magnitude.attribute("publicID").value());
    EXPECT_THAT(text_of(magnitude, "comment/text"), HasSubstr("(log10(E/J) - 4.8)/1.5"));
  }
  EXPECT_EQ(count, events.size());
}

// An explosion of 1 N m along x, 2 along y, 3 out of plane and 4 in shear, per metre of 2 m.
TEST(QuakeMl, TurnsTheTensorToUpSouthEast) {
  SeismicEvent event;
  event.moment = {1.0, 2.0, 3.0, 4.0};
  event.place = {0.0, 7.0};
  Case scene = sample_case();
  const auto expect = [&](const std::array<double, 6>& values, double depth, double latitude) {
    pugi::xml_document document;
    const pugi::xml_node node =
        event_parameters(document, catalog_text({event}, scene, "quakeml")).child("event");
    const pugi::xml_node tensor = node.first_element_by_path("focalMechanism/momentTensor/tensor");
    const std::array<const char*, 6> names{"Mrr", "Mtt", "Mpp", "Mrt", "Mrp", "Mtp"};
    for (std::size_t i = 0; i < names.size(); ++i) {
      expect_number(tensor, (std::string(names[i]) + "/value").c_str(), values[i]);
    }
    expect_number(node, "origin/depth/value", depth);
    EXPECT_NEAR(std::stod(text_of(node, "origin/latitude/value")), latitude, 1e-12);
  };
  scene.seismic.latitude = 0.0;
  expect({6.0, 4.0, 2.0, 0.0, 0.0, -8.0}, 1500.0, 7.0 / 110574.27582159436);
  scene.seismic.depth_axis = "y";
  expect({4.0, 6.0, 2.0, 0.0, 8.0, 0.0}, 1493.0, 0.0);
  std::istringstream row(catalog_text({event}, scene, "zmap"));
  std::vector<double> columns(10);
  for (double& c : columns) row >> c;
  EXPECT_EQ(columns[6], 1.493) << "km";
}

// The rules of the published schema for what is written here, as a schema of our own (see its head).
TEST(QuakeMl, KeepsTheRulesOfTheSchema) {
  if (std::system("xmllint --version 2>/dev/null") != 0) GTEST_SKIP() << "xmllint is not installed";
  const ScratchFolder scratch;
  std::vector<SeismicEvent> events = sample_events(3e-3);
  events[0].magnitude = -std::numeric_limits<double>::infinity();
  events[1].moment = {};
  events[2].kind = EventKind::slip;
  const std::string text = catalog_text(events, sample_case(), "quakeml");
  const auto valid = [&](const std::string& document) {
    std::ofstream(scratch / "events.xml") << document;
    const std::string command = "xmllint --noout --schema " CRACKLE_SOURCE_DIR
                                "/tests/unit/io/quakeml_rules/quakeml.xsd " +
                                (scratch / "events.xml") + " > " + (scratch / "log") + " 2>&1";
    return std::system(command.c_str()) == 0;
  };
  EXPECT_TRUE(valid(text)) << content(scratch / "log");
  EXPECT_TRUE(valid(catalog_text({}, sample_case(), "quakeml"))) << "no event: " << content(scratch / "log");
  // what the rules have to catch
  const auto broken = [&](const std::string& part, const std::string& instead) {
    std::string changed = text;
    const std::size_t at = changed.find(part);
    EXPECT_NE(at, std::string::npos) << part;
    if (at != std::string::npos) changed.replace(at, part.size(), instead);
    return changed;
  };
  for (const auto& [part, instead] : std::vector<std::pair<std::string, std::string>>{
           {"<type>induced or triggered event", "<type>frack"},
           {"publicID=\"smi:local/", "publicID=\"local/"},
           {"publicID=\"smi:local/", "publicID=\"smi:lo/"},
           {"<latitude>", "<x/><latitude>"},
           {"<mag>", "<mag><uncertainty>much</uncertainty>"},
           {"T00:00", "T25:00"},
           {"<depthType>operator assigned", "<depthType>guessed"},
           {"<Mrt>", "<Mxy>"}}) {
    EXPECT_FALSE(valid(broken(part, instead))) << part << " -> " << instead;
  }
}

TEST(QuakeMl, IsValidWithoutEvents) {
  pugi::xml_document document;
  const pugi::xml_node catalog = event_parameters(document, catalog_text({}, sample_case(), "quakeml"));
  EXPECT_FALSE(catalog.attribute("publicID").empty());
  EXPECT_TRUE(catalog.child("event").empty());
}

TEST(QuakeMl, IsWellFormedToAnotherParser) {
  if (std::system("xmllint --version 2>/dev/null") != 0) GTEST_SKIP() << "xmllint is not installed";
  const ScratchFolder scratch;
  write_sample_run(scratch / "run", 2, 2e-3, true);
  for (const char* name : {"events.xml", "fields.pvd", "fractures.pvd"}) {
    EXPECT_EQ(std::system(("xmllint --noout " + (scratch / "run/") + name).c_str()), 0) << name;
  }
}

TEST(QuakeMl, OfTwoRunsCanBeMerged) {
  const std::vector<SeismicEvent> events = sample_events(3e-3);
  Case other = sample_case();
  other.title = "another";
  const auto first_id = [](const std::string& text) -> std::string {
    pugi::xml_document document;
    return event_parameters(document, text).child("event").attribute("publicID").value();
  };
  const std::string one = catalog_text(events, sample_case(), "quakeml");
  EXPECT_EQ(one, catalog_text(events, sample_case(), "quakeml"));
  EXPECT_NE(first_id(one), first_id(catalog_text(events, other, "quakeml")));
}

/// Where and when one event lies, from its ZMAP row.
struct Placed {
  double longitude, latitude, year;
  int month, day;
  double magnitude, depth;
  int hour, minute;
  double second;
};

Placed place(Vec2 at, double time, const Case::Seismic& reference) {
  Case scene = sample_case();
  scene.seismic = reference;
  SeismicEvent event;
  event.place = at;
  event.time = time;
  event.magnitude = -4.416;
  std::istringstream row(catalog_text({event}, scene, "zmap"));
  Placed p{};
  row >> p.longitude >> p.latitude >> p.year >> p.month >> p.day >> p.magnitude >> p.depth >> p.hour >>
      p.minute >> p.second;
  EXPECT_TRUE(row);
  return p;
}

TEST(Zmap, HasTenTabSeparatedColumns) {
  std::istringstream rows(catalog_text(sample_events(3e-3), sample_case(), "zmap"));
  std::string row;
  std::size_t count = 0;
  while (std::getline(rows, row)) {
    ++count;
    EXPECT_EQ(std::count(row.begin(), row.end(), '\t'), 9) << row;
  }
  EXPECT_EQ(count, sample_events(3e-3).size());
  EXPECT_EQ(catalog_text({}, sample_case(), "zmap"), "");
  const Placed p = place({}, 0.0, sample_case().seismic);
  EXPECT_EQ(p.depth, 1.5);  // km
  EXPECT_EQ(p.magnitude, -4.416);
}

TEST(Zmap, CountsTimeFromTheEpochOverTheEndOfALeapDay) {
  Case::Seismic reference = sample_case().seismic;  // 1 ms before the end of 29 February 2016
  const Placed before = place({}, 0.0005, reference);
  EXPECT_EQ(before.month, 2);
  EXPECT_EQ(before.day, 29);
  EXPECT_EQ(before.hour, 23);
  EXPECT_EQ(before.minute, 59);
  EXPECT_NEAR(before.second, 59.9995, 1e-9);
  const Placed after = place({}, 0.00100000123, reference);
  EXPECT_EQ(after.month, 3);
  EXPECT_EQ(after.day, 1);
  EXPECT_EQ(after.hour, 0);
  EXPECT_EQ(after.minute, 0);
  EXPECT_NEAR(after.second, 1e-9, 1e-12);  // 1.23 ns, to the nanosecond
  EXPECT_NEAR(after.year, 2016.0 + 60.0 / 366.0, 1e-11);

  reference.epoch = "2015-07-02T12:00:00Z";  // the middle of a common year
  EXPECT_NEAR(place({}, 0.0, reference).year, 2015.5, 1e-11);
  reference.epoch = "2016-07-02T00:00:00Z";  // and of a leap year
  EXPECT_NEAR(place({}, 0.0, reference).year, 2016.5, 1e-11);
  reference.epoch = "2016-01-01T01:30:00.25+02:00";  // 23:30 of the day before in UTC
  const Placed zone = place({}, -0.5, reference);
  EXPECT_EQ(zone.day, 31);
  EXPECT_EQ(zone.hour, 23);
  EXPECT_EQ(zone.minute, 29);
  EXPECT_NEAR(zone.second, 59.75, 1e-9);
  EXPECT_NEAR(zone.year, 2016.0 - (1800.25 / 86400.0) / 365.0, 1e-11);
}

TEST(Zmap, LiesEastAndNorthOfTheReference) {
  Case::Seismic reference;
  // length of a degree on WGS 84 (NGA calculator): at the equator 111319.491 m of longitude and
  // 110574.276 m of latitude; at 45 degrees 78846.806 m and 111131.777 m
  const Placed equator = place({111319.491, 110574.276}, 0.0, reference);
  EXPECT_NEAR(equator.longitude, 1.0, 1e-7);
  EXPECT_NEAR(equator.latitude, 1.0, 1e-7);
  reference.latitude = 45.0;
  reference.longitude = 179.5;
  const Placed middle = place({78846.806, -111131.777}, 0.0, reference);
  EXPECT_NEAR(middle.longitude, -179.5, 1e-6);  // over the date line
  EXPECT_NEAR(middle.latitude, 44.0, 1e-6);
  reference.latitude = -90.0;
  EXPECT_TRUE(std::isfinite(place({1.0, 1.0}, 0.0, reference).longitude));
  // a tenth of a millimetre is still seen
  reference.latitude = 51.0;
  EXPECT_NE(place({1e-4, 0.0}, 0.0, reference).longitude, place({0.0, 0.0}, 0.0, reference).longitude);
}

TEST(Catalog, RefusesWhatItCannotWrite) {
  EXPECT_THAT([] { catalog_text({}, sample_case(), "kml"); },
              ThrowsMessage<CaseError>(HasSubstr("csv, quakeml or zmap")));
  for (const char* epoch : {"", "yesterday", "2015-02-29T00:00:00Z", "2015-01-01T24:00:00Z", "2015-1-1",
                            "2015-01-01T00:00:00.Z", "2015-01-01Z", "2015-01-01T00:00:00Z "}) {
    Case scene = sample_case();
    scene.seismic.epoch = epoch;
    EXPECT_THAT([&] { catalog_text({}, scene, "quakeml"); }, ThrowsMessage<CaseError>(HasSubstr("ISO 8601")))
        << epoch;
  }
}

}  // namespace
}  // namespace crackle::test
