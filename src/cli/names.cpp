// SPDX-License-Identifier: GPL-3.0-or-later
#include "names.hpp"

#include <algorithm>

#include "crackle/cohesive/law.hpp"
#include "crackle/io/case.hpp"
#include "crackle/solid/softening.hpp"

namespace crackle {

std::vector<NameGroup> name_groups() {
  std::vector<NameGroup> groups;
  groups.push_back({"Cohesive laws", "cohesive.law", {}});
  for (const auto& law : registered_laws()) groups.back().things.push_back({law->name(), law->description()});
  groups.push_back(
      {"Calibrations of their softening length",
       "cohesive.calibration",
       {{"exact", "breaking an edge dissipates the fracture energy given"},
        {"y_geo",
         "3 G / f as in Y-Geo: evans_marathe then dissipates 1.16 G, and its elastic branch on top"}}});
  groups.push_back(
      {"Insertion policies",
       "cohesive.insertion",
       {{"all", "every interior edge carries a cohesive element from the start (intrinsic, as Y-Geo)"},
        {"on_demand", "edges get one when they come near their strength, with the traction they bear"},
        {"none", "no elements: the rock breaks by smeared damage of its triangles"}}});
  groups.push_back({"Damage laws", "damage.law", {}});
  for (const auto& law : registered_softening()) {
    groups.back().things.push_back(
        {law->name(), "traction over strength against opening over G/strength: " + law->description()});
  }
  groups.push_back(
      {"Damage presets",
       "damage.preset",
       {{"recommended",
         "one damage of both directions; open failed triangles bear nothing; element length after Oliver"},
        {"faithful", "ADaM as published: independent damages, chord through the centroid; it locks"}}});
  groups.push_back({"Initiation of damage",
                    "damage.initiation",
                    {{"mohr_coulomb", "largest principal stress above f_t, or Mohr-Coulomb"},
                     {"principal", "largest principal stress above f_t"},
                     {"shear", "largest shear stress above the cohesion"},
                     {"box", "the first of these two"},
                     {"ellipse", "(sigma_n/f_t)^2 + (tau/c)^2 above 1 on the worst plane"}}});
  groups.push_back(
      {"Fluid models",
       "fluid.wets",
       {{"broken", "one pressure in the wellbore and in all broken elements connected to it, no viscosity"},
        {"damaged", "also in those that have begun to open, next to where it is"},
        {"tip", "in field time: the edge ahead of damaged ones bears the pressure of the last of them"}}});
  groups.push_back(
      {"Fluid in joints",
       "fluid.joints",
       {{"whole", "a joint without cohesion that is reached is wet at once (AbuAisha et al. 2016)"},
        {"edge", "edge by edge, each when its faces are apart"}}});
  groups.push_back({"Joints",
                    "joints.law",
                    {{"frictional", "closed, no cohesion or tensile strength: held by friction alone"},
                     {"bonded", "breaks like rock, by strengths and energies of its own"}}});
  groups.push_back(
      {"Outer boundaries",
       "boundary.outer",
       {{"fixed", "held in place; reflects waves"},
        {"free", "moves; bears the in-situ stress as a constant load"},
        {"absorbing", "lets waves out, as far as they come in straight (Lysmer and Kuhlemeyer 1969)"}}});
  groups.push_back({"Mesh generators",
                    "mesh.generator",
                    {{"cgal", "constrained Delaunay triangles by CGAL"}, {"gmsh", "the same by gmsh"}}});
  groups.push_back({"Fields of a frame",
                    "output.fields",
                    {{"displacement_m", "of every corner, from the in-situ state"},
                     {"velocity_m_s", "of every corner"},
                     {"stress_Pa", "effective, per triangle: xx, yy, xy"},
                     {"region", "per triangle: 0 rock"},
                     {"damage", "per triangle, 0 intact to 1, where damage is smeared"}}});
  groups.push_back({"Catalog formats",
                    "crackle catalog --to",
                    {{"csv", "events.csv as it is: local coordinates, SI units"},
                     {"quakeml", "QuakeML 1.2, longitude and latitude"},
                     {"zmap", "ten columns for ZMAP, longitude and latitude"}}});
  return groups;
}

std::vector<std::string> case_table_names() {
  std::vector<std::string> names;
  for (const CaseKey& key : case_keys()) {
    if (!key.table.empty() && std::find(names.begin(), names.end(), key.table) == names.end())
      names.push_back(key.table);
  }
  return names;
}

}  // namespace crackle
