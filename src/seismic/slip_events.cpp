// SPDX-License-Identifier: GPL-3.0-or-later
#include "crackle/seismic/slip_events.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <stdexcept>

namespace crackle {
namespace {

/// Event under way by its name.
SlipMemory::Event& event_named(SlipMemory& memory, Index name) {
  return *std::lower_bound(memory.events.begin(), memory.events.end(), name,
                           [](const SlipMemory::Event& e, Index n) { return e.name < n; });
}

SlipEdge started(const SlidingEdge& e, StepTime clock) {
  SlipEdge s;
  s.edge = s.event = e.edge;
  s.vertex = e.vertex;
  s.partner = e.partner;
  s.place = e.place;
  s.direction = e.direction;
  s.length = e.length;
  s.start = clock.time - clock.step;
  s.slip_start = e.slip - e.slip_rate * clock.step;
  s.opening_start = e.opening;
  s.traction_start = e.traction;
  s.kinetic_start = e.kinetic;
  return s;
}

void follow(SlipEdge& s, const SlidingEdge& e, StepTime clock, double rate) {
  if (std::abs(e.slip_rate) >= rate) s.last = clock.time;
  s.slip = e.slip;
  s.opening = e.opening;
  s.traction = e.traction;
  s.partner = e.partner;
  s.friction_energy += e.friction_work;
}

/// Gives the edges of one event to the other; the smaller name stays.
void merge(SlipMemory& memory, Index a, Index b) {
  if (a == b) return;
  const auto [kept, gone] = std::minmax({a, b});
  for (SlipEdge& s : memory.edges) {
    if (s.event == gone) s.event = kept;
  }
  SlipMemory::Event& stays = event_named(memory, kept);
  stays.kinetic_rise = std::max(stays.kinetic_rise, event_named(memory, gone).kinetic_rise);
  std::erase_if(memory.events, [name = gone](const SlipMemory::Event& e) { return e.name == name; });
}

/// Joins every event that meets another at a vertex or touches it.
void join(SlipMemory& memory) {
  std::map<Index, Index> event_at;  // vertex -> edge's position in memory
  for (std::size_t i = 0; i < memory.edges.size(); ++i) {
    for (const Index v : memory.edges[i].vertex) {
      const auto [found, is_new] = event_at.try_emplace(v, static_cast<Index>(i));
      if (is_new) continue;
      merge(memory, memory.edges[static_cast<std::size_t>(found->second)].event, memory.edges[i].event);
    }
  }
  for (const SlipEdge& s : memory.edges) {
    if (s.partner < 0) continue;
    const auto other = std::lower_bound(memory.edges.begin(), memory.edges.end(), s.partner,
                                        [](const SlipEdge& e, Index number) { return e.edge < number; });
    if (other != memory.edges.end() && other->edge == s.partner) merge(memory, s.event, other->event);
  }
}

/// @return whether an edge started or came to touch another
bool follow_edges(SlipMemory& memory, std::span<const SlidingEdge> edges, StepTime clock,
                  const SlipRule& rule) {
  std::vector<SlipEdge> fresh;
  bool met = false;
  auto known = memory.edges.begin();
  for (std::size_t i = 0; i < edges.size(); ++i) {
    const SlidingEdge& e = edges[i];
    if (i > 0 && edges[i - 1].edge >= e.edge) {
      throw std::invalid_argument("track_slip: the edges have to be in ascending order");
    }
    while (known != memory.edges.end() && known->edge < e.edge) ++known;
    if (known != memory.edges.end() && known->edge == e.edge) {
      met = met || known->partner != e.partner;
      follow(*known, e, clock, rule.stop_rate);
    } else if (std::abs(e.slip_rate) >= rule.start_rate) {
      fresh.push_back(started(e, clock));
      follow(fresh.back(), e, clock, rule.stop_rate);
    }
  }
  if (fresh.empty()) return met;
  const auto merge_in = [](auto& all, const auto& more, auto less) {
    const auto middle = static_cast<std::ptrdiff_t>(all.size());
    all.insert(all.end(), more.begin(), more.end());
    std::inplace_merge(all.begin(), all.begin() + middle, all.end(), less);
  };
  std::vector<SlipMemory::Event> events;
  events.reserve(fresh.size());
  for (const SlipEdge& s : fresh) events.push_back({s.event, 0.0});
  merge_in(memory.edges, fresh, [](const SlipEdge& a, const SlipEdge& b) { return a.edge < b.edge; });
  merge_in(memory.events, events, [](const auto& a, const auto& b) { return a.name < b.name; });
  return true;
}

void raise_kinetic(SlipMemory& memory, std::span<const SlidingEdge> edges) {
  std::map<Index, double> rise;
  auto known = memory.edges.begin();
  for (const SlidingEdge& e : edges) {
    while (known != memory.edges.end() && known->edge < e.edge) ++known;
    if (known == memory.edges.end()) break;
    if (known->edge == e.edge) rise[known->event] += e.kinetic - known->kinetic_start;
  }
  for (const auto& [name, value] : rise) {
    SlipMemory::Event& event = event_named(memory, name);
    event.kinetic_rise = std::max(event.kinetic_rise, value);
  }
}

SeismicEvent sum(const SlipMemory& memory, const SlipMemory::Event& under_way, const SeismicMedium& medium) {
  SeismicEvent e;
  e.kind = EventKind::slip;
  e.mode = FailureMode::shear;
  e.edge = under_way.name;
  e.edges = 0;
  double last = 0.0, weight = 0.0;
  Vec2 moved, middle;
  for (const SlipEdge& s : memory.edges) {
    if (s.event != under_way.name) continue;
    const double slip = s.slip - s.slip_start, opening = s.opening - s.opening_start;
    e.time = e.edges == 0 ? s.start : std::min(e.time, s.start);
    last = e.edges == 0 ? s.last : std::max(last, s.last);
    ++e.edges;
    e.length += s.length;
    e.slip += s.length * slip;
    e.opening += s.length * opening;
    e.stress_drop += s.length * (s.traction_start - s.traction) * (slip < 0.0 ? -1.0 : 1.0);
    e.friction_energy += s.friction_energy;
    e.moment += moment_of_jump(medium.rock, s.direction, s.length, opening, slip);
    weight += s.length * std::abs(slip);
    moved += s.length * std::abs(slip) * s.place;
    middle += s.length * s.place;
  }
  e.duration = last - e.time;
  e.place = weight > 0.0 ? (1.0 / weight) * moved : (1.0 / e.length) * middle;
  e.slip /= e.length;
  e.opening /= e.length;
  e.stress_drop /= e.length;
  e.energy = under_way.kinetic_rise;
  e.magnitude = magnitude_of_energy(e.energy * medium.thickness);
  e.moment_magnitude = moment_magnitude(scalar_moment(e.moment) * medium.thickness);
  return e;
}

/// Takes the events out that are over. @param over says so of an event's name
template <class Over>
std::vector<SeismicEvent> take(SlipMemory& memory, const SeismicMedium& medium, const Over& over) {
  std::vector<SeismicEvent> events;
  for (const SlipMemory::Event& event : memory.events) {
    if (over(event.name)) events.push_back(sum(memory, event, medium));
  }
  if (events.empty()) return events;
  std::erase_if(memory.edges, [&](const SlipEdge& s) { return over(s.event); });
  std::erase_if(memory.events, [&](const SlipMemory::Event& e) { return over(e.name); });
  return events;
}

}  // namespace

std::vector<SeismicEvent> track_slip(SlipMemory& memory, std::span<const SlidingEdge> edges, StepTime clock,
                                     const SlipRule& rule, const SeismicMedium& medium) {
  if (follow_edges(memory, edges, clock, rule)) join(memory);
  raise_kinetic(memory, edges);
  std::map<Index, double> last;
  for (const SlipEdge& s : memory.edges) last[s.event] = std::max(last[s.event], s.last);
  return take(memory, medium, [&](Index name) { return last.at(name) + rule.quiet < clock.time; });
}

std::vector<SeismicEvent> finish_slip(SlipMemory& memory, const SeismicMedium& medium) {
  return take(memory, medium, [](Index) { return true; });
}

}  // namespace crackle
