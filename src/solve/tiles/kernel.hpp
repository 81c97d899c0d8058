// SPDX-License-Identifier: GPL-3.0-or-later
//
// The work of one tile in its own small arrays, eight triangles or elements at a time. Compiled for three x86
// levels (kernel_*.cpp), of which one is picked at start; without contraction all give the same bits.
#pragma once

#include <cstdint>

#include "crackle/cohesive/elastic_element.hpp"
#include "crackle/solid/triangle.hpp"

namespace crackle::tiles {

inline constexpr int lanes = 8;

/// What the next tile will read, fetched into the second cache while this one is worked on, a few lines a
/// group: a tile's loads come all at once, and then there is nothing to do but wait.
struct Ahead {
  struct Range {
    const char *from, *to;
  };
  const Range* range;
  const Range* end;
  int lines;  ///< a group
};

/// Nodes that follow one another in the state and in the tile.
struct Run {
  std::int32_t node;  ///< the first, in the state
  std::uint16_t local, count;
};

/// Vectors of nodes, copied from the state.
struct CopyWork {
  const Run* run;
  const Run* end;
  const double* from;  ///< [node of the state][x y]
  double* to;          ///< [node][x y]
};

/// Displacement and velocity of nodes side by side: what a viscous triangle reads of a corner is one vector.
struct MotionWork {
  const Run* run;
  const Run* end;
  const double *displacement, *velocity;  ///< [node of the state][x y]
  double* to;                             ///< [node][displacement x y, velocity x y]
};

/// v += Δt f/m, x += Δt v
struct MoveWork {
  const Run* run;
  const Run* end;
  double dt;
  const double* force;         ///< [node][x y]
  const double* inverse_mass;  ///< [node of the state]
  double* velocity;            ///< [node of the state][x y]
  double* displacement;
};

/// Triangles of a tile by groups of eight. A node of the tile is named by four times its number. Arrays of
/// numbers have one row of eight a group (and component).
struct RockWork {
  int groups;
  const std::uint16_t* corners;  ///< [group][corner][lane], a node of the tile
  const double* sides;           ///< [group][from corner 0 to 1, to 2: x y x y][lane], reference
  const double* displacement;    ///< [node][x y]; viscous: null
  double* force;                 ///< [node][x y], added to
  PlaneStiffness stiffness;
  Sym2 in_situ;
  const double* in_situ_rows;  ///< [group][component][lane] where it is not the same in all; else null
  double weight;               ///< [N/m3]
  // viscous; motion null: not
  const double* motion;     ///< [node][displacement x y, velocity x y]
  const double* viscosity;  ///< [group][lane]
  double* strain_rate;      ///< [group][component][lane], of the last step: replaced
  double* power;            ///< [lane], added to
  // screened; stressed null: not
  StressScreen screen;
  std::uint8_t* stressed;  ///< [group][lane], not zero where the screen is passed
  Ahead ahead;
};

/// Intact cohesive elements.
struct ElementWork {
  int groups;
  const std::uint16_t* ends;   ///< [group][a0 a1 b0 b1][lane], a node of the tile
  const double* numbers;       ///< [group][1/length, direction x y, opening0, slip0, opening1, slip1][lane]
  const double* displacement;  ///< as for triangles: this or motion
  const double* motion;
  double* force;
  ElasticLimits<double> limits;
  /// [group][tensile strength, cohesion, tan friction, penalty][lane], where not the same in all; else null
  const double* limit_rows;
  std::uint8_t* near;  ///< [group][lane], not zero near the strength
  Ahead ahead;
};

struct Kernels {
  void (*copy)(const CopyWork&);
  void (*copy_motion)(const MotionWork&);
  void (*move)(const MoveWork&);
  void (*rock)(const RockWork&);
  void (*elements)(const ElementWork&);
};

/// Those for the processor that this runs on.
const Kernels& kernels();

#define CRACKLE_DECLARE_KERNELS(level) \
  namespace level {                    \
  void copy(const CopyWork&);          \
  void copy_motion(const MotionWork&); \
  void move(const MoveWork&);          \
  void rock(const RockWork&);          \
  void elements(const ElementWork&);   \
  }
CRACKLE_DECLARE_KERNELS(baseline)
CRACKLE_DECLARE_KERNELS(v3)
CRACKLE_DECLARE_KERNELS(v4)
#undef CRACKLE_DECLARE_KERNELS

}  // namespace crackle::tiles
