// SPDX-License-Identifier: GPL-3.0-or-later
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <limits>
#include <sstream>

#include "crackle/io/output.hpp"
#include "sample_run.hpp"

namespace crackle::test {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::ThrowsMessage;

constexpr const char* events_columns =
    "time_s,x_m,y_m,kind,mode,energy_J_m,magnitude,fracture_energy_J_m,friction_energy_J_m,length_m,opening_"
    "m,"
    "slip_m,stress_drop_Pa,duration_s,moment_xx_N_m_m,moment_yy_N_m_m,moment_zz_N_m_m,moment_xy_N_m_m,"
    "moment_magnitude,edges,edge\n";
constexpr const char* row_end = ",0.015,-4.4,0.015,0,0.003,1e-05,0,0,1e-6,250,676,250,0,-4.2,1,17\n";
const std::string good_row = std::string("0.001,0.1,-0.2,breaking,tensile") + row_end;

TEST(HistoryCsv, HasTheAgreedColumnsAndExactValues) {
  const ScratchFolder scratch;
  HistoryRow row;
  row.time = 0.1 + 0.2;  // not 0.3
  row.time_step = 1.0 / 3.0;
  row.broken_shear = 7;
  row.energy_inserted = 0.125;
  row.energy_path = -2.0;
  row.energy_residual = -std::numeric_limits<double>::denorm_min();
  RunFolder run(scratch / "run");
  run.append_history(row);
  // on disk although the run goes on
  std::istringstream lines(content(scratch / "run/history.csv"));
  std::string header;
  std::string line;
  std::getline(lines, header);
  std::getline(lines, line);
  EXPECT_EQ(
      header,
      "time_s,time_step_s,pressure_Pa,injection_rate_m2_s,injected_m2,cavity_volume_m2,wetted_length_m,"
      "broken_tensile,broken_shear,broken_mixed,energy_kinetic_J_m,energy_strain_J_m,energy_cohesive_J_m,"
      "energy_fracture_J_m,energy_friction_J_m,energy_viscous_J_m,energy_fluid_J_m,work_external_J_m,"
      "energy_inserted_J_m,energy_path_J_m,energy_residual");
  EXPECT_EQ(line, "0.30000000000000004,0.3333333333333333,0,0,0,0,0,0,7,0,0,0,0,0,0,0,0,0,0.125,-2,-5e-324");
}

TEST(HistoryCsv, HasFourColumnsALoad) {
  const ScratchFolder scratch;
  HistoryRow row;
  row.loads = {{{1.0, -2.0}, {3e-6, 0.25}}};
  RunFolder run(scratch / "run");
  run.set_loads({"top"});
  run.append_history(row);
  std::istringstream lines(content(scratch / "run/history.csv"));
  std::string header, line;
  std::getline(lines, header);
  std::getline(lines, line);
  EXPECT_TRUE(header.ends_with(
      ",energy_residual,top_force_x_N_m,top_force_y_N_m,top_displacement_x_m,top_displacement_y_m"));
  EXPECT_TRUE(line.ends_with(",0,1,-2,3e-06,0.25")) << line;
}

TEST(EventsCsv, ReadsBackExactly) {
  const ScratchFolder scratch;
  std::vector<SeismicEvent> events = sample_events(3e-3);
  events[0].magnitude = -std::numeric_limits<double>::infinity();
  events[1].kind = EventKind::slip;
  events[1].edges = 12;
  events[1].stress_drop = 1.0 / 3.0;
  {
    RunFolder run(scratch / "run");
    for (const SeismicEvent& event : events) run.append_event(event);
  }
  EXPECT_EQ(content(scratch / "run/events.csv"), catalog_text(events, sample_case(), "csv"));
  for (const std::string& path : {scratch / "run", scratch / "run/events.csv"}) {
    const std::vector<SeismicEvent> read = read_events_csv(path);
    ASSERT_EQ(read.size(), events.size());
    for (std::size_t i = 0; i < read.size(); ++i) {
      EXPECT_EQ(read[i], events[i]) << i;
    }
  }
}

TEST(EventsCsv, OfARunWithoutEventsIsEmpty) {
  const ScratchFolder scratch;
  { RunFolder(scratch / "run").append_history({}); }
  EXPECT_EQ(content(scratch / "run/events.csv"), events_columns);
  EXPECT_TRUE(read_events_csv(scratch / "run").empty());
}

TEST(EventsCsv, NamesTheLineThatIsDamaged) {
  const ScratchFolder scratch;
  const std::string path = scratch / "events.csv";
  const auto expect = [&](const std::string& text, const std::string& place, const std::string& what) {
    std::ofstream(path) << text;
    EXPECT_THAT([&] { read_events_csv(path); },
                ThrowsMessage<CaseError>(AllOf(HasSubstr("events.csv:" + place), HasSubstr(what))));
  };
  const std::string header = events_columns;
  const std::string good = good_row;
  expect("", "1: ", "not the events.csv of a run");
  expect("time_s,x_m\n", "1: ", "not the events.csv of a run");
  expect(header + good + "0.001,0.1,-0.2,breaking,tensile,0.0", "3: ", "6 columns instead of 21");
  expect(header + "\n" + good, "2: ", "1 columns instead of 21");
  expect(header + good + "0.001,zero,-0.2,breaking,tensile" + row_end, "3: ", "x_m is \"zero\"");
  expect(header + "0.001,0.1,-0.2,breaking,torn" + row_end, "2: ", "mode is \"torn\"");
  expect(header + "0.001,0.1,-0.2,quake,shear" + row_end, "2: ", "kind is \"quake\"");
  expect(header + good.substr(0, good.size() - 1) + ".5\n", "2: ", "edge is \"17.5\"");
  EXPECT_THAT([&] { read_events_csv(scratch / "none.csv"); },
              ThrowsMessage<CaseError>(HasSubstr("none.csv: cannot read: No such file")));
  // line ends of another system do no harm
  std::ofstream(path) << header.substr(0, header.size() - 1) << "\r\n"
                      << good.substr(0, good.size() - 1) << "\r\n";
  EXPECT_EQ(read_events_csv(path).size(), 1U);
}

}  // namespace
}  // namespace crackle::test
