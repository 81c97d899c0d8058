// SPDX-License-Identifier: GPL-3.0-or-later
#include "crackle/cohesive/cohesive.hpp"

#include <algorithm>
#include <cmath>

#include "crackle/cohesive/elastic_element.hpp"
#include "crackle/core/parallel.hpp"

namespace crackle {
namespace {

std::size_t at(Index i) { return static_cast<std::size_t>(i); }

inline EndSeparation separate(const Vec2* u, const std::array<Index, 4>& n, Vec2 direction,
                              const std::array<double, 4>& offset) {
  const Vec2 a0 = u[n[0]], a1 = u[n[1]], b0 = u[n[2]], b1 = u[n[3]];
  // direction of the middle line between the faces
  const Vec2 e{direction.x + 0.5 * ((a1.x + b1.x) - (a0.x + b0.x)),
               direction.y + 0.5 * ((a1.y + b1.y) - (a0.y + b0.y))};
  const double inverse = 1.0 / std::sqrt(e.x * e.x + e.y * e.y);
  const Vec2 t{e.x * inverse, e.y * inverse};
  const Vec2 d0{b0.x - a0.x, b0.y - a0.y}, d1{b1.x - a1.x, b1.y - a1.y};
  // normal (t.y, −t.x) points from face a to face b
  return {d0.x * t.y - d0.y * t.x + offset[0], d0.x * t.x + d0.y * t.y + offset[1],
          d1.x * t.y - d1.y * t.x + offset[2], d1.x * t.x + d1.y * t.y + offset[3], t};
}

// Forces on face a from the tractions at ends and middle, Simpson's rule; the middle's share goes
// half to each end.
inline EndForces end_forces(Vec2 t, double sixth, double n0, double s0, double nm, double sm, double n1,
                            double s1) {
  const double p0 = sixth * (n0 + 2.0 * nm), q0 = sixth * (s0 + 2.0 * sm);
  const double p1 = sixth * (n1 + 2.0 * nm), q1 = sixth * (s1 + 2.0 * sm);
  return {{p0 * t.y + q0 * t.x, -p0 * t.x + q0 * t.y}, {p1 * t.y + q1 * t.x, -p1 * t.x + q1 * t.y}};
}

// Of an element in the reference state.
Vec2 normal_of(const CohesiveElements& c, std::size_t element) {
  return right_normal(c.inverse_length[element] * c.direction[element]);
}

// Of an intact element, with how near it is to its strength.
ElasticForces<double> elastic_element(const State& state, const CohesiveMaterial& m, double curvature,
                                      Index element) {
  const CohesiveElements& c = state.cohesive;
  const auto& n = c.nodes[at(element)];
  const auto& offset = c.offset[at(element)];
  const Vec2 direction = c.direction[at(element)];
  const Vec2 a0 = state.displacement[at(n[0])], a1 = state.displacement[at(n[1])],
             b0 = state.displacement[at(n[2])], b1 = state.displacement[at(n[3])];
  const Vec2 gap0 = b0 - a0, gap1 = b1 - a1, along = direction + 0.5 * ((a1 + b1) - (a0 + b0));
  return elastic_forces<double, double>(
      {gap0.x, gap0.y, gap1.x, gap1.y, along.x, along.y,
       dot(direction, direction) * c.inverse_length[at(element)], c.inverse_length[at(element)], offset[0],
       offset[1], offset[2], offset[3]},
      {m.penalty, m.tensile_strength, m.cohesion, m.tan_friction, curvature});
}

double utilisation_of(const CohesiveMaterial& m, double normal, double shear) {
  const double pull = std::max(normal, 0.0) / m.tensile_strength;
  const double push = shear / (m.cohesion - std::min(normal, 0.0) * m.tan_friction);
  return std::sqrt(pull * pull + push * push);
}

}  // namespace

Cohesive::Cohesive(std::shared_ptr<const CohesiveLaw> law, std::vector<CohesiveMaterial> materials)
    : law_(std::move(law)), materials_(std::move(materials)) {}

CohesiveMaterial Cohesive::material(const State& state, Index element) const {
  const CohesiveElements& c = state.cohesive;
  CohesiveMaterial m = on_plane(materials_[c.material[at(element)]], normal_of(c, at(element)));
  if (c.history_of[at(element)] < 0) return m;
  const CohesiveHistory& h = c.histories[at(c.history_of[at(element)])];
  if (h.penalty > 0.0) {
    m.penalty = h.penalty;
    m.tangential_penalty = std::min(m.tangential_penalty, h.penalty);
  }
  return m;
}

double Cohesive::utilisation(const CohesiveMaterial& rock, Sym2 stress, Vec2 along) {
  const CohesiveMaterial m = on_plane(rock, right_normal(along));
  const Vec2 traction = stress * right_normal(along);
  return utilisation_of(m, dot(traction, right_normal(along)), dot(traction, along));
}

double Cohesive::utilisation(const State& state, Index element) const {
  const CohesiveElements& c = state.cohesive;
  const CohesiveMaterial m = material(state, element);
  double most = 0.0;
  if (c.status[at(element)] == CohesiveStatus::intact) {
    const EndSeparation w = separation(state, element);  // the middle lies between the ends
    const auto of_end = [&](double opening, double slip) {
      const ElasticTraction t =
          elastic_traction(m.penalty * c.inverse_length[at(element)], law_->curvature(), m.tensile_strength,
                           m.cohesion, m.tan_friction, opening, slip);
      return utilisation_of(m, t.normal, t.shear);
    };
    return std::max(of_end(w.opening0, w.slip0), of_end(w.opening1, w.slip1));
  }
  for (const CohesivePoint& p : c.histories[at(c.history_of[at(element)])].point) {
    most = std::max(most, p.damage > 0.0 ? 1.0 : utilisation_of(m, p.normal, p.shear + p.friction));
  }
  return most;
}

EndSeparation Cohesive::separation(const State& state, Index element) const {
  const CohesiveElements& c = state.cohesive;
  return separate(state.displacement.data(), c.nodes[at(element)], c.direction[at(element)],
                  c.offset[at(element)]);
}

Vec2 Cohesive::place(const State& state, Index element) {
  Vec2 sum;
  for (const Index n : state.cohesive.nodes[at(element)]) {
    sum += state.node_reference(n) + state.displacement[at(n)];
  }
  return 0.25 * sum;
}

void Cohesive::begin_history(State& state, Index element) {
  CohesiveElements& c = state.cohesive;
  if (c.history_of[at(element)] >= 0) return;
  c.history_of[at(element)] = static_cast<Index>(c.histories.size());
  c.histories.emplace_back().element = element;
}

void Cohesive::activate(State& state, Index element) {
  begin_history(state, element);
  if (state.cohesive.status[at(element)] != CohesiveStatus::intact) return;
  state.cohesive.status[at(element)] = CohesiveStatus::active;
  state.cohesive.active.push_back(element);
}

// Points and force of an undamaged element, where it stands.
void Cohesive::place_points(State& state, Index element) const {
  CohesiveElements& c = state.cohesive;
  auto& p = c.histories[at(c.history_of[at(element)])].point;
  const EndSeparation w = separation(state, element);
  const double length = norm(c.direction[at(element)]);
  const CohesiveMaterial m = material(state, element);
  law_->move(m, length, w.opening0, w.slip0, p[0]);
  law_->move(m, length, w.opening1, w.slip1, p[1]);
  law_->move(m, length, 0.5 * (w.opening0 + w.opening1), 0.5 * (w.slip0 + w.slip1), p[2]);
  c.force[at(element)] =
      end_forces(w.direction, length / 6.0, p[0].normal, p[0].shear + p[0].friction, p[2].normal,
                 p[2].shear + p[2].friction, p[1].normal, p[1].shear + p[1].friction);
}

void Cohesive::load_springs(State& state, Index element) const {
  auto& points = state.cohesive.histories[at(state.cohesive.history_of[at(element)])].point;
  for (CohesivePoint& p : points) p.inserted -= p.stored;
  place_points(state, element);
  for (CohesivePoint& p : points) p.inserted += p.stored;
}

void Cohesive::add_tractions(State& state) {
  CohesiveElements& c = state.cohesive;
  std::vector<std::vector<Index>> near(at(block_count(c.count())));
  for_each_block(c.count(), [&](Index begin, Index end, Index block) {
    for (Index i = begin; i < end; ++i) {
      if (c.status[at(i)] != CohesiveStatus::intact) continue;
      const auto f = elastic_element(state, material(state, i), law_->curvature(), i);
      c.force[at(i)] = {{f.x0, f.y0}, {f.x1, f.y1}};
      if (f.beyond > 0.0) near[at(block)].push_back(i);
    }
  });
  for (const auto& elements : near) start_histories(state, elements, 0.0);
  advance_histories(state);
}

void Cohesive::start_histories(State& state, std::span<const Index> elements, double before) {
  for (const Index element : elements) {
    const auto nodes = state.cohesive.nodes[at(element)];
    std::array<Vec2, 4> now;
    for (std::size_t k = 0; k < 4; ++k) now[k] = state.displacement[at(nodes[k])];
    for (std::size_t k = 0; k < 4; ++k)
      state.displacement[at(nodes[k])] = now[k] - before * state.velocity[at(nodes[k])];
    activate(state, element);
    place_points(state, element);  // it was elastic there still
    for (std::size_t k = 0; k < 4; ++k) state.displacement[at(nodes[k])] = now[k];
  }
}

void Cohesive::cut(State& state, Index element) const {
  CohesiveElements& c = state.cohesive;
  activate(state, element);
  CohesiveHistory& h = c.histories[at(c.history_of[at(element)])];
  h.break_time = state.time;
  for (CohesivePoint& p : h.point) {
    p.damage = 1.0;
    p.inserted = 0.0;
  }
  c.status[at(element)] = CohesiveStatus::broken;
}

bool Cohesive::unbond(State& state, Index element) const {
  CohesiveElements& c = state.cohesive;
  const bool intact = c.status[at(element)] == CohesiveStatus::intact;
  activate(state, element);
  if (intact) place_points(state, element);
  CohesiveHistory& h = c.histories[at(c.history_of[at(element)])];
  const CohesiveMaterial m = material(state, element);
  const double stiffness = law_->friction_penalty(m) * c.inverse_length[at(element)];
  bool gives = false;
  for (CohesivePoint& p : h.point) {
    const double shear = p.shear + p.friction;
    const double held = std::max(-p.normal, 0.0) * m.tan_residual;
    gives = gives || p.normal > 0.0 || std::abs(shear) > (1.0 + 1e-12) * held;
    p.damage = 1.0;
    p.inserted = 0.0;
    p.plastic_slip = p.slip - shear / stiffness;
  }
  h.break_time = state.time;
  c.status[at(element)] = CohesiveStatus::broken;
  return gives;
}

double Cohesive::stored_energy(const State& state) const {
  const CohesiveElements& c = state.cohesive;
  const double curvature = law_->curvature();
  return sum_over_blocks(c.count(), [&](Index begin, Index end) {
    double sum = 0.0;
    for (Index i = begin; i < end; ++i) {
      const double length = norm(c.direction[at(i)]);
      const Index history = c.history_of[at(i)];
      const auto of_points = [&](const auto& value) {
        const auto& p = c.histories[at(history)].point;
        return length / 6.0 * (value(p[0]) + value(p[1]) + 4.0 * value(p[2]));
      };
      if (c.status[at(i)] != CohesiveStatus::intact) {
        sum += of_points([](const CohesivePoint& p) { return p.recoverable(); });
        continue;
      }
      if (history >= 0) sum -= of_points([](const CohesivePoint& p) { return p.inserted; });
      const CohesiveMaterial m = material(state, i);
      const EndSeparation w = separation(state, i);
      const auto energy = [&](double opening, double slip) {
        return elastic_energy(m.penalty / length, curvature, m.tensile_strength, m.cohesion, m.tan_friction,
                              opening, slip);
      };
      sum += length / 6.0 *
             (energy(w.opening0, w.slip0) + energy(w.opening1, w.slip1) +
              4.0 * energy(0.5 * (w.opening0 + w.opening1), 0.5 * (w.slip0 + w.slip1)));
    }
    return sum;
  });
}

}  // namespace crackle
