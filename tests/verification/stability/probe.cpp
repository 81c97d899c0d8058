// SPDX-License-Identifier: GPL-3.0-or-later
//
// stability_probe SCENE SETTING X [Y]: one point of the stability map as a line of CSV; without arguments the
// head of the table. scripts/chart_stability runs it.
#include <cstdio>
#include <cstdlib>
#include <exception>

#include "scenes.hpp"

int main(int argc, char** argv) {
  if (argc < 4) {
    std::printf(
        "scene,setting,x,y,predicted,measured,bound,joint_work,dissipated,made,broken,stray,fastest_m_s,"
        "alarm,"
        "alarm_step\n");
    return argc == 1 ? 0 : 2;
  }
  try {
    const crackle::stability::Row r =
        crackle::stability::run(argv[1], argv[2], std::atof(argv[3]), argc > 4 ? std::atof(argv[4]) : 0.0);
    std::printf("%s,%s,%.6g,%.6g,%.6g,%.6g,%.6g,%.6g,%.6g,%.6g,%ld,%ld,%.6g,\"%s\",%ld\n", r.scene.c_str(),
                r.setting.c_str(), r.x, r.y, r.predicted, r.measured, r.bound, r.joint_work, r.dissipated,
                r.made, r.broken, r.stray, r.fastest, r.alarm.c_str(), r.alarm_step);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "stability_probe: %s\n", error.what());
    return 1;
  }
}
