// SPDX-License-Identifier: GPL-3.0-or-later
#include <gmock/gmock.h>
#include <sys/wait.h>

#include <cstdlib>
#include <filesystem>
#include <sstream>
#include <string>
#include <vector>

#include "../analysis/records.hpp"
#include "binary.hpp"

namespace crackle_test {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::Not;

/// A record as rows of text; pressures and rates divided by what a unit is in SI.
struct Table {
  std::string header = "time_s,pressure_Pa,rate_m3_s";
  std::vector<std::string> rows;
  std::string text() const {
    std::string all = header + "\n";
    for (const std::string& row : rows) all += row + "\n";
    return all;
  }
};

Table table_of(const crackle::PressureRecord& record, double second = 1.0, double pascal = 1.0,
               double rate = 1.0, char separator = ',') {
  Table table;
  for (std::size_t i = 0; i < record.time.size(); ++i) {
    std::ostringstream row;
    row.precision(17);
    row << record.time[i] / second << separator << record.pressure[i] / pascal << separator
        << record.rate[i] / rate;
    table.rows.push_back(row.str());
  }
  return table;
}

crackle::PressureRecord carter() { return record_of(CarterTest{}, sampling(1.0, 0.02, 1e6)); }

/// A value of picks.json: what follows "value" in the pick of this name.
std::string value_in(const std::string& json, const std::string& name) {
  const std::size_t pick = json.find("\"name\": \"" + name + "\"");
  if (pick == std::string::npos) return "no such pick";
  const std::size_t start = json.find("\"value\": ", pick) + 9;
  return json.substr(start, json.find_first_of(",\n", start) - start);
}

class Dfit : public CliTest {
 protected:
  std::string out() const { return path("out"); }
  Outcome analyse(const std::string& record, std::vector<std::string> more = {}) const {
    std::vector<std::string> words{"dfit-analyse", record, "-o", out()};
    words.insert(words.end(), more.begin(), more.end());
    return crackle(words);
  }
  std::string pick(const std::string& name) const {
    return value_in(read_text(fs::path(out()) / "picks.json"), name);
  }
  void expect_refused(const Table& table, const std::string& part) const {
    expect_refusal(analyse(write("well.csv", table.text())), 2, part);
    EXPECT_FALSE(fs::exists(out())) << part;
  }
};

TEST_F(Dfit, RecordWithoutOptions) {
  const Outcome outcome = analyse(write("well.csv", table_of(carter()).text()));
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_EQ(outcome.err, "");
  EXPECT_THAT(outcome.out, HasSubstr("contact_compliance"));
  for (const char* name : {"isip", "contact_compliance", "closure_tangent", "closure_sqrt_time", "efficiency",
                           "reservoir_pressure"}) {
    EXPECT_THAT(pick(name), Not(testing::AnyOf("null", "no such pick"))) << name;
  }
  EXPECT_EQ(pick("leak_off_coefficient"), "null");
  EXPECT_EQ(pick("permeability"), "null");
  EXPECT_EQ(pick("leak_off_type"), "\"normal\"");
  EXPECT_NEAR(std::stod(pick("contact_compliance")), 44e6, 0.05e6);
  EXPECT_NEAR(std::stod(pick("isip")), 45e6, 1e3);
  EXPECT_THAT(read_text(fs::path(out()) / "fall_off.csv"),
              testing::StartsWith("time_s,elapsed_s,pressure_Pa"));
  // what it wrote in SI is a record again, with the same picks
  const std::string picks = read_text(fs::path(out()) / "picks.json");
  ASSERT_EQ(crackle({"dfit-analyse", path("out/record.csv"), "-o", path("again")}).code, 0);
  EXPECT_EQ(read_text(path("again/picks.json")), picks);
}

TEST_F(Dfit, InputsByOptionAndFile) {
  const std::string record = write("well.csv", table_of(carter()).text());
  const std::string inputs =
      write("rock.toml", "young_modulus = \"42.5 GPa\"\npoisson_ratio = 0.2\nhalf_length = 10\n");
  const Outcome outcome =
      analyse(record, {"--inputs", inputs, "--set", "poisson_ratio=0.17", "--set", "window=0.2"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_NEAR(std::stod(pick("leak_off_coefficient")), 2e-6, 1e-9);
  EXPECT_THAT(read_text(fs::path(out()) / "analysis.json"), HasSubstr("\"window_decades\": 0.2"));
}

TEST_F(Dfit, WrongInputs) {
  const std::string record = write("well.csv", table_of(carter()).text());
  const auto refused = [&](const std::string& set, const std::string& part) {
    expect_refusal(analyse(record, {"--set", set}), 2, part);
  };
  refused("young_modulo=1", "unknown key \"young_modulo\": the nearest is \"young_modulus\"");
  refused("young_modulus=42.5 m", "young_modulus is wrong");
  refused("poisson_ratio=0.5", "out of range");
  refused("geometry=penny", "\"penny\" is unknown");
  refused("geometry=2", "geometry cannot be an integer");
  refused("height", "write key=value");
  refused("shut_in=1e9 s", "there is no shut-in at 1e+09 s");
  const std::string inputs = write("rock.toml", "viscosity = \"1 cP\"\nporosity = 5\n");
  expect_refusal(analyse(record, {"--inputs", inputs}), 2, "rock.toml:2:12: porosity = 5 is out of range");
  EXPECT_FALSE(fs::exists(out()));
}

TEST_F(Dfit, FieldUnits) {
  ASSERT_EQ(analyse(write("well.csv", table_of(carter()).text())).code, 0);
  const std::string si = pick("contact_compliance");
  constexpr double psi = 6894.757293168361, barrel_a_minute = 0.158987294928 / 60.0;
  const auto same = [&](const std::string& text, const std::vector<std::string>& options) {
    const Outcome outcome = analyse(write("field.csv", text), options);
    ASSERT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_NEAR(std::stod(pick("contact_compliance")) / std::stod(si), 1.0, 1e-8);
  };
  Table comma = table_of(carter(), 3600.0, psi, barrel_a_minute);
  comma.header = "Time [h],Pressure (psi),Rate (bbl/min)";
  same(comma.text(), {});
  comma.header = "Elapsed,\"WHP\",Slurry Rate";
  same(comma.text(), {"--time", "Elapsed:h", "--pressure", "whp:psi", "--rate", "slurry rate:bpm"});
  Table tabs = table_of(carter(), 60.0, 1e6, 1.0 / 60.0, '\t');
  tabs.header = "# well 7\ntime\tpressure\trate\nmin\tMPa\tm3/min";
  same(tabs.text(), {});
  Table bare = table_of(carter(), 1.0, 1e5, 1e-3, ';');
  same(bare.text().substr(bare.header.size() + 1),
       {"--time", "1:s", "--pressure", "2:bar", "--rate", "3:l/s"});
}

TEST_F(Dfit, BadRecords) {
  const Table good = table_of(carter());
  const auto with_row = [&](std::size_t row, const std::string& text) {
    Table table = good;
    table.rows[row] = text;
    return table;
  };
  expect_refused(with_row(20, "5.0,45e6,0.01"), "well.csv:22: time does not rise");
  expect_refused(with_row(20, "20.0,nan,0.01"),
                 "well.csv:22: pressure_Pa is \"nan\", which is not a finite number");
  expect_refused(with_row(20, "20.0,,0.01"), "well.csv:22: pressure_Pa is empty");
  expect_refused(with_row(20, "20.0,45 MPa,0.01"), "well.csv:22: pressure_Pa is \"45 MPa\"");
  expect_refused(with_row(20, "12:20:05,45e6,0.01"), "well.csv:22: time_s is \"12:20:05\"");
  expect_refused(with_row(20, "20.0,45e6"), "well.csv:22: this row has 2 columns instead of 3");
  Table hole = good;
  hole.rows.erase(hole.rows.begin() + 400, hole.rows.begin() + 520);
  expect_refused(hole, "well.csv:402: nothing was recorded for");
  Table pumping = good;
  pumping.rows.resize(305);
  expect_refused(pumping, "there is no shut-in");
  Table brief = good;
  brief.rows.resize(320);
  expect_refused(brief, "20 are the fewest that can be analysed");
  Table few = good;
  few.rows.resize(3);
  expect_refused(few, "the record ends after 3 samples");
  few.rows.clear();
  expect_refused(few, "there are no samples below the header");
}

TEST_F(Dfit, BadHeadersAndUnits) {
  Table table = table_of(carter());
  const auto refused = [&](const std::string& header, const std::string& part) {
    table.header = header;
    expect_refused(table, part);
  };
  refused("seconds,pressure_Pa,rate_m3_s", "well.csv:1: none of the columns");
  refused("time_s,pressure_Pa,pressure_MPa", "more than one of the columns");
  refused("time_s,pressure_Pa,rate", "the unit of the rate (column \"rate\") is not said");
  refused("time [s],pressure [m],rate [m3/s]", "\"m\" is not a unit of pressure");
  refused("time [s],pressure [Pa],rate [psi]", "\"psi\" is not a unit of rate");
  refused("time_s,pressure_psi,rate_m3_s", "is the unit of the pressure right?");
  expect_refusal(analyse(write("empty.csv", "")), 2, "empty.csv: the file holds no record");
  expect_refusal(analyse(write("well.csv", table_of(carter()).text()), {"--rate", "flow:m3/s"}), 2,
                 "has no column \"flow\"");
  expect_refusal(analyse(path("none.csv")), 2, "none.csv: cannot read");
  write("a_file", "");
  expect_refusal(crackle({"dfit-analyse", path("well.csv"), "-o", path("a_file")}), 2,
                 "cannot create the output folder");
}

// A run's history: rates per metre, the rock from resolved.toml, truth beside it.
TEST_F(Dfit, RunFolder) {
  fs::create_directories(path("run"));
  const auto record = carter();
  Table history;
  history.header = "time_s,time_step_s,pressure_Pa,injection_rate_m2_s,half_length_m,contact_fraction";
  for (std::size_t i = 0; i < record.time.size(); ++i) {
    std::ostringstream row;
    row.precision(17);
    row << record.time[i] << ",1," << record.pressure[i] << ',' << record.rate[i] << ",10," << 0.5;
    history.rows.push_back(row.str());
  }
  write("run/history.csv", history.text());
  ASSERT_EQ(crackle({"dfit-analyse", path("run")}).code, 0);
  const std::string facts = read_text(path("run/dfit/analysis.json"));
  EXPECT_THAT(facts, HasSubstr("\"height_m\": 1,"));
  EXPECT_THAT(facts, HasSubstr("\"half_length_m\": 10,"));
  EXPECT_THAT(facts, HasSubstr("\"young_modulus_Pa\": null"));
  EXPECT_THAT(read_text(path("run/dfit/fall_off.csv")),
              HasSubstr("inverse_elapsed_1_s,contact_fraction,half_length_m\n"));
  EXPECT_THAT(read_text(path("run/dfit/record.csv")), testing::StartsWith("time_s,pressure_Pa,rate_m2_s\n"));
  write("run/resolved.toml", good_case);
  ASSERT_EQ(crackle({"dfit-analyse", path("run")}).code, 0);
  EXPECT_THAT(read_text(path("run/dfit/analysis.json")), HasSubstr("\"young_modulus_Pa\": 35000000000"));
  expect_refusal(crackle({"dfit-analyse", path("")}), 2, "history.csv is missing");
}

TEST_F(Dfit, Figures) {
  constexpr int modules_missing = 77;
  CarterTest open;
  open.closure = 0.0;
  open.leak_off_coefficient = 5e-7;
  for (const auto& record : {carter(), with_noise(record_of(open, sampling(1.0, 0.02, 1e5)), 1e3, 1)}) {
    ASSERT_EQ(analyse(write("well.csv", table_of(record).text())).code, 0);
    const std::string script = std::string(CRACKLE_SOURCE_DIR) + "/scripts/plots/draw_dfit.py";
    const int status = std::system(("/usr/bin/python3 " + script + " " + out() + " > /dev/null").c_str());
    if (WEXITSTATUS(status) == modules_missing)
      GTEST_SKIP() << "python3-vtk9 or python3-matplotlib is not installed";
    EXPECT_EQ(status, 0);
    for (const char* name : {"record", "g_function", "sqrt_time", "log_log", "after_closure"}) {
      EXPECT_GT(fs::file_size(out() + "/" + name + ".png"), 5000U) << name;
      fs::remove(out() + "/" + name + ".png");
    }
  }
}

}  // namespace
}  // namespace crackle_test
