// SPDX-License-Identifier: GPL-3.0-or-later
//
// A fall-off on logarithmic time, with its derivatives.
//
// Samples are averaged in bins of 2 % of the time since shut-in, so that a record of every second and
// one that thins out with time become the same list of points. A derivative dp/dx (x = ln Δt, G, √Δt)
// at a point is the slope of the least-squares line of p over x through the points of a window in
// ln Δt centred on it: the window of Bourdet, Ayoub and Pirard (1989, SPE 12777), whose weighted mean
// of two chords is replaced by all points in it, which bears more noise. Towards the ends the window
// shrinks symmetrically. The error of a slope follows from that of the points.
#pragma once

#include <cstddef>
#include <vector>

#include "crackle/analysis/record.hpp"

namespace crackle {

/// Slopes of falling pressure, positive where it falls: -dp/dx, and their standard errors. NaN at the
/// first and last point.
struct FallRate {
  std::vector<double> value;
  std::vector<double> error;
};

struct FallOff {
  double shut_in = 0.0;      ///< [s] on the record's clock
  double pump_time = 0.0;    ///< t_p [s]
  double alpha = 1.0;        ///< of the G-function
  double noise = 0.0;        ///< standard deviation of a sample [Pa]
  double window = 0.0;       ///< of the derivatives, width in decades of elapsed time
  double noise_share = 0.0;  ///< median over the points of error / |slope| of p over ln Δt

  std::vector<double> elapsed;   ///< Δt since shut-in [s]
  std::vector<double> pressure;  ///< mean of the bin [Pa]
  std::vector<double> count;     ///< samples in the bin
  std::vector<double> g;         ///< G-function time
  std::vector<double> root;      ///< √Δt [s^0.5]
  FallRate by_log;               ///< -dp/d ln Δt [Pa]
  FallRate by_g;                 ///< -dp/dG [Pa]
  FallRate by_root;              ///< -dp/d√Δt [Pa/s^0.5]

  std::size_t size() const { return elapsed.size(); }
  /// Standard error of a point's pressure [Pa].
  double point_error(std::size_t i) const;
};

/// What decides on the shape of a fall-off besides its record.
struct FallOffSettings {
  double pump_time = 0.0;  ///< t_p [s]
  double alpha = 1.0;      ///< 0.5 to 1
  double window = 0.0;     ///< decades; 0: the narrowest of 0.15, 0.2, 0.3 and 0.4 decades with which
                           ///< half of the slopes are known to 5 %, or else 0.4
};

/// @throws CaseError where fewer than 20 bins are filled
FallOff make_fall_off(const PressureRecord& record, const Injection& injection,
                      const FallOffSettings& settings);

/// Standard deviation [Pa] of the noise of samples of pressure: from what each differs from the cubic
/// through its four neighbours, by the median of the absolute values (Hampel 1974), which a few steps do
/// not move; at least what the resolution of the gauge causes.
double noise_of(const std::vector<double>& time, const std::vector<double>& pressure);

}  // namespace crackle
