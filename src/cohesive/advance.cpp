// SPDX-License-Identifier: GPL-3.0-or-later
//
// A step of the elements that are near their strength, damaged or broken: eight at a time, one a lane.
#include <algorithm>
#include <cmath>

#include "crackle/cohesive/cohesive.hpp"
#include "crackle/core/parallel.hpp"

namespace crackle {
namespace {

constexpr std::size_t lanes = element_lanes;

std::size_t at(Index i) { return static_cast<std::size_t>(i); }

// Elements, their points (ends 0 and 1, middle 2) before and now, and what a step does on them.
struct Group {
  ElementLanes element;
  std::array<CohesiveHistory*, lanes> history;
  LaneRow a0x, a0y, a1x, a1y, b0x, b0y, b1x, b1y;  // displacement of the ends of both faces
  LaneRow direction_x, direction_y;                // reference
  LaneRow offset_opening0, offset_slip0, offset_opening1, offset_slip1;
  LaneRow tangent_x, tangent_y;  // unit, now
  LaneRow was_broken, breaks;    // 1: yes
  LaneRow slid, fracture, sliding, friction, made, unpaid, path;
  LaneRow force0x, force0y, force1x, force1y;  // on face a
  std::array<PointLanes, 3> point;
  struct Before {
    LaneRow opening, slip, damage, plastic_slip, normal, shear, friction, stored, path;
    LaneRow inserted, repaid;
  };
  std::array<Before, 3> before;
};

CRACKLE_KERNEL void separate(Group& g) {
#pragma omp simd
  for (std::size_t l = 0; l < lanes; ++l) {
    const double dx = g.direction_x[l], dy = g.direction_y[l];
    g.element.length[l] = std::sqrt(dx * dx + dy * dy);
    // direction of the middle line between the faces
    const double ex = dx + 0.5 * ((g.a1x[l] + g.b1x[l]) - (g.a0x[l] + g.b0x[l]));
    const double ey = dy + 0.5 * ((g.a1y[l] + g.b1y[l]) - (g.a0y[l] + g.b0y[l]));
    const double inverse = 1.0 / std::sqrt(ex * ex + ey * ey);
    const double tx = ex * inverse, ty = ey * inverse;
    const double d0x = g.b0x[l] - g.a0x[l], d0y = g.b0y[l] - g.a0y[l];
    const double d1x = g.b1x[l] - g.a1x[l], d1y = g.b1y[l] - g.a1y[l];
    g.tangent_x[l] = tx;
    g.tangent_y[l] = ty;
    // normal (t.y, −t.x) points from face a to face b
    const double opening0 = d0x * ty - d0y * tx + g.offset_opening0[l];
    const double slip0 = d0x * tx + d0y * ty + g.offset_slip0[l];
    const double opening1 = d1x * ty - d1y * tx + g.offset_opening1[l];
    const double slip1 = d1x * tx + d1y * ty + g.offset_slip1[l];
    g.point[0].opening[l] = opening0;
    g.point[0].slip[l] = slip0;
    g.point[1].opening[l] = opening1;
    g.point[1].slip[l] = slip1;
    g.point[2].opening[l] = 0.5 * (opening0 + opening1);
    g.point[2].slip[l] = 0.5 * (slip0 + slip1);
  }
}

double positive(double x) { return x > 0.0 ? x : 0.0; }
double smaller(double a, double b) { return a < b ? a : b; }

// What the step does on a point [J/m2], times its weight. Work is trapezoidal, which is the work that the
// integrator does (energies at full steps).
[[gnu::always_inline]] inline void account_point(Group& g, std::size_t q, double share) {
  const PointLanes& now = g.point[q];
  Group::Before& old = g.before[q];
#pragma omp simd
  for (std::size_t l = 0; l < lanes; ++l) {
    const double weight = share * g.element.length[l];
    const bool was_broken = g.was_broken[l] > 0.0, breaks = g.breaks[l] > 0.0;
    const bool yields = now.damage[l] > 0.0, yielded = old.damage[l] > 0.0;  // else all is elastic
    const double given = now.path[l] - old.path[l];
    const double plastic = now.plastic_slip[l] - old.plastic_slip[l];
    const double slip = now.slip[l] - old.slip[l];
    const double normal = 0.5 * (now.normal[l] + old.normal[l]) * (now.opening[l] - old.opening[l]);
    const double shear = 0.5 * (now.shear[l] + old.shear[l]) * slip;
    const double rubbing = 0.5 * (now.friction[l] + old.friction[l]) * slip;
    // friction's too, and what the law gave, less what the point holds more
    const double lost = normal + shear + rubbing + given - (now.stored[l] - old.stored[l]);
    const double inserted = old.inserted[l], before = old.repaid[l];
    const double paid = smaller(positive(lost), positive(inserted - before));
    const double repaid = yields ? before + paid : before;
    const double debt = positive(inserted - repaid);
    const double dissipated = lost - paid;
    const double most = smaller(std::abs(plastic) * std::abs(now.friction[l]), positive(dissipated));
    const double rubbed = yielded ? most : 0.0;
    // Never negative: what a step would gain is left to the ledger's residual, and to the guards.
    const double broken = positive(dissipated - rubbed);
    const double counts = yields ? weight : 0.0, breaking = was_broken ? 0.0 : counts * broken;
    const double sheared = std::abs(shear) / (std::abs(shear) + std::abs(normal) + 1e-300);
    old.repaid[l] = breaks ? repaid + debt : repaid;
    g.slid[l] += (yields ? share : 0.0) * plastic;
    g.path[l] += weight * given;
    g.unpaid[l] += breaks ? counts * debt : 0.0;
    g.made[l] += counts * positive(-lost);
    g.friction[l] += counts * (was_broken ? rubbed + broken : rubbed);
    g.fracture[l] += breaking;
    g.sliding[l] += breaking * sheared;
  }
}

CRACKLE_KERNEL void account(Group& g) {
  g.slid = g.fracture = g.sliding = g.friction = g.made = g.unpaid = g.path = {};
  account_point(g, 0, 1.0 / 6.0);
  account_point(g, 1, 1.0 / 6.0);
  account_point(g, 2, 4.0 / 6.0);
  // Forces on face a from the tractions at ends and middle, Simpson's rule; the middle's share goes half to
  // each end.
#pragma omp simd
  for (std::size_t l = 0; l < lanes; ++l) {
    const double sixth = g.element.length[l] / 6.0;
    const auto along = [&](std::size_t q) { return g.point[q].shear[l] + g.point[q].friction[l]; };
    const double p0 = sixth * (g.point[0].normal[l] + 2.0 * g.point[2].normal[l]);
    const double q0 = sixth * (along(0) + 2.0 * along(2));
    const double p1 = sixth * (g.point[1].normal[l] + 2.0 * g.point[2].normal[l]);
    const double q1 = sixth * (along(1) + 2.0 * along(2));
    const double tx = g.tangent_x[l], ty = g.tangent_y[l];
    g.force0x[l] = p0 * ty + q0 * tx;
    g.force0y[l] = -p0 * tx + q0 * ty;
    g.force1x[l] = p1 * ty + q1 * tx;
    g.force1y[l] = -p1 * tx + q1 * ty;
  }
}

// Into the cache, while those before are worked on.
void fetch(const CohesiveHistory& h) {
  const char* const from = reinterpret_cast<const char*>(&h);
  for (std::size_t byte = 0; byte < sizeof h; byte += 64) __builtin_prefetch(from + byte, 1);
}
void fetch_nodes(const State& state, Index element) {
  for (const Index n : state.cohesive.nodes[at(element)]) {
    __builtin_prefetch(&state.displacement[at(n)]);
    __builtin_prefetch(&state.velocity[at(n)]);
  }
}

void put_element(const State& state, const CohesiveMaterial& rock, CohesiveHistory& h, Group& g) {
  const CohesiveElements& c = state.cohesive;
  const std::size_t i = at(h.element), l = g.element.used++;
  g.history[l] = &h;
  const Vec2 direction = c.direction[i];
  const auto put_material = [&](const CohesiveMaterial& m) {
    g.element.tensile_strength[l] = m.tensile_strength;
    g.element.cohesion[l] = m.cohesion;
    g.element.fracture_energy_mode1[l] = m.fracture_energy_mode1;
    g.element.fracture_energy_mode2[l] = m.fracture_energy_mode2;
  };
  if (rock.bedding) {
    put_material(on_plane(rock, right_normal(c.inverse_length[i] * direction)));
  } else {
    put_material(rock);
  }
  g.element.material[l] = &rock;
  g.element.tan_friction[l] = rock.tan_friction;
  g.element.tan_residual[l] = rock.tan_residual;
  g.element.penalty[l] = h.penalty > 0.0 ? h.penalty : rock.penalty;
  g.element.tangential_penalty[l] =
      h.penalty > 0.0 ? std::min(rock.tangential_penalty, h.penalty) : rock.tangential_penalty;
  const auto& n = c.nodes[i];
  const Vec2 a0 = state.displacement[at(n[0])], a1 = state.displacement[at(n[1])],
             b0 = state.displacement[at(n[2])], b1 = state.displacement[at(n[3])];
  g.a0x[l] = a0.x;
  g.a0y[l] = a0.y;
  g.a1x[l] = a1.x;
  g.a1y[l] = a1.y;
  g.b0x[l] = b0.x;
  g.b0y[l] = b0.y;
  g.b1x[l] = b1.x;
  g.b1y[l] = b1.y;
  g.direction_x[l] = direction.x;
  g.direction_y[l] = direction.y;
  g.offset_opening0[l] = c.offset[i][0];
  g.offset_slip0[l] = c.offset[i][1];
  g.offset_opening1[l] = c.offset[i][2];
  g.offset_slip1[l] = c.offset[i][3];
  g.was_broken[l] = c.status[i] != CohesiveStatus::active ? 1.0 : 0.0;
  g.breaks[l] = 0.0;
  // In the exact calibration a point has what its insertion gave it on top of the fracture energies, in
  // whichever mode it breaks, so that the fracture energy is left when that is paid back.
  const bool exact = rock.calibration == Calibration::exact;
  for (std::size_t q = 0; q < 3; ++q) {
    CohesivePoint& p = h.point[q];
    PointLanes& point = g.point[q];
    Group::Before& before = g.before[q];
    point.point[l] = &p;
    point.given[l] = exact ? positive(p.inserted) : 0.0;
    point.damage[l] = before.damage[l] = p.damage;
    point.plastic_slip[l] = before.plastic_slip[l] = p.plastic_slip;
    point.path[l] = before.path[l] = p.path;
    point.normal[l] = before.normal[l] = p.normal;
    point.shear[l] = before.shear[l] = p.shear;
    point.friction[l] = before.friction[l] = p.friction;
    point.stored[l] = before.stored[l] = p.stored;
    before.opening[l] = p.opening;
    before.slip[l] = p.slip;
    before.inserted[l] = p.inserted;
    before.repaid[l] = p.repaid;
  }
}

// An element breaks when two of its points are fully damaged; the third gives up at once what it still bears.
void break_elements(const CohesiveLaw& law, Group& g) {
  for (std::size_t l = 0; l < g.element.used; ++l) {
    if (g.was_broken[l] > 0.0) continue;
    int failed = 0;
    for (const PointLanes& p : g.point) failed += p.damage[l] >= 1.0;
    if (failed < 2) continue;
    g.breaks[l] = 1.0;
    for (PointLanes& p : g.point) {
      p.damage[l] = 1.0;
      law.move_lane(g.element, l, p);
    }
  }
}

void take_element(State& state, const Group& g, std::size_t l, Dissipation& sum) {
  CohesiveElements& c = state.cohesive;
  CohesiveHistory& h = *g.history[l];
  bool yielding = false;
  for (std::size_t q = 0; q < 3; ++q) {
    CohesivePoint& p = h.point[q];
    const PointLanes& now = g.point[q];
    p.opening = now.opening[l];
    p.slip = now.slip[l];
    p.damage = now.damage[l];
    p.plastic_slip = now.plastic_slip[l];
    p.normal = now.normal[l];
    p.shear = now.shear[l];
    p.friction = now.friction[l];
    p.stored = now.stored[l];
    p.path = now.path[l];
    p.repaid = g.before[q].repaid[l];
    yielding = yielding || p.damage > 0.0;
  }
  if (g.breaks[l] > 0.0) {
    c.status[at(h.element)] = CohesiveStatus::broken;
    h.break_time = state.time;
  }
  if (yielding && h.yield_time < 0.0) {
    h.yield_time = state.time;
    h.face_mass = face_masses(state, h.element);
    h.kinetic_at_yield = face_kinetic_energy(state, h.element, h.face_mass);
  }
  if (g.was_broken[l] == 0.0 && yielding) {
    const double kinetic = face_kinetic_energy(state, h.element, h.face_mass);
    h.kinetic_rise = std::max(h.kinetic_rise, kinetic - h.kinetic_at_yield);
  }
  h.slid = g.slid[l];
  h.rubbed = g.friction[l];
  h.fracture_energy += g.fracture[l];
  h.sliding_work += g.sliding[l];
  h.friction_energy += g.friction[l];
  h.made_energy += g.made[l];
  sum.fracture += g.fracture[l];
  sum.friction += g.friction[l];
  sum.made += g.made[l];
  sum.inserted += g.unpaid[l];
  sum.path += g.path[l];
  c.force[at(h.element)] = {{g.force0x[l], g.force0y[l]}, {g.force1x[l], g.force1y[l]}};
}

}  // namespace

void Cohesive::advance_histories(State& state) {
  CohesiveElements& c = state.cohesive;
  newly_broken_.clear();
  // In the order in which they lie: those of elements that were inserted are met with the elements' arrays.
  const auto count = static_cast<Index>(c.histories.size());
  std::vector<Dissipation> partial(at(block_count(count)));
  std::vector<std::vector<Index>> broken(partial.size());
  for_each_block(count, [&](Index begin, Index end, Index block) {
    Group g{};
    const auto advance = [&] {
      separate(g);
      for (PointLanes& p : g.point) law_->move(g.element, p);
      break_elements(*law_, g);
      account(g);
      for (std::size_t l = 0; l < g.element.used; ++l) {
        take_element(state, g, l, partial[at(block)]);
        if (g.breaks[l] > 0.0) broken[at(block)].push_back(g.history[l]->element);
      }
      g.element.used = 0;
    };
    for (Index j = begin; j < end; ++j) {
      CohesiveHistory& h = c.histories[at(j)];
      const CohesiveStatus status = c.status[at(h.element)];
      if (status == CohesiveStatus::intact) continue;
      if (status == CohesiveStatus::released) {  // general contact has taken over
        c.force[at(h.element)] = {};
        h.slid = h.rubbed = 0.0;
        continue;
      }
      fetch(c.histories[at(std::min(j + 8, count - 1))]);
      fetch_nodes(state, c.histories[at(std::min(j + 4, count - 1))].element);
      put_element(state, materials_[c.material[at(h.element)]], h, g);
      if (g.element.used == lanes) advance();
    }
    if (g.element.used > 0) advance();
  });
  for (std::size_t b = 0; b < partial.size(); ++b) {
    state.dissipation.fracture += partial[b].fracture;
    state.dissipation.friction += partial[b].friction;
    state.dissipation.made += partial[b].made;
    state.dissipation.inserted += partial[b].inserted;
    state.dissipation.path += partial[b].path;
    newly_broken_.insert(newly_broken_.end(), broken[b].begin(), broken[b].end());
  }
  std::sort(newly_broken_.begin(), newly_broken_.end());
}

}  // namespace crackle
