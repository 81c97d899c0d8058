// SPDX-License-Identifier: GPL-3.0-or-later
#include <crackle/core/version.hpp>
#include <crackle/mesh/mesh.hpp>
#include <iostream>

int main() {
  crackle::Mesh mesh;
  mesh.vertices = {{0.0, 0.0}, {1.0, 0.0}, {0.0, 1.0}};
  mesh.triangles = {{0, 1, 2}};
  crackle::build_edges(mesh);
  std::cout << "crackle " << crackle::version << ", " << mesh.edge_count() << " edges\n";
}
