// SPDX-License-Identifier: GPL-3.0-or-later
#include "dissection.hpp"

#include <metis.h>

#include <new>

namespace crackle {

static_assert(sizeof(idx_t) == sizeof(Index));

std::vector<Index> nested_dissection(const Mesh& mesh) {
  const auto vertices = mesh.vertices.size();
  std::vector<idx_t> first(vertices + 1, 0), neighbour(2 * mesh.edges.size());
  for (const Edge& edge : mesh.edges) {
    for (const Index v : edge.vertex) ++first[static_cast<std::size_t>(v) + 1];
  }
  for (std::size_t v = 0; v < vertices; ++v) first[v + 1] += first[v];
  std::vector<idx_t> next(first.begin(), first.end() - 1);
  for (const Edge& edge : mesh.edges) {
    const auto [v, w] = edge.vertex;
    neighbour[static_cast<std::size_t>(next[static_cast<std::size_t>(v)]++)] = w;
    neighbour[static_cast<std::size_t>(next[static_cast<std::size_t>(w)]++)] = v;
  }
  std::vector<Index> order(vertices), place(vertices);
  auto count = static_cast<idx_t>(vertices);
  if (METIS_NodeND(&count, first.data(), neighbour.data(), nullptr, nullptr, order.data(), place.data()) !=
      METIS_OK) {
    throw std::bad_alloc();  // the only reason there is with a sound graph
  }
  return order;
}

}  // namespace crackle
