// SPDX-License-Identifier: GPL-3.0-or-later
#include "layers.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "crackle/core/errors.hpp"
#include "scene.hpp"

namespace crackle {
namespace {

constexpr double inf = std::numeric_limits<double>::infinity();

/// Between which heights a layer lies, and along which normal they are measured.
struct Band {
  Vec2 normal;
  double bottom, top;

  explicit Band(const Case::Layer& layer)
      : normal{-std::sin(layer.dip), std::cos(layer.dip)},
        bottom(layer.bottom.value_or(-inf)),
        top(layer.top.value_or(inf)) {
    if (layer.dip == 0.0) normal = {0.0, 1.0};
  }
  bool holds(Vec2 x) const {
    const double height = dot(normal, x);
    return height > bottom && height < top;
  }
};

std::vector<Band> bands_of(const Case& scene) { return {scene.layers.begin(), scene.layers.end()}; }

/// Whether a triangle has corners well on both sides of a height.
bool straddles(const std::array<double, 3>& heights, double interface, double tolerance) {
  const auto [low, high] = std::minmax_element(heights.begin(), heights.end());
  return *low<interface - tolerance&& * high> interface + tolerance;
}

}  // namespace

std::size_t first_interface(const Case& scene) { return scene.joints.size() + scene.joint_sets.size(); }

void add_interfaces(const Case& scene, MeshRecipe& recipe) {
  const double reach = std::hypot(recipe.width, recipe.height);  // beyond the domain, whatever the dip
  for (const bool perfect : {false, true}) {
    for (std::size_t i = 0; i < scene.layers.size(); ++i) {
      const Case::Layer& layer = scene.layers[i];
      if ((layer.interface.law == "perfect") != perfect) continue;
      const Band band(layer);
      const Vec2 along{band.normal.y, -band.normal.x};
      for (const double height : {band.bottom, band.top}) {
        if (!std::isfinite(height)) continue;
        const Vec2 middle = height * band.normal;
        recipe.joints.push_back({middle + -reach * along, middle + reach * along,
                                 static_cast<Index>(first_interface(scene) + i)});
      }
    }
  }
}

void weld_perfect_interfaces(const Case& scene, Mesh& mesh) {
  const std::size_t first = first_interface(scene);
  for (Edge& edge : mesh.edges) {
    if (edge.joint < 0) continue;
    const auto set = static_cast<std::size_t>(mesh.set_of_joint[static_cast<std::size_t>(edge.joint)]);
    if (set < first || set >= first + scene.layers.size()) continue;
    if (scene.layers[set - first].interface.law == "perfect") edge.joint = -1;
  }
}

std::vector<std::uint16_t> layers_of(const Case& scene, const Mesh& mesh) {
  std::vector<std::uint16_t> layer_of(scene.layers.empty() ? 0 : mesh.triangles.size(), 0);
  const std::vector<Band> bands = bands_of(scene);
  std::vector<Index> count(bands.size(), 0);
  // A generated mesh may lead an interface over the end of a joint nearby.
  const double give = scene.mesh.file.empty() ? 0.6 : 1e-6;  // of a triangle's height
  for (std::size_t t = 0; t < layer_of.size(); ++t) {
    std::array<Vec2, 3> x;
    for (std::size_t k = 0; k < 3; ++k) x[k] = mesh.vertices[static_cast<std::size_t>(mesh.triangles[t][k])];
    const Vec2 centroid = (1.0 / 3.0) * (x[0] + x[1] + x[2]);
    for (std::size_t i = 0; i < bands.size(); ++i) {
      const Band& band = bands[i];
      const std::array<double, 3> height{dot(band.normal, x[0]), dot(band.normal, x[1]),
                                         dot(band.normal, x[2])};
      const double size =
          *std::max_element(height.begin(), height.end()) - *std::min_element(height.begin(), height.end());
      if (straddles(height, band.bottom, give * size) || straddles(height, band.top, give * size)) {
        throw MeshError(
            fmt::format("triangle {} at ({:.4g}, {:.4g}) m lies on both sides of an interface of layers.{}: "
                        "the mesh has to follow it",
                        t, centroid.x, centroid.y, i));
      }
      if (!band.holds(centroid)) continue;
      if (layer_of[t] != 0) {
        throw MeshError(fmt::format("layers.{} and layers.{} overlap at ({:.4g}, {:.4g}) m", layer_of[t] - 1,
                                    i, centroid.x, centroid.y));
      }
      layer_of[t] = static_cast<std::uint16_t>(i + 1);
      ++count[i];
    }
  }
  for (std::size_t i = 0; i < bands.size(); ++i) {
    if (count[i] > 0) continue;
    throw MeshError(fmt::format(
        "layers.{} has no triangle: it lies outside the domain, or is thinner than half an edge of the mesh",
        i));
  }
  return layer_of;
}

void set_layers(const Case& scene, Scene& s) {
  for (const Case::Layer& layer : scene.layers) s.layers.push_back(rock_mass(scene, layer));
  if (s.mesh) s.layer_of_triangle = layers_of(scene, *s.mesh);
}

const Case::Layer* layer_at_well(const Case& scene) {
  const auto found =
      std::ranges::find_if(scene.layers, [](const Case::Layer& layer) { return Band(layer).holds({}); });
  return found == scene.layers.end() ? nullptr : &*found;
}

const Case::Rock& rock_at_well(const Case& scene) {
  const Case::Layer* layer = layer_at_well(scene);
  return layer == nullptr ? scene.rock : layer->rock;
}

const Sym2& stress_at_well(const Case& scene) {
  const Case::Layer* layer = layer_at_well(scene);
  return layer == nullptr ? scene.stress : layer->stress;
}

std::string layers_text(const Case& scene, const Mesh& mesh) {
  if (scene.layers.empty()) return {};
  const std::vector<std::uint16_t> layer_of = layers_of(scene, mesh);
  std::string text = fmt::format("{} triangles in no layer", std::count(layer_of.begin(), layer_of.end(), 0));
  for (std::size_t i = 0; i < scene.layers.size(); ++i) {
    text += fmt::format(", {} in layers.{}", std::count(layer_of.begin(), layer_of.end(), i + 1), i);
  }
  return text;
}

}  // namespace crackle
