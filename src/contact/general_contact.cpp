// SPDX-License-Identifier: GPL-3.0-or-later
#include "crackle/contact/general_contact.hpp"

#include <algorithm>
#include <cmath>

#include "candidates.hpp"
#include "crackle/core/parallel.hpp"
#include "depth.hpp"
#include "free_sides.hpp"
#include "release.hpp"
#include "touch.hpp"

namespace crackle {
namespace {

std::size_t at(Index i) { return static_cast<std::size_t>(i); }

}  // namespace

struct GeneralContact::Search {
  explicit Search(const Mesh& mesh) : sides(mesh) {}

  FreeSides sides;
  std::vector<PlacedSide> placed;
  Candidates candidates;
  Index nodes = 0;     // when the sides were looked up
  bool ready = false;  // the sides have been looked up
  bool any_released = false;

  // True once something can touch: several bodies, or something released.
  bool needed() const { return sides.separate_bodies() || any_released; }

  void refresh(State& state, bool sides_changed) {
    if (sides_changed || !ready || nodes != state.node_count()) sides.build(state);
    nodes = state.node_count();
    sides.place(state, placed);
    double fastest2 = 0.0;
    for (Index s = 0; s < sides.count(); ++s) {
      const Vec2 v = state.velocity[at(sides[s].node[0])], w = state.velocity[at(sides[s].node[1])];
      fastest2 = std::max({fastest2, dot(v, v), dot(w, w)});
    }
    state.contact.moved += 2.0 * std::sqrt(fastest2) * state.time_step;
    if (ready && !sides_changed && state.contact.moved <= candidates.buffer()) return;
    candidates.build(sides, placed);
    state.contact.listed.clear();
    for (const PlacedSide& side : placed) state.contact.listed.push_back({side.start, side.end});
    state.contact.moved = 0.0;
    ready = true;
  }

  // As after the refresh() that the state went through last.
  void rebuild(const State& state) {
    any_released = std::any_of(state.cohesive.status.begin(), state.cohesive.status.end(),
                               [](CohesiveStatus status) { return status == CohesiveStatus::released; });
    ready = state.contact.broken >= 0;
    if (!ready) return;
    sides.build(state);
    nodes = state.node_count();
    placed.clear();
    for (const auto& [start, end] : state.contact.listed) placed.push_back({start, end});
    candidates.build(sides, placed);
  }
};

GeneralContact::GeneralContact(const State& state, const ContactMaterial& material)
    : material_(material), search_(std::make_unique<Search>(*state.mesh)) {}
GeneralContact::~GeneralContact() = default;
GeneralContact::GeneralContact(GeneralContact&&) noexcept = default;
GeneralContact& GeneralContact::operator=(GeneralContact&&) noexcept = default;

void GeneralContact::rebuild(const State& state) { search_->rebuild(state); }

void GeneralContact::update(State& state) {
  released_.clear();
  forces_.clear();
  slips_.clear();
  Index broken = 0;
  for (const Index element : state.cohesive.active) {
    const CohesiveStatus status = state.cohesive.status[at(element)];
    if (status < CohesiveStatus::broken) continue;
    ++broken;
    if (status == CohesiveStatus::released) search_->any_released = true;
    if (status == CohesiveStatus::broken && has_parted(state, element)) released_.push_back(element);
  }
  std::sort(released_.begin(), released_.end());

  // What released pairs bore goes to the points of their two faces.
  double handed_over = 0.0;
  for (const Index element : released_) {
    const Edge& edge = state.mesh->edges[at(state.cohesive.edge[at(element)])];
    const std::array<Index, 2> corner{3 * edge.triangle[0] + edge.side[0],
                                      3 * edge.triangle[1] + edge.side[1]};
    const double length = norm(state.cohesive.direction[at(element)]);
    for (std::size_t face = 0; face < 2; ++face) {
      const auto born = born_by_face(state, element, face == 1);
      for (std::size_t q = 0; q < 3; ++q) {
        if (born[q].pressure == 0.0) continue;
        state.contact.points.push_back(
            take_over(material_, length, born[q], corner[face], static_cast<Index>(q), corner[1 - face]));
      }
    }
    handed_over += release(state, element);
    search_->any_released = true;
  }
  if (!search_->needed()) return;
  if (!released_.empty()) std::sort(state.contact.points.begin(), state.contact.points.end(), comes_first);
  const bool sides_changed = broken != state.contact.broken || !released_.empty();
  search_->refresh(state, sides_changed);
  state.contact.broken = broken;
  search_->sides.mark_taken_over(released_);
  double taken_over = 0.0;
  evaluate(state, sides_changed, taken_over);
  // Where nothing lies opposite any more, what the pair had stored is lost.
  state.dissipation.friction += std::max(0.0, handed_over - taken_over);
}

void GeneralContact::evaluate(State& state, bool first_look, double& taken_over) {
  const Search& search = *search_;
  const std::vector<ContactPoint> before = std::move(state.contact.points);
  const Index count = search.sides.count();
  std::vector<std::size_t> first(at(count) + 1, 0);  // of a side in `before`
  for (std::size_t i = 0, s = 0; s < at(count); ++s) {
    while (i < before.size() && before[i].side < search.sides[static_cast<Index>(s)].corner) ++i;
    first[s] = i;
    while (i < before.size() && before[i].side == search.sides[static_cast<Index>(s)].corner) ++i;
    first[s + 1] = i;
  }
  std::vector<Touches> touches(at(block_count(count)));
  for_each_block(count, [&](Index begin, Index end, Index block) {
    for (Index s = begin; s < end; ++s) {
      const std::span<const Index> targets = search.candidates.of(s);
      const std::span<const ContactPoint> known{before.data() + first[at(s)],
                                                first[at(s) + 1] - first[at(s)]};
      if (targets.empty() && known.empty()) continue;
      touch(state, material_, search.sides, search.placed, s, targets, known, first_look, touches[at(block)]);
    }
  });
  state.contact.points.clear();
  for (const Touches& t : touches) {
    state.contact.points.insert(state.contact.points.end(), t.points.begin(), t.points.end());
    forces_.insert(forces_.end(), t.forces.begin(), t.forces.end());
    slips_.insert(slips_.end(), t.slips.begin(), t.slips.end());
    state.dissipation.friction += t.friction;
    taken_over += t.taken_over;
  }
}

void GeneralContact::apply(State& state, double dt) const {
  for (const SideForce& f : forces_) {
    for (std::size_t i = 0; i < 2; ++i) {
      const std::size_t n = at(f.node[i]);
      const Vec2 kick = (dt * state.inverse_mass[n] * f.share[i]) * f.force;
      state.velocity[n] += kick;
      state.displacement[n] += dt * kick;
    }
  }
}

double GeneralContact::stored_energy(const State& state) const {
  double sum = 0.0;
  for (const ContactPoint& p : state.contact.points) sum += energy(material_, side_length(state, p.side), p);
  return sum;
}

Index GeneralContact::count(const State& state) const {
  return static_cast<Index>(std::count_if(state.contact.points.begin(), state.contact.points.end(),
                                          [](const ContactPoint& p) { return p.depth > p.offset; }));
}

double GeneralContact::largest_frequency_squared(const State& state) const {
  if (!search_->needed() || !search_->ready) return 0.0;
  const FreeSides& sides = search_->sides;
  const double penalty = std::max(material_.normal_penalty, material_.tangential_penalty);
  // Row sums of the stiffness: a point's share of a node, twice over, as shares add up to one on
  // either side. Points of a side give each of its ends ¼ p; the points that meet a side give each of
  // its ends at most ¼ p L / L_shortest if they are spread over it, and ⅙ p more if a corner is there.
  std::vector<double> shortest(at(sides.count()), 0.0);
  for (Index s = 0; s < sides.count(); ++s) {
    for (const Index target : search_->candidates.of(s)) {
      double& length = shortest[at(target)];
      length = length == 0.0 ? sides[s].length : std::min(length, sides[s].length);
    }
  }
  std::vector<double> row(at(state.node_count()), 0.0);
  for (Index s = 0; s < sides.count(); ++s) {
    const double own = search_->candidates.of(s).empty() ? 0.0 : 0.25;
    const double met = shortest[at(s)] == 0.0 ? 0.0 : 0.25 * sides[s].length / shortest[at(s)] + 1.0 / 6.0;
    for (const Index n : sides[s].node) row[at(n)] += 2.0 * penalty * (own + met);
  }
  double largest = 0.0;
  for (std::size_t n = 0; n < row.size(); ++n) largest = std::max(largest, row[n] * state.inverse_mass[n]);
  return largest;
}

}  // namespace crackle
