// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <utility>

#include "crackle/cohesive/law.hpp"
#include "crackle/solve/simulation.hpp"
#include "granite.hpp"

namespace crackle::granite {

/// A crack in granite under a pump: edges of the mesh's first set of joints are cut and hold fluid, those of
/// a second are its path, as strong as the rock; elements on demand (penalty 20 E, damping ratio 0.1), fluid
/// up to the tip.
/// @param bulk_modulus of the fluid [Pa] @param rate of the pump [m2/s]
inline Scene pumped_crack(std::shared_ptr<const Mesh> mesh, const char* law, double bulk_modulus,
                          double rate) {
  Scene scene = granite::scene(std::move(mesh));
  scene.damping.ratio = 0.1;
  scene.law = find_law(law);
  scene.cohesive = granite::cohesive();
  scene.cohesive.penalty = scene.cohesive.tangential_penalty = 20.0 * granite::young_modulus;
  scene.contact = {scene.cohesive.penalty, scene.cohesive.penalty, scene.cohesive.tan_residual};
  scene.insertion.on_demand = true;
  for (Index e = 0; e < scene.mesh->edge_count(); ++e) {
    const Index joint = scene.mesh->edges[at(e)].joint;
    if (joint < 0) continue;
    if (scene.mesh->set_of_joint[at(joint)] == 0) {
      scene.cracks.push_back(e);
    } else {
      scene.joints.push_back({e, 1, true});
    }
  }
  if (!scene.joints.empty()) scene.joint_materials = {scene.cohesive};
  scene.fluid = CompressibleFluid{bulk_modulus, 1000.0, 0.0};
  scene.wets_damaged = true;
  scene.pump = Pump({{0.0, 1.0, rate}});
  return scene;
}

}  // namespace crackle::granite
