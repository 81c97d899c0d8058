// SPDX-License-Identifier: GPL-3.0-or-later
//
// The catalog of a run with joints: breaking and slips, by the binary from case to figures and files.
#include <gmock/gmock.h>

#include <filesystem>

#include "binary.hpp"
#include "crackle/io/output.hpp"
#include "crackle/seismic/clusters.hpp"

namespace crackle_test {
namespace {

using crackle::EventKind;
using crackle::MomentTensor;
using crackle::SeismicEvent;
using testing::HasSubstr;

class Catalog : public CliTest {};

MomentTensor sum_of_moments(const std::vector<SeismicEvent>& events) {
  MomentTensor sum;
  for (const SeismicEvent& e : events) sum += e.moment;
  return sum;
}

int count(const std::string& text, const std::string& part) {
  int found = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++found;
  return found;
}

TEST_F(Catalog, OfARunWithJoints) {
  const std::string file = write("case.toml", std::string(good_case) + R"(
[[joint_sets]]
density = "150 1/m2"
length_mean = "60 mm"
region_radius = "0.3 m"
clear_distance = "20 mm"
seed = 2
residual_friction_angle = "10 deg"
)");
  const std::string out = path("out");
  const Outcome ran = crackle({"run", file, "-o", out, "-q", "-j", "1", "--set", "run.end_time=0.75 ms"});
  ASSERT_EQ(ran.code, 0) << ran.err;
  const std::vector<SeismicEvent> events = crackle::read_events_csv(out + "/events.csv");
  int slips = 0, several = 0;
  for (const SeismicEvent& e : events) {
    if (e.kind != EventKind::slip) continue;
    ++slips;
    several += e.edges > 1;
    EXPECT_NE(e.slip, 0.0);
    EXPECT_GE(e.duration, 0.0);
    EXPECT_GT(e.friction_energy, 0.0);
    EXPECT_GE(e.energy, 0.0);
  }
  EXPECT_GT(slips, 5);
  EXPECT_GT(several, 5) << "edges that slide together are one event";
  EXPECT_GT(static_cast<int>(events.size()) - slips, 5);

  const Outcome summary = crackle({"catalog", out});
  ASSERT_EQ(summary.code, 0) << summary.err;
  EXPECT_THAT(summary.out, HasSubstr("slips: " + std::to_string(slips) + ","));
  for (const char* figure : {"/events.png", "/catalog.png"})
    EXPECT_TRUE(std::filesystem::exists(out + figure));

  ASSERT_EQ(crackle({"catalog", out, "--to", "quakeml", "-o", path("all.xml")}).code, 0);
  EXPECT_EQ(count(read_text(path("all.xml")), "<event "), static_cast<int>(events.size()));

  ASSERT_EQ(crackle({"catalog", out, "--clustered", "--to", "csv", "-o", path("clusters.csv")}).code, 0);
  const std::vector<SeismicEvent> clusters = crackle::read_events_csv(path("clusters.csv"));
  EXPECT_LT(clusters.size(), events.size());
  const MomentTensor all = sum_of_moments(events), kept = sum_of_moments(clusters);
  const double size = crackle::scalar_moment(all);
  double off = 0.0;
  for (const double d : {kept.xx - all.xx, kept.yy - all.yy, kept.zz - all.zz, kept.xy - all.xy})
    off = std::max(off, std::abs(d) / size);
  std::printf("%zu events, %d of them slips, %d over several edges; %zu clusters, moment kept to %.1e\n",
              events.size(), slips, several, clusters.size(), off);
  EXPECT_LT(off, 1e-13);
}

}  // namespace
}  // namespace crackle_test
