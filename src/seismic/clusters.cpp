// SPDX-License-Identifier: GPL-3.0-or-later
#include "crackle/seismic/clusters.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <stdexcept>

#include "crackle/seismic/listener.hpp"
#include "merge_sets.hpp"

namespace crackle {
namespace {

std::size_t at(Index i) { return static_cast<std::size_t>(i); }

double end_of(const SeismicEvent& e) { return e.time + (e.kind == EventKind::slip ? e.duration : 0.0); }

MergeSets linked(const std::vector<SeismicEvent>& events, const ClusterRule& rule) {
  MergeSets sets(events.size());
  std::vector<Index> order(events.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(),
                   [&](Index a, Index b) { return events[at(a)].time < events[at(b)].time; });
  // Events that an event still to come may follow. Slips last, so one may stay while later ones go.
  std::vector<Index> open;
  for (const Index i : order) {
    const SeismicEvent& e = events[at(i)];
    std::erase_if(open, [&](Index j) { return end_of(events[at(j)]) + rule.window < e.time; });
    for (const Index j : open) {
      if (norm(events[at(j)].place - e.place) <= rule.radius) sets.merge(at(i), at(j));
    }
    open.push_back(i);
  }
  return sets;
}

Cluster sum(const std::vector<SeismicEvent>& events, std::vector<Index> members, double thickness) {
  Cluster c;
  c.events = std::move(members);
  const SeismicEvent& first = events[at(c.events.front())];
  c.time = first.time;
  double end = end_of(first), weight = 0.0;
  Vec2 middle;
  for (const Index i : c.events) {
    const SeismicEvent& e = events[at(i)];
    c.time = std::min(c.time, e.time);
    end = std::max(end, end_of(e));
    c.length += e.length;
    c.opened += e.length * e.opening;
    c.slid += e.length * std::abs(e.slip);
    c.energy += e.energy;
    c.dissipated += e.fracture_energy + e.friction_energy;
    c.moment += e.moment;
    const double m = scalar_moment(e.moment);
    weight += m;
    middle += m * e.place;
    c.place += (1.0 / static_cast<double>(c.events.size())) * e.place;
  }
  c.duration = end - c.time;
  if (weight > 0.0) c.place = (1.0 / weight) * middle;
  c.magnitude = magnitude_of_energy(c.energy * thickness);
  c.moment_magnitude = moment_magnitude(scalar_moment(c.moment) * thickness);
  return c;
}

FailureMode mode_of(SourceType type) {
  if (type == SourceType::shear) return FailureMode::shear;
  return type == SourceType::mixed ? FailureMode::mixed : FailureMode::tensile;
}

}  // namespace

std::vector<Cluster> cluster_events(const std::vector<SeismicEvent>& events, const ClusterRule& rule,
                                    double thickness) {
  if (!(rule.radius >= 0.0) || !(rule.window >= 0.0)) {
    throw std::invalid_argument("cluster_events: radius and window have to be zero or positive");
  }
  MergeSets sets = linked(events, rule);
  std::map<std::size_t, std::vector<Index>> members;  // the first of a set names it
  for (std::size_t i = 0; i < events.size(); ++i) members[sets.find(i)].push_back(static_cast<Index>(i));
  std::vector<Cluster> clusters;
  clusters.reserve(members.size());
  for (auto& [first, set] : members) clusters.push_back(sum(events, std::move(set), thickness));
  return clusters;
}

SeismicEvent as_event(const Cluster& cluster, const std::vector<SeismicEvent>& events) {
  SeismicEvent sum;
  sum.time = cluster.time;
  sum.duration = cluster.duration;
  sum.place = cluster.place;
  sum.kind = EventKind::slip;
  sum.mode = mode_of(source_type(cluster.opened, cluster.slid));
  sum.energy = cluster.energy;
  sum.magnitude = cluster.magnitude;
  sum.length = cluster.length;
  sum.opening = cluster.opened / cluster.length;
  sum.slip = cluster.slid / cluster.length;
  sum.moment = cluster.moment;
  sum.moment_magnitude = cluster.moment_magnitude;
  sum.edge = events[at(cluster.events.front())].edge;
  sum.edges = 0;
  for (const Index i : cluster.events) {
    const SeismicEvent& e = events[at(i)];
    if (e.kind == EventKind::breaking) sum.kind = EventKind::breaking;
    sum.fracture_energy += e.fracture_energy;
    sum.friction_energy += e.friction_energy;
    sum.stress_drop += e.stress_drop * e.length / cluster.length;
    sum.edges += e.edges;
  }
  return sum;
}

}  // namespace crackle
