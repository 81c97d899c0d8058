// SPDX-License-Identifier: GPL-3.0-or-later
//
// Files of `crackle dfit-analyse`: records of pressure in, picks and plotted columns out.
#pragma once

#include <string>
#include <vector>

#include "crackle/analysis/picks.hpp"

namespace crackle {

/// Which columns of a table are the record's: "NAME", "NAME:UNIT" or, counted from 1, "3:UNIT"; empty: the
/// one whose header is that name with a unit, as time_s, pressure_MPa, rate_m3_s, injection_rate_m2_s,
/// "Pressure [psi]" or "rate (bbl/min)".
struct RecordColumns {
  std::string time;
  std::string pressure;
  std::string rate;
};

/// Reads a record from a table of text, or the history.csv of a run folder. Cells are parted by commas,
/// semicolons or tabs; lines that start with # are passed over; a second row may hold the units. Units are
/// any that a case file takes, and bpm. The columns closure_stress_Pa, contact_fraction and half_length_m
/// of a simulated test come along as truth.
/// @throws CaseError with file and line on a column that is missing or named twice, a unit that is
/// unknown or of another dimension, and a cell that is not a finite number
PressureRecord read_pressure_record(const std::string& path, const RecordColumns& columns);

/// How a record is analysed, and what it does not hold.
struct DfitSetup {
  DfitSettings settings;
  DfitInputs inputs;
};

/// Reads keys from a TOML file (none if empty) and then from "key=value" texts, over those given.
/// @throws CaseError with the place: unknown key (with the nearest), wrong type, unit or range
DfitSetup read_dfit_setup(const std::string& file, const std::vector<std::string>& overrides,
                          const DfitSetup& given);

/// One line a key: its name, an example and what it means.
std::string dfit_keys_text();

/// Writes into a folder, made if needed, over an earlier analysis there: picks.json, a list of picks;
/// analysis.json, what else was found and used; fall_off.csv, the columns that are plotted, one row a bin of
/// 2 % in time (with the truth, if there is one); record.csv, the whole record in SI. @throws CaseError
void write_dfit(const std::string& folder, const PressureRecord& record, const DfitAnalysis& analysis);

}  // namespace crackle
